#include "snapshot_verb/review.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/glfw_host.h"
#include "cli/exit_codes.h"
#include "goldens/report.h"
#include "slipface/base/files.h"

namespace slipface {

int snapshot_review(const std::string& report_file) {
    const Result<std::string> text = read_file(report_file);
    const Result<Report> report = text ? report_from_json(*text, report_file) : text.error();
    if (!report) {
        fmt::print(stderr, "slipface: {}\n", report.error().text());
        return cli::exit_bad_input;
    }
    if (run_window({.level = {}, .config = {}, .review = report_file}).ok()) return cli::exit_fine;
    const std::filesystem::path page = std::filesystem::path(report_file).parent_path() / "report.html";
    fmt::print("{} same, {} failed: {}\n", report->count(GoldenState::same), report->failed(),
               page.generic_string());
    return cli::exit_fine;
}

}  // namespace slipface

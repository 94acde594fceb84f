// The outcome of a check, for people and for machines: report.json, report.html (one file, no network),
// junit.xml and lines that a CI shows beside the change. Everything is made from report.json, so parts of a
// suite that ran on several machines can be put together.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/base/shard.h"
#include "slipface/snapshot/golden.h"

namespace slipface {

struct Report {
    std::string goldens;   // folder, as given on the command line
    std::string renderer;  // one line
    Shard shard;           // the part of the suite that this report is
    std::string suite;     // fingerprint of the names that were asked for and of the program; parts share it
    std::vector<GoldenResult> entries;
    double seconds = 0.0;

    std::size_t count(GoldenState state) const;
    std::size_t failed() const { return entries.size() - count(GoldenState::same); }
};

// Worst first: unreadable, failed, nondeterministic, different by fraction of pixels, missing, orphans, then
// what is the same by name.
void sort_by_severity(Report& report);

std::string entry_to_json(const GoldenResult& entry);  // on one line
Result<GoldenResult> entry_from_json(std::string_view json, const std::string& location);
std::string report_to_json(const Report& report);
Result<Report> report_from_json(std::string_view json, const std::string& location);

// The page. Pictures of what failed are read from `out` (NAME.expected.png, NAME.actual.png) and become part
// of it.
std::string report_to_html(const Report& report, const std::filesystem::path& out);
std::string report_to_junit(const Report& report);

// "::error file=screenshots/NAME.png,...", one line a failed entry, for GitHub Actions.
std::string report_to_annotations(const Report& report);

// The command that makes everything that differs, or is missing, the golden; empty when nothing does.
std::string approve_command(const Report& report, const std::filesystem::path& out);

// Writes report.json, report.html and junit.xml into `out`.
Status write_report(const Report& report, const std::filesystem::path& out);

// The suite's fingerprint: of all names that were asked for, of every part alike.
std::string suite_fingerprint(const std::vector<std::string>& names);

// Puts reports of all parts of one suite together in `out`, with their pictures. Parts of different suites,
// parts that are missing or there twice, and damaged reports are errors that name them. An entry that several
// reports have is an error unless it is an orphan.
Result<Report> merge_reports(const std::vector<std::filesystem::path>& report_files,
                             const std::filesystem::path& out);

}  // namespace slipface

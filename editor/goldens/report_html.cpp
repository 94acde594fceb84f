#include <array>

#include "goldens/numbers_json.h"
#include "goldens/report.h"
#include "goldens/report_page.h"
#include "slipface/base/base64.h"
#include "slipface/base/files.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

// Inside <script>, "</script>" would end it and "<!--" hide the rest.
std::string script_text(std::string json) {
    std::string out;
    for (const char c : json) {
        out += c;
        if (c == '<') out.replace(out.size() - 1, 1, "\\u003c");
    }
    return out;
}

// Pages with more bytes of images than this open slowly.
constexpr std::uintmax_t max_embedded = std::uintmax_t{3} << 20U;

constexpr std::array image_kinds{"expected", "actual", "first", "second"};

fs::path image_file(const fs::path& out, const std::string& name, const char* kind) {
    return out / (name + "." + kind + ".png");
}

bool fits_in_page(const Report& report, const fs::path& out) {
    std::uintmax_t bytes = 0;
    for (const GoldenResult& entry : report.entries) {
        if (entry.state == GoldenState::same) continue;
        for (const char* kind : image_kinds) {
            std::error_code error;
            const std::uintmax_t size = fs::file_size(image_file(out, entry.name, kind), error);
            if (!error) bytes += size;
        }
    }
    return bytes <= max_embedded;
}

// The images of a failed entry as data URLs, by kind.
Numbers images_json(const std::string& name, const fs::path& out) {
    Numbers images = Numbers::object();
    for (const char* kind : image_kinds) {
        const fs::path path = image_file(out, name, kind);
        std::error_code error;
        if (!fs::is_regular_file(path, error)) continue;
        if (const Result<std::string> bytes = read_file(path))
            images[kind] = "data:image/png;base64," + to_base64(*bytes, Base64::padded);
    }
    return images;
}

}  // namespace

std::string report_to_html(const Report& report, const fs::path& out) {
    Numbers data = Numbers::parse(report_to_json(report));
    data["approve"] = "slipface snapshot approve --from " + (out / "report.json").generic_string() +
                      (report.goldens == "screenshots" ? "" : " --goldens " + report.goldens);
    data["rows"] = Numbers::array();
    for (const ActRow& row : act_rows(report)) {
        Numbers names = Numbers::array();
        for (const std::size_t entry : row.entries)
            names.push_back(report.entries[entry].name);
        data["rows"].push_back({{"text", row.text}, {"word", row.word}, {"entries", names}});
    }
    data["not_reached"] = not_reached(report);
    const bool embedded = fits_in_page(report, out);
    for (Numbers& entry : data["entries"]) {
        entry.erase("reached");
        entry.erase("there");
        if (entry["state"] == "same") continue;
        const auto name = entry["name"].get<std::string>();
        if (embedded) {
            entry.update(images_json(name, out));
        } else {
            entry["script"] = name + ".images.js";
        }
    }
    return std::string(report_page_head) + page_colours + report_page_style +
           script_text(data.dump(-1, ' ', false, Numbers::error_handler_t::replace)) + report_page_tail;
}

Status write_report_images(const Report& report, const fs::path& out) {
    if (fits_in_page(report, out)) return {};
    for (const GoldenResult& entry : report.entries) {
        if (entry.state == GoldenState::same) continue;
        const std::string text =
            "showImages(" + Numbers(entry.name).dump() + ", " + images_json(entry.name, out).dump() + ");\n";
        const fs::path path = out / (entry.name + ".images.js");
        std::error_code error;
        fs::create_directories(path.parent_path(), error);
        if (Status status = write_file_atomic(path, text); !status) return status;
    }
    return {};
}

}  // namespace slipface

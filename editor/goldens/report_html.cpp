#include <array>

#include "goldens/numbers_json.h"
#include "goldens/report.h"
#include "goldens/report_page.h"
#include "slipface/base/files.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

std::string base64(std::string_view bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t block = 0;
        for (std::size_t k = 0; k < 3; ++k)
            block = block << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : letters[block >> (18U - 6U * k) & 63U];
    }
    return out;
}

// Inside <script>, "</script>" would end it and "<!--" hide the rest.
std::string script_text(std::string json) {
    std::string out;
    for (const char c : json) {
        out += c;
        if (c == '<') out.replace(out.size() - 1, 1, "\\u003c");
    }
    return out;
}

}  // namespace

std::string report_to_html(const Report& report, const fs::path& out) {
    Numbers data = Numbers::parse(report_to_json(report));
    data["approve"] = "slipface snapshot approve --from " + (out / "report.json").generic_string() +
                      (report.goldens == "screenshots" ? "" : " --goldens " + report.goldens);
    for (Numbers& entry : data["entries"]) {
        if (entry["state"] == "same") continue;
        for (const char* kind : {"expected", "actual", "first", "second"}) {
            const fs::path path = out / (entry["name"].get<std::string>() + "." + kind + ".png");
            std::error_code error;
            if (!fs::is_regular_file(path, error)) continue;
            if (const Result<std::string> bytes = read_file(path))
                entry[kind] = "data:image/png;base64," + base64(*bytes);
        }
    }
    return report_page_head + script_text(data.dump(-1, ' ', false, Numbers::error_handler_t::replace)) +
           report_page_tail;
}

}  // namespace slipface

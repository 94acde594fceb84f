#include "goldens/junit.h"

#include <fmt/format.h>

#include <algorithm>

namespace slipface {
namespace {

std::string time_text(const std::optional<double>& seconds) {
    return seconds ? fmt::format(" time=\"{:.3f}\"", *seconds) : "";
}

}  // namespace

std::string xml_text(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else if (c == '"')
            out += "&quot;";
        else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
            out += c;
    }
    return out;
}

std::string junit_text(const std::string& suite, const std::vector<JunitCase>& cases,
                       std::optional<double> seconds) {
    const auto failed =
        std::count_if(cases.begin(), cases.end(), [](const JunitCase& one) { return !one.failure.empty(); });
    std::string xml = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"{}\" tests=\"{}\" "
        "failures=\"{}\"{}>\n",
        xml_text(suite), cases.size(), failed, time_text(seconds));
    for (const JunitCase& one : cases) {
        xml += fmt::format("<testcase classname=\"{}\" name=\"{}\"{}", xml_text(suite), xml_text(one.name),
                           time_text(one.seconds));
        if (one.failure.empty())
            xml += "/>\n";
        else
            xml += fmt::format("><failure type=\"{}\" message=\"{}\">{}</failure></testcase>\n", one.failure,
                               xml_text(one.message), xml_text(one.details));
    }
    return xml + "</testsuite>\n</testsuites>\n";
}

}  // namespace slipface

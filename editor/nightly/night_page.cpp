// A night for people and for a CI. The page needs no script, no other file and no network.
#include <fmt/format.h>

#include "goldens/junit.h"
#include "goldens/report_page.h"
#include "nightly/night_report.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_shown = 6;  // findings of an item; the others at a click

constexpr const char* page_style = R"html(
*{box-sizing:border-box}
body{margin:0 auto;max-width:1100px;padding:20px;background:var(--bg);color:var(--text);font:14px/1.45 Inter,system-ui,sans-serif}
h1{font-size:20px;margin:0}h2{font-size:15px;margin:0;overflow-wrap:anywhere}
header{display:flex;gap:14px;align-items:baseline;flex-wrap:wrap;margin-bottom:16px}
.muted{color:var(--muted)}
section{background:var(--panel);border:1px solid var(--line);border-left:4px solid var(--warn);border-radius:6px;padding:12px 16px;margin:0 0 12px}
section.failed,section.hole{border-left-color:var(--bad)}section.clean{border-left-color:var(--good)}
table{border-collapse:collapse;width:100%;margin-top:8px}td{padding:5px 12px 5px 0;border-top:1px solid var(--line);vertical-align:top;overflow-wrap:anywhere}
td:first-child{white-space:nowrap}
code{font:12.5px/1.5 ui-monospace,"DejaVu Sans Mono",monospace;background:var(--bg);border:1px solid var(--line);border-radius:4px;padding:1px 6px;overflow-wrap:anywhere}
.tag{display:inline-block;padding:1px 8px;border-radius:10px;border:1px solid var(--line);font-size:12px}
a{color:var(--accent)}
details summary{cursor:pointer}
)html";

// From the project's folder: plays the tape of a finding.
std::string replay_of(const NightResult& result, const NightFinding& finding, const fs::path& to_report) {
    const fs::path tape = to_report / result.folder / finding.tape;
    return shell_text({"slipface", "simulate", result.level, "--tape", tape.generic_string()});
}

// A path as the address of a link.
std::string address_of(const std::string& path) {
    std::string text;
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain =
            std::isalnum(byte) != 0 || std::string_view("_-./~").find(c) != std::string_view::npos;
        text += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
    }
    return text;
}

std::string section_of(const NightResult& result, const fs::path& to_report) {
    const bool hole = !result.findings.empty() && (result.findings.front().kind == "passed_through" ||
                                                   result.findings.front().kind == "left_level");
    std::string html =
        fmt::format("<section class=\"{}{}\"><h2>{}</h2><div>{} <span class=\"muted\">{}</span></div>\n",
                    night_state_names[static_cast<std::size_t>(result.state)], hole ? " hole" : "",
                    xml_text(result.name), xml_text(result.text),
                    result.count > result.findings.size()
                        ? fmt::format("the first {} of {}", result.findings.size(), result.count)
                        : "");
    html += fmt::format("<p><code>{}</code>", xml_text(shell_text(result.command)));
    if (!result.page.empty())
        html +=
            fmt::format(" <a href=\"{}\">its own report</a>", address_of(result.folder + "/" + result.page));
    html += "</p>\n";
    if (!result.findings.empty()) html += "<table>\n";
    for (const NightFinding& finding : result.findings) {
        if (static_cast<std::size_t>(&finding - result.findings.data()) == max_shown)
            html += fmt::format("</table><details><summary>{} more</summary><table>\n",
                                result.findings.size() - max_shown);
        html += fmt::format("<tr><td><span class=\"tag\">{}</span></td><td>{}", xml_text(finding.kind),
                            xml_text(finding.text));
        if (!finding.tape.empty())
            html += fmt::format("<br><code>{}</code> <a href=\"{}\">tape</a>",
                                xml_text(replay_of(result, finding, to_report)),
                                address_of(result.folder + "/" + finding.tape));
        html += "</td></tr>\n";
    }
    if (!result.findings.empty()) html += "</table>\n";
    if (result.findings.size() > max_shown) html += "</details>\n";
    return html + "</section>\n";
}

}  // namespace

std::string night_report_to_html(const NightReport& report, const fs::path& to_report) {
    std::string html =
        std::string(
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Slipface: "
            "night</title>\n<meta name=\"viewport\" content=\"width=device-width, "
            "initial-scale=1\">\n<style>\n") +
        page_colours + page_style + "</style></head><body>\n";
    html += fmt::format(
        "<header><h1>Night</h1><span>{} failed to run, {} with findings, {} clean</span><span "
        "class=\"muted\">slipface {}{}; commands are for the project's folder</span></header>\n",
        report.count(NightState::failed), report.count(NightState::findings), report.count(NightState::clean),
        xml_text(report.program), report.shard.whole() ? "" : ", shard " + shard_text(report.shard));
    std::string clean;
    for (const NightResult* const result : worst_first(report)) {
        if (result->state != NightState::clean)
            html += section_of(*result, to_report);
        else
            clean += fmt::format("<tr><td>{}</td><td class=\"muted\">{}</td></tr>\n", xml_text(result->name),
                                 xml_text(result->text));
    }
    if (!clean.empty())
        html += fmt::format(
            "<section class=\"clean\"><details{}><summary>{} clean</summary><table>\n{}</table>"
            "</details></section>\n",
            report.count(NightState::clean) == report.results.size() ? " open" : "",
            report.count(NightState::clean), clean);
    return html + "</body></html>\n";
}

std::string night_report_to_junit(const NightReport& report, const fs::path& to_report) {
    std::vector<JunitCase> cases;
    for (const NightResult* const result : worst_first(report)) {
        JunitCase& one = cases.emplace_back();
        one.name = result->name;
        if (result->state == NightState::clean) continue;
        one.failure = night_state_names[static_cast<std::size_t>(result->state)];
        one.message = result->text;
        one.details = shell_text(result->command) + "\n";
        for (const NightFinding& finding : result->findings) {
            one.details += fmt::format("{}: {}\n", finding.kind, finding.text);
            if (!finding.tape.empty()) one.details += "    " + replay_of(*result, finding, to_report) + "\n";
        }
    }
    return junit_text("night", cases);
}

}  // namespace slipface

// The result of a check, for people and for programs: report.json, report.html (no network needed),
// junit.xml and annotations for a CI. All are made from the data in report.json, so parts of a suite that ran
// on several machines can be merged.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "goldens/golden.h"
#include "slipface/base/shard.h"

namespace slipface {

struct Report {
    std::string goldens;   // folder, as given on the command line
    std::string renderer;  // one line
    Shard shard;           // the part of the suite that this report is
    std::string suite;     // suite_fingerprint(); the same in all parts of a suite
    std::vector<GoldenResult> entries;
    double seconds = 0.0;

    std::size_t count(GoldenState state) const;
    std::size_t failed() const { return entries.size() - count(GoldenState::same); }
};

// Words for what no entry reaches (coverage.h); none if no entry has a run.
std::vector<std::string> not_reached(const Report& report);

// Sorts the entries, the worst first: unreadable, failed, nondeterministic, different by fraction of pixels,
// missing, orphans, then the same ones by name.
void sort_by_severity(Report& report);

// One act, and all that it changed.
struct ActRow {
    std::string text;  // "prop `crate` moved 1 m (levels/easy)"; of entries without an act, what they are
    std::string word;  // the cause, or the state: "level", "missing"
    std::vector<std::size_t> entries;  // of the report, in its order
    std::size_t pixels = 0;            // of the entry that it changed most
};
// The acts of all entries that are not the same; those that changed most entries first. An entry of several
// acts is in several rows.
std::vector<ActRow> act_rows(const Report& report);
// "3 images: a, b, c", with inputs apart: "; and levels/easy".
std::string entries_text(const Report& report, const ActRow& row);

bool can_be_approved(const GoldenResult& entry);  // different, missing or unreadable

std::string entry_to_json(const GoldenResult& entry);  // on one line
Result<GoldenResult> entry_from_json(std::string_view json, const std::string& location);
std::string report_to_json(const Report& report);
Result<Report> report_from_json(std::string_view json, const std::string& location);

// The text of report.html. The images of failed entries are read from `out` (NAME.expected.png,
// NAME.actual.png) and embedded. If they are more than 3 MiB, the page stays small and reads each entry's
// images when it is shown, from the scripts that write_report_images() writes beside it: unlike image files,
// they may be compared by pixel in a page that was opened as a file.
std::string report_to_html(const Report& report, const std::filesystem::path& out);
Status write_report_images(const Report& report, const std::filesystem::path& out);
std::string report_to_junit(const Report& report);

// "::error file=screenshots/NAME.png,...", one line per act, for GitHub Actions.
std::string report_to_annotations(const Report& report);

// The command that approves all entries that are different, missing or unreadable; empty if there are none.
std::string approve_command(const Report& report, const std::filesystem::path& out);

// Writes report.json, report.html and junit.xml into `out`.
Status write_report(const Report& report, const std::filesystem::path& out);

// The fingerprint of a suite: of the program's version, the names of all requested snapshots of all parts,
// and the files that they are made from.
std::string suite_fingerprint(const std::vector<std::string>& names,
                              const std::vector<std::filesystem::path>& files);

// Merges the reports of all parts of one suite into `out`, with their images. Errors, which name the report:
// parts of different suites, a part that is missing or there twice, a damaged report, an entry in several
// reports unless it is an orphan.
Result<Report> merge_reports(const std::vector<std::filesystem::path>& report_files,
                             const std::filesystem::path& out);

}  // namespace slipface

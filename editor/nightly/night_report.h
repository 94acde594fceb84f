// What a night found: report.json, report.html and junit.xml, and the merging of its shards.
#pragma once

#include <array>

#include "nightly/project.h"
#include "slipface/base/shard.h"

namespace slipface {

// Worst first.
enum class NightState : std::uint8_t { failed, findings, clean };
inline constexpr std::array<const char*, 3> night_state_names{"failed", "findings", "clean"};

struct NightFinding {
    std::string kind, text;
    std::string tape;  // in the item's folder; empty: none
};

struct NightResult {
    std::size_t index = 0;     // of the item in the project
    std::string name, folder;  // the latter below the report's
    std::string level;
    std::vector<std::string> command;
    std::uint64_t key = 0;
    NightState state = NightState::clean;
    std::string text;       // one line
    std::string page;       // of its own, in its folder; empty: none
    std::size_t count = 0;  // of all findings, of which `findings` has the first ones
    std::vector<NightFinding> findings;
};

struct NightReport {
    std::string program;                    // version and fingerprint
    std::uint64_t project = 0, inputs = 0;  // of the project's file; of all items' inputs
    std::size_t items = 0;                  // of the whole project
    Shard shard;
    std::vector<NightResult> results;  // by index

    std::size_t count(NightState state) const;
};

// One result as a file of its own, from which a later night takes it.
std::string night_result_to_json(const NightResult& result);
// Errors: damaged text. `location` names it.
Result<NightResult> night_result_from_json(std::string_view text, const std::string& location);

std::string night_report_to_json(const NightReport& report);
Result<NightReport> night_report_from_json(std::string_view text, const std::string& location);

// The results, worst first: what could not run, then by the worst kind of finding and their number.
std::vector<const NightResult*> worst_first(const NightReport& report);
// The page and the list for a CI. `to_report`: from the project's folder to the report's, for commands with
// tapes.
std::string night_report_to_html(const NightReport& report, const std::filesystem::path& to_report);
std::string night_report_to_junit(const NightReport& report, const std::filesystem::path& to_report);

Status write_night_report(const NightReport& report, const std::filesystem::path& out,
                          const std::filesystem::path& project_folder);

// Merges all shards of one night into `out`, with the files of their items. Errors name the report: shards
// that are missing, there twice, damaged, or of another night.
Result<NightReport> merge_night_reports(const std::vector<std::filesystem::path>& files,
                                        const std::filesystem::path& out);

Status copy_folder(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace slipface

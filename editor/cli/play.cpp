#include "cli/play.h"

#include <fmt/format.h>

#include <iostream>

#include "cli/format.h"
#include "cli/verbs.h"
#include "slipface/base/files.h"
#include "slipface/base/system.h"
#include "slipface/base/version.h"
#include "slipface/level/find_start.h"
#include "slipface/level/preset.h"
#include "slipface/reach/search.h"

namespace slipface::cli {
namespace {

Result<std::unique_ptr<Play>> load_alone(const PlayWords& words, const Team* team) {
    Result<LoadedLevel> loaded = load_level(path_of(words.level));
    if (!loaded) return loaded.error();
    if (is_first(team)) print_warnings(std::cerr, loaded->warnings);
    auto play = std::make_unique<Play>();
    play->as_saved = loaded->level;
    play->level = std::move(loaded->level);
    Level& level = play->level;
    if (!words.preset.empty()) {
        const Result<Preset> preset = find_preset(words.preset);
        if (!preset) return Error{"--preset", preset.error().text()};
        level.movement = preset->settings;
    }
    for (const std::string& assignment : words.settings)
        if (const Status status = set_setting(level.movement, assignment); !status)
            return Error{"--set " + assignment, status.error().message};
    const Result<Start> start = settle_start(level, words.spawn);
    if (!start) return Error{"--spawn", start.error().message};
    if (!start->stands) return Error{level.mesh_path.string(), start->note};
    if (!start->note.empty() && is_first(team))
        print_warnings(std::cerr, {{level.mesh_path.string(), start->note}});
    play->start = start->position;
    if (words.threads > 0) play->limit = std::make_unique<ThreadLimit>(words.threads);
    return play;
}

// The first rounds of a search see geometry, types, platforms, settings and start, by every rule of movement.
Status agree_on_play(Team& team, const Play& play, const PlayWords& words) {
    Result<ReachSearch> search = ReachSearch::begin(play.level, play.start, {});
    if (Status status = agree(team, search ? Status() : search.error()); !status) return status;
    constexpr std::uint64_t few_rounds = 3;
    search->run({.rounds = few_rounds});
    const std::filesystem::path program = "/proc/self/exe";
    return agree_on(
        team,
        {{"program", fmt::format("{} {}", program_version(), hash_text(fingerprint_of_files({&program, 1})))},
         {"geometry", hash_text(play.level.mesh.fingerprint())},
         {"level file, settings or start",
          fmt::format("{} at {}", hash_text(search->identity()), vector_text(play.start))},
         {"result of the first steps, and so a processor with other bits,", hash_text(search->hash())},
         {"command line", words.all_options}});
}

}  // namespace

Result<std::unique_ptr<Play>> load_play(const PlayWords& words, Team* team) {
    Result<std::unique_ptr<Play>> play = load_alone(words, team);
    if (team == nullptr) return play;
    if (Status status = agree(*team, play ? Status() : play.error()); !status) return status.error();
    if (Status status = agree_on_play(*team, **play, words); !status) return status.error();
    return play;
}

int fail(const Error& error, const Team* team) {
    return is_first(team) ? bad_input(std::cerr, error) : exit_fine;
}

}  // namespace slipface::cli

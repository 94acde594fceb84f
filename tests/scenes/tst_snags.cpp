// Of planted snags the headline names the right face and the right rule, and the first cure that is offered
// lets the player on. Prints a table of all:
//   build/release/tests/tests_scenes --gtest_filter='Snags.*'
// SLIPFACE_SNAG_SEEDS=FIRST,LAST plants others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numbers>
#include <regex>

#include "default_snags.h"
#include "other_snags.h"
#include "slipface/base/files.h"
#include "slipface/repair/repairs.h"

namespace slipface::test {
namespace {

struct Walk {
    std::vector<Stop> stops;
    double furthest_z = 0.0, furthest_x = 0.0, highest_y = 0.0, lowest_y = 0.0;
    std::vector<Cure> cures;  // of the headline
};

Walk walk(const Level& level, const Tape& tape, bool with_cures) {
    Walk walk;
    Result<LevelScene> built = LevelScene::build(level, level.movement);
    if (!built) {
        ADD_FAILURE() << built.error().text();
        return walk;
    }
    const TickScene scene(*built);
    TapeRun run(std::make_shared<const Tape>(tape), level.movement, level.spawn);
    run.advance(scene, TapeRun::max_ticks);
    walk.stops = find_stops(scene, run, level);
    walk.highest_y = -1e9;
    for (const TickSample& sample : run.samples()) {
        walk.furthest_z = std::min(walk.furthest_z, sample.position.z());
        walk.furthest_x = std::max(walk.furthest_x, sample.position.x());
        walk.lowest_y = std::min(walk.lowest_y, sample.position.y());
        walk.highest_y = std::max(walk.highest_y, sample.position.y());
    }
    if (with_cures && !walk.stops.empty())
        walk.cures = find_cures_and_repairs(level, run, *headline_stop(walk.stops));
    return walk;
}

bool got_on(const Snag& snag, const Walk& walk) {
    return walk.furthest_z < snag.passed_z && walk.furthest_x > snag.passed_x &&
           walk.highest_y > snag.passed_y && walk.lowest_y > snag.lowest_y;
}

bool tells_size(const Snag& snag, const Stop& stop) {
    constexpr double rounded = 0.03;
    return snag.size_m == 0.0 || std::ranges::any_of(stop.numbers, [&](const StoryNumber& number) {
               return std::abs(number.value - snag.size_m) < rounded;
           });
}

// The sections of docs/symptoms.md that quote the headline: what stands between "…" and numbers is in it, in
// that order.
std::set<std::string> sections_that_quote(const std::string& headline) {
    static const std::string page = *read_file(SLIPFACE_SOURCE_DIR "/docs/symptoms.md");
    static const std::regex part("\\n### ([^\\n]+)\\n|\\*Why panel\\*: |\"([^\"]+)\"|\\n- \\*\\*Cure"),
        gap(" *(…|[0-9.]+( m+)?) *");
    std::set<std::string> titles;
    std::string title;
    bool of_why = false;
    for (std::sregex_iterator at(page.begin(), page.end(), part), end; at != end; ++at) {
        const std::string found = at->str(), quote = (*at)[2];
        if ((*at)[1].matched) title = (*at)[1];
        of_why = quote.empty() ? found.starts_with("*Why") : of_why;
        if (!of_why || quote.empty()) continue;
        std::size_t from = 0;
        for (std::sregex_token_iterator piece(quote.begin(), quote.end(), gap, -1), last;
             piece != last && from != headline.npos; ++piece) {
            from = headline.find(piece->str(), from);
            if (from != headline.npos) from += piece->str().size();
        }
        if (from != headline.npos) titles.insert(title);
    }
    return titles;
}

struct Score {
    int snags = 0, headlines = 0, cures = 0, quoted = 0;
};

void judge(const Snag& snag, Score& score) {
    const Walk as_is = walk(snag.level, snag.tape, true);
    // A size at which the walk is not stopped is no snag.
    if (got_on(snag, as_is)) return;
    ++score.snags;
    bool right = false, cured = false;
    std::string headline = "-", cure = "-";
    if (const Stop* stop = headline_stop(as_is.stops)) {
        headline = stop->headline;
        if (const std::set<std::string> titles = sections_that_quote(headline); !titles.empty()) {
            ++score.quoted;
            EXPECT_TRUE(titles.contains(stop->symptom)) << headline << " leads to " << stop->symptom;
        }
        const Mesh& mesh = *snag.level.mesh;
        const bool face =
            snag.group.empty() || (stop->loss.face != no_id && stop->loss.face < mesh.face_count() &&
                                   mesh.groups[mesh.face_group[stop->loss.face]] == snag.group);
        right = face && snag.causes.contains(stop->loss.cause) &&
                headline.find(snag.headline) != std::string::npos && tells_size(snag, *stop);
        if (!as_is.cures.empty()) {
            cure = cure_text(as_is.cures.front());
            Level changed = snag.level;
            EXPECT_TRUE(apply_cure(changed, as_is.cures.front()).ok());
            cured =
                got_on(snag, walk(changed, snag.tape, false)) && cure.find(snag.cure) != std::string::npos;
        }
    }
    score.headlines += right;
    score.cures += cured || !snag.has_cure;
    std::printf("| %s | %s | %s%s | %s%s |\n", snag.kind.c_str(), snag.size.c_str(),
                right ? "" : "WRONG: ", headline.c_str(),
                cured || !snag.has_cure ? "" : "FAILS: ", cure.c_str());
}

std::vector<Snag> all_snags(std::uint64_t seed) {
    SnagMaker maker(seed);
    std::vector<Snag> snags = maker.make();
    for (Snag& snag : maker.make_under_defaults())
        snags.push_back(std::move(snag));
    for (Snag& snag : maker.make_others())
        snags.push_back(std::move(snag));
    return snags;
}

TEST(Snags, TheHeadlineIsRightAndTheFirstCureWorks) {
    Score score;
    std::map<std::string, Score> kinds;
    unsigned long long first = 1, last = 3;
    if (const char* seeds = std::getenv("SLIPFACE_SNAG_SEEDS")) {
        ASSERT_EQ(std::sscanf(seeds, "%llu,%llu", &first, &last), 2) << seeds;
    }
    for (std::uint64_t seed = first; seed <= last; ++seed) {
        for (const Snag& snag : all_snags(seed)) {
            Score one;
            judge(snag, one);
            for (Score* sum : {&score, &kinds[snag.kind]}) {
                sum->snags += one.snags;
                sum->headlines += one.headlines;
                sum->cures += one.cures;
                sum->quoted += one.quoted;
            }
        }
    }
    for (const auto& [kind, sum] : kinds)
        std::printf("%-34s %3d snags, %3d headlines, %3d cures\n", kind.c_str(), sum.snags, sum.headlines,
                    sum.cures);
    std::printf("%d snags, %d right headlines, %d first cures that work\n", score.snags, score.headlines,
                score.cures);
    EXPECT_GE(score.snags, 40);
    EXPECT_GE(score.quoted, 0.3 * score.snags);
    EXPECT_GE(score.headlines, 0.95 * score.snags);
    EXPECT_GE(score.cures, 0.90 * score.snags);
}

// Of a fall the same is blamed, with the same cure, whether it ends below the level or on a floor; but not
// what a player touched on its way, which may be the wall below a ledge.
TEST(Snags, AFloorBelowChangesNoCauseOfAFall) {
    int falls = 0;
    for (std::uint64_t seed = 11; seed <= 13; ++seed) {
        const std::vector<Snag> open = all_snags(seed);
        cellar = true;
        const std::vector<Snag> closed = all_snags(seed);
        cellar = false;
        for (std::size_t i = 0; i < open.size(); ++i) {
            if (!open[i].causes.contains(StopCause::fall)) continue;
            const Walk out = walk(open[i].level, open[i].tape, true);
            const Stop* stop = headline_stop(out.stops);
            const std::set<FallCause> causes{FallCause::not_solid, FallCause::one_sided, FallCause::by_type,
                                             FallCause::pushed};
            if (stop == nullptr || !causes.contains(stop->fall)) continue;
            const std::string what = open[i].kind + ", " + open[i].size;
            const Walk down = walk(closed[i].level, closed[i].tape, true);
            const auto same = std::ranges::find(down.stops, stop->headline, &Stop::headline);
            ++falls;
            if (same == down.stops.end()) {
                ADD_FAILURE() << what << ": " << stop->headline << "\n" << stops_text(down.stops, 1.0 / 60);
                continue;
            }
            EXPECT_GT(same->fell_m, 3.0) << what;
            if (headline_stop(down.stops) != &*same) continue;  // the cures are those of what came later
            EXPECT_EQ(out.cures.empty(), down.cures.empty()) << what;
            if (out.cures.empty() || down.cures.empty()) continue;
            EXPECT_EQ(out.cures.front().text, down.cures.front().text) << what;
        }
    }
    EXPECT_GE(falls, 12);
}

TEST(Snags, AWalkThatNothingStopsHasNoHeadline) {
    MovementSettings s = lecture_settings();
    for (const double slope : {0.0, 20.0, 45.0, 49.5}) {
        Shapes shapes;
        shapes.group("floor").box({-8, -1, -30}, {8, 0, 5});
        if (slope > 0.0)
            shapes.group("ramp").ramp({-4, 0, -2}, 8, 20, 20 * std::tan(slope * std::numbers::pi / 180));
        const Snag free =
            snag_of("free", "", shapes, s, {}, "15 wish 0,0\n90 wish 0,-1\n20 wish 0,0\n40 wish 1,0\n");
        const Walk walked = walk(free.level, free.tape, false);
        EXPECT_TRUE(walked.stops.empty()) << slope << ": " << stops_text(walked.stops, 1.0 / 60);
    }
}

}  // namespace
}  // namespace slipface::test

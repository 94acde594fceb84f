// slipface_reach_truth [COUNT [FIRST [SCENE]]]: COUNT random scenes of each kind (or only of SCENE) from seed
// FIRST on, at 50 to 105 % of what an exhaustive search in a bare scene finds possible
// (docs/reach.md, "Truth").
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "known_scenes.h"

int main(int argc, char** argv) {
    using namespace slipface;
    using namespace slipface::test;
    const int count = argc > 1 ? std::atoi(argv[1]) : 12;
    const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
    const std::string_view only = argc > 3 ? argv[3] : "";
    // What is impossible is searched for less long: every round of it is one too many.
    constexpr std::uint64_t max_rounds = 1500, rounds_beyond = 100;
    constexpr std::array<double, 7> fractions{0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 1.05};
    fmt::print("| scene | of the possible | scenes | reached | steps, median | steps, most | false |\n");
    fmt::print("|---|---:|---:|---:|---:|---:|---:|\n");
    for (const KnownScene& kind : known_scenes()) {
        if (!only.empty() && only != kind.name) continue;
        std::vector<std::pair<Draw, double>> drawn;
        for (int i = 0; i < count; ++i) {
            const Draw draw = draw_of(first + static_cast<std::uint64_t>(i));
            drawn.emplace_back(draw, kind.maximum(draw, 20));
        }
        for (const double fraction : fractions) {
            if (!kind.sized && fraction != fractions.front() && fraction < 1.0) continue;
            std::vector<std::uint64_t> steps;
            int false_yes = 0;
            for (const auto& [draw, maximum] : drawn) {
                const ReachScene scene = kind.make(draw, fraction, maximum);
                const FaceId face = face_at(scene.level, scene.target);
                ReachSearch search = search_of(scene, 0);
                const bool found =
                    rounds_until(search, face, fraction > 1.0 ? rounds_beyond : max_rounds).has_value();
                if (found) steps.push_back(search.steps());
                const std::string problem = false_claims(search);
                false_yes += problem.empty() ? 0 : 1;
                if (!problem.empty() || found != (fraction < 1.0))
                    fmt::print(stderr, "seed {}, {} at {:.0f} %: {} after {} steps {}\n", draw.seed,
                               kind.name, 100.0 * fraction, found ? "found" : "not found", search.steps(),
                               problem);
            }
            std::sort(steps.begin(), steps.end());
            const std::string of = kind.sized       ? fmt::format("{:.0f} %", 100.0 * fraction)
                                   : fraction < 1.0 ? "possible"
                                                    : "impossible";
            fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", kind.name, of, count, steps.size(),
                       steps.empty() ? 0 : steps[steps.size() / 2], steps.empty() ? 0 : steps.back(),
                       false_yes);
            std::fflush(stdout);
        }
    }
}

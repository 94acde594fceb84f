// slipface_reach_truth [COUNT [FIRST]]: COUNT random gaps and ledges from seed FIRST on, each at 50 to 105 %
// of what an exhaustive search of straight jumps finds possible, and the table of docs/reach.md, "Truth".
#include <fmt/format.h>

#include <array>
#include <cstdlib>

#include "reach_scenes.h"

int main(int argc, char** argv) {
    using namespace slipface;
    using namespace slipface::test;
    const int count = argc > 1 ? std::atoi(argv[1]) : 40;
    const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
    // What is impossible is searched for less long: every round of it is one too many.
    constexpr std::uint64_t max_rounds = 1500, rounds_beyond = 300;
    constexpr std::array<double, 7> fractions{0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 1.05};
    fmt::print("| scene | of the possible | scenes | reached | steps, median | steps, most | false |\n");
    fmt::print("|---|---:|---:|---:|---:|---:|---:|\n");
    for (const bool ledge : {false, true}) {
        std::vector<std::pair<MovementSettings, double>> drawn;
        for (int i = 0; i < count; ++i) {
            std::mt19937_64 random(first + static_cast<std::uint64_t>(i));
            const MovementSettings settings = random_settings(random);
            drawn.emplace_back(settings, max_possible(settings, ledge, 20));
        }
        for (const double fraction : fractions) {
            std::vector<std::uint64_t> steps;
            int false_yes = 0;
            for (int i = 0; i < count; ++i) {
                const auto& [settings, maximum] = drawn[static_cast<std::size_t>(i)];
                std::mt19937_64 random(first + 1000 + static_cast<std::uint64_t>(i));
                const double yaw = std::uniform_real_distribution<double>(0.0, 6.28)(random);
                const ReachScene scene = ledge ? gap_scene(settings, 0.5, fraction * maximum, yaw)
                                               : gap_scene(settings, fraction * maximum, 0.0, yaw);
                ReachSearch search = search_of(scene, 0);
                const FaceId face = face_at(scene.level, scene.target);
                const bool found =
                    rounds_until(search, face, fraction > 1.0 ? rounds_beyond : max_rounds).has_value();
                if (found) steps.push_back(search.steps());
                if (const std::string problem = false_claims(search); !problem.empty()) {
                    ++false_yes;
                    fmt::print(stderr, "seed {}, {:.0f} %: {}\n", first + static_cast<std::uint64_t>(i),
                               100.0 * fraction, problem);
                }
                if (!found && fraction < 1.0)
                    fmt::print(stderr, "seed {}, {} at {:.0f} %: not found after {} steps\n",
                               first + static_cast<std::uint64_t>(i), ledge ? "ledge" : "gap",
                               100.0 * fraction, search.steps());
            }
            std::sort(steps.begin(), steps.end());
            fmt::print("| {} | {:.0f} % | {} | {} | {} | {} | {} |\n", ledge ? "ledge" : "gap",
                       100.0 * fraction, count, steps.size(), steps.empty() ? 0 : steps[steps.size() / 2],
                       steps.empty() ? 0 : steps.back(), false_yes);
            std::fflush(stdout);
        }
    }
}

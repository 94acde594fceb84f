// Every demo: with the switch on the hack acts and the run is another; off, the trace names the switch that
// would have helped.
#include <gtest/gtest.h>

#include <algorithm>

#include "slipface/scenes/demo.h"
#include "slipface/sim/run.h"

namespace slipface::test {
namespace {

struct DemoRun {
    LevelScene level;
    TickScene scene;
    TapeRun run;

    DemoRun(const Demo& demo, const MovementSettings& settings, const Tape& tape)
        : level(std::move(LevelScene::build(demo.level, settings).value())),
          scene(level),
          run(std::make_shared<const Tape>(tape), settings, demo.tape.start.value_or(demo.level.spawn)) {
        run.advance(scene, TapeRun::max_ticks);
    }
    // A choice has no switch: it refuses.
    bool says_switched_off(std::string_view hack) const {
        const bool choice = is_choice(*find_setting(hack));
        for (std::size_t tick = 0; tick < run.samples().size(); ++tick) {
            for (const TraceRecord& record : run.trace(scene, tick).records) {
                const auto* decision = std::get_if<DecisionRecord>(&record);
                if (decision == nullptr) continue;
                const DecisionInfo& info = decision_info(decision->kind);
                if (info.hack == hack &&
                    (info.outcome == Outcome::switched_off || (choice && info.outcome == Outcome::refused)))
                    return true;
            }
        }
        return false;
    }
};

class DemoTraces : public testing::TestWithParam<DemoInfo> {};

TEST_P(DemoTraces, NameTheirSwitch) {
    const DemoInfo& info = GetParam();
    const Demo demo = make_demo(info);
    EXPECT_NE(demo.on == demo.off, demo.tape.mover == demo.off_tape.mover) << "one thing differs";
    const DemoRun on(demo, demo.on, demo.tape);
    const auto row = hack_row(info.hack);
    if (row) {
        EXPECT_GT(on.run.acted_count(*row), 0U);
    }
    const DemoRun off(demo, demo.off, demo.off_tape);
    double apart = 0.0;
    for (std::size_t tick = 0; tick < on.run.samples().size(); ++tick)
        apart = std::max(apart, (on.run.samples()[tick].position - off.run.samples()[tick].position).norm());
    EXPECT_GT(apart, 0.25) << "the runs with the switch off and on look alike";
    // The lecture's mover decides nothing: it only sweeps and responds.
    if (plays_lecture(info)) return;
    // Without sectors a scene is built in one piece, and no step knows that there could have been some.
    if (std::string_view(info.hack) == "sectors") return;
    EXPECT_TRUE(off.says_switched_off(info.hack));
}

INSTANTIATE_TEST_SUITE_P(All, DemoTraces, testing::ValuesIn(demo_table().begin(), demo_table().end()),
                         [](const auto& test) {
                             std::string name = test.param.name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace slipface::test

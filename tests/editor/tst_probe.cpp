#include <gmock/gmock.h>

#include <cmath>

#include "level_fixture.h"
#include "tools/lab/probe.h"

namespace slipface {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

using ProbeTest = LevelFixture;

TEST_F(ProbeTest, StandsJustClearOfTheFloor) {
    const auto document = open();
    const MovementSettings& movement = document->level().movement;
    Probe probe;
    probe.place_on(Vec3(3.5, 0, 3.5), Vec3::UnitY(), movement);
    EXPECT_TRUE(probe.placed);
    // The lowest point of the ellipsoid is one skin above the floor: 0.9 + 0.002.
    EXPECT_LT((probe.from - Vec3(3.5, 0.902, 3.5)).norm(), 1e-12);
    EXPECT_FALSE(overlaps_any(document->collision(), movement.radii, probe.from));
    EXPECT_TRUE(
        overlaps_any(document->collision(), movement.radii, probe.from - Vec3(0, 2 * movement.skin, 0)));
}

TEST_F(ProbeTest, TouchesTheSlopeWhereItWasPlaced) {
    // A slope of 30 degrees: 4 m wide, rising along x.
    const double rise = 20 * std::tan(3.14159265358979 / 6);
    std::ostringstream text;
    text << "v -20 " << -rise << " -20\nv -20 " << -rise << " 20\nv 20 " << rise << " 20\nv 20 " << rise
         << " -20\nf 1 2 3 4\n";
    write_text(obj, text.str());
    const auto document = open();
    const MovementSettings& movement = document->level().movement;
    const Vec3 normal = face_normal(document->mesh(), 0);
    ASSERT_GT(normal.y(), 0.8);
    Probe probe;
    probe.place_on(Vec3::Zero(), 3.0 * normal, movement);  // any length will do
    EXPECT_FALSE(overlaps_any(document->collision(), movement.radii, probe.from));
    const auto contact =
        sweep_ellipsoid(document->collision(), movement.radii, probe.from, -2.0 * movement.skin * normal);
    ASSERT_TRUE(contact.has_value());
    EXPECT_NEAR(contact->t, 0.5, 1e-3);  // one of the two skins
    EXPECT_LT(contact->point.norm(), movement.skin);
}

TEST_F(ProbeTest, OddNormalsFallBackToUp) {
    Probe probe;
    probe.place_on(Vec3(1, 2, 3), Vec3::Zero(), {});
    EXPECT_LT((probe.from - Vec3(1, 2.902, 3)).norm(), 1e-12);
    Probe nowhere;
    nowhere.place_on(Vec3(std::nan(""), 0, 0), Vec3::UnitY(), {});
    EXPECT_FALSE(nowhere.placed);
}

TEST_F(ProbeTest, SweepsIntoTheWallAndExplainsWhy) {
    const auto document = open();
    Probe probe;
    probe.place_on(Vec3(6, 0, 4), Vec3::UnitY(), document->level().movement);
    probe.move = Vec3(4, 0, 0);  // the wall stands at x = 8, 1 m high
    const ProbeResult result = run_probe(probe, document->scene(), document->level().movement);
    EXPECT_FALSE(result.starts_overlapping);
    EXPECT_GE(result.slide.contacts, 1);
    EXPECT_LT(result.slide.position.x(), 7.7);
    const std::vector<ProbeRow> rows = probe_rows(result.records);
    ASSERT_FALSE(rows.empty());
    ASSERT_TRUE(rows[0].sweep.contact.has_value());
    EXPECT_GE(rows[0].sweep.contact->face, wall);
    ASSERT_TRUE(rows[0].response.has_value());

    probe.from.x() = 8;
    EXPECT_TRUE(run_probe(probe, document->scene(), document->level().movement).starts_overlapping);
}

TEST_F(ProbeTest, RowsJoinASweepWithItsResponses) {
    SweepRecord first, second;
    first.iteration = 0;
    second.iteration = 1;
    ResponseRecord turned, cut;
    turned.remainder_before = Vec3(3, 0, 0);
    turned.remainder_after = Vec3(2, 0, 0);
    cut.rule = Rule::crease;
    cut.remainder_before = Vec3(2, 0, 0);
    cut.remainder_after = Vec3(1, 0, 0);
    const std::vector<TraceRecord> records{turned,          first, DecisionRecord{}, turned, cut,
                                           PushOutRecord{}, second};
    const std::vector<ProbeRow> rows = probe_rows(records);
    ASSERT_THAT(rows, SizeIs(2));  // a response without a sweep belongs to none
    ASSERT_TRUE(rows[0].response.has_value());
    EXPECT_EQ(rows[0].response->rule, Rule::crease);
    EXPECT_EQ(rows[0].response->remainder_before.x(), 3);
    EXPECT_EQ(rows[0].response->remainder_after.x(), 1);
    EXPECT_EQ(rows[1].sweep.iteration, 1);
    EXPECT_FALSE(rows[1].response.has_value());
}

TEST_F(ProbeTest, CommandLineRepeatsTheSweep) {
    Probe probe{true, Vec3(-1.5, 0.1, 2), Vec3(0, -1, 1e-7)};
    MovementSettings movement;
    EXPECT_EQ(probe_command_line(probe, movement, "levels/easy.obj"),
              "slipface sweep levels/easy.obj --radii=0.4,0.9,0.4 --from=-1.5,0.1,2 --move=0,-1,1e-07");
    EXPECT_THAT(probe_command_line(probe, movement, "my level's.obj"), HasSubstr(" 'my level'\\''s.obj' "));
    EXPECT_THAT(probe_command_line(probe, movement, "$(rm x).obj"), HasSubstr(" '$(rm x).obj' "));
    EXPECT_THAT(probe_command_line(probe, movement, "-x.obj"), HasSubstr(" ./'-x.obj' "));
}

}  // namespace
}  // namespace slipface

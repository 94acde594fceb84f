#include <gtest/gtest.h>

#include <algorithm>

#include "slipface/render/trace_overlay.h"

namespace slipface {
namespace {

bool operator==(const Color& a, const Color& b) {
    return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

const Vec3 radii(0.4, 0.9, 0.4);

// Two sweeps along +X; the first meets a wall at half of its way, the remainder turns to +Z.
std::vector<TraceRecord> two_sweeps() {
    SweepRecord first;
    first.move = {2, 0, 0};
    first.reached = {0.99, 0, 0};
    Contact contact;
    contact.t = 0.5;
    contact.normal = {-1, 0, 0};
    contact.point = {1.4, 0, 0};
    first.contact = contact;
    ResponseRecord response;
    response.remainder_before = {1, 0, 0};
    response.remainder_after = {0, 0, 0.5};
    SweepRecord second;
    second.from = first.reached;
    second.move = response.remainder_after;
    second.reached = second.from + second.move;
    return {first, response, second, DecisionRecord{}};
}

std::size_t arrows(const Overlay& overlay, const Color& color) {
    return static_cast<std::size_t>(
        std::count_if(overlay.lines.begin(), overlay.lines.end(),
                      [&](const auto& line) { return line.arrow && line.color == color; }));
}

// One ghost where it started and one a sweep, in the order's colours, where the sweeps ended.
TEST(TraceOverlay, OneGhostASweep) {
    Overlay overlay;
    draw_trace(overlay, two_sweeps(), radii);
    ASSERT_EQ(overlay.ellipsoids.size(), 3U);
    EXPECT_EQ(overlay.ellipsoids[0].centre, Vec3::Zero());
    EXPECT_TRUE(overlay.ellipsoids[0].outline == trace_colors::start);
    EXPECT_EQ(overlay.ellipsoids[1].centre, Vec3(0.99, 0, 0));
    EXPECT_TRUE(overlay.ellipsoids[1].outline == sweep_color(0));
    EXPECT_EQ(overlay.ellipsoids[2].centre, Vec3(0.99, 0, 0.5));
    EXPECT_TRUE(overlay.ellipsoids[2].outline == sweep_color(1));
    for (const auto& ellipsoid : overlay.ellipsoids)
        EXPECT_EQ(ellipsoid.radii, radii);
}

// Remainders start at the centre at the contact: from + t * move = (1, 0, 0).
TEST(TraceOverlay, RemaindersAndNormalInTheirColours) {
    Overlay overlay;
    draw_trace(overlay, two_sweeps(), radii);
    EXPECT_EQ(arrows(overlay, trace_colors::remainder_before), 1U);
    EXPECT_EQ(arrows(overlay, trace_colors::remainder_after), 1U);
    EXPECT_EQ(arrows(overlay, trace_colors::normal), 1U);
    const auto after = std::find_if(overlay.lines.begin(), overlay.lines.end(), [](const auto& line) {
        return line.arrow && line.color == trace_colors::remainder_after;
    });
    EXPECT_EQ(after->a, Vec3(1, 0, 0));
    EXPECT_EQ(after->b, Vec3(1, 0, 0.5));
}

TEST(TraceOverlay, StyleSwitchesPartsOff) {
    TraceStyle style;
    style.ghosts = style.contacts = style.planes = style.remainders = false;
    Overlay overlay;
    draw_trace(overlay, two_sweeps(), radii, style);
    EXPECT_TRUE(overlay.ellipsoids.empty());
    EXPECT_TRUE(overlay.triangles.empty());
    EXPECT_EQ(arrows(overlay, trace_colors::remainder_before), 0U);
    EXPECT_EQ(arrows(overlay, trace_colors::normal), 0U);
    EXPECT_FALSE(overlay.lines.empty());
}

TEST(TraceOverlay, OpacityScalesEverything) {
    TraceStyle style;
    style.opacity = 0.25f;
    Overlay overlay;
    draw_trace(overlay, two_sweeps(), radii, style);
    for (const auto& line : overlay.lines)
        EXPECT_LE(line.color.alpha, 0.25f);
    for (const auto& ellipsoid : overlay.ellipsoids)
        EXPECT_LE(ellipsoid.outline.alpha, 0.25f);
    for (const auto& triangle : overlay.triangles)
        EXPECT_LE(triangle.color.alpha, 0.25f);
}

TEST(TraceOverlay, PushOutIsAnArrowToAGhost) {
    PushOutRecord push;
    push.from = {0, 1, 0};
    push.to = {0, 1.5, 0};
    Overlay overlay;
    draw_trace(overlay, std::vector<TraceRecord>{push}, radii);
    EXPECT_EQ(arrows(overlay, trace_colors::push_out), 1U);
    ASSERT_EQ(overlay.ellipsoids.size(), 2U);
    EXPECT_EQ(overlay.ellipsoids[1].centre, push.to);
}

TEST(TraceOverlay, EmptyTraceAndLoneResponseDrawNothing) {
    Overlay overlay;
    draw_trace(overlay, {}, radii);
    draw_trace(overlay, std::vector<TraceRecord>{ResponseRecord{}, DecisionRecord{}}, radii);
    EXPECT_TRUE(overlay.lines.empty() && overlay.ellipsoids.empty() && overlay.triangles.empty());
}

TEST(TraceOverlay, SweepColoursDifferAndEnd) {
    for (int i = 0; i < 5; ++i)
        EXPECT_FALSE(sweep_color(i) == sweep_color(i + 1));
    EXPECT_TRUE(sweep_color(5) == sweep_color(1000));
    EXPECT_TRUE(sweep_color(-1) == sweep_color(0));
}

}  // namespace
}  // namespace slipface

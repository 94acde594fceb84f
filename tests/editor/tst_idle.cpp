#include "app_fixture.h"

namespace slipface {
namespace {

using IdleTest = AppFixture;

TEST_F(IdleTest, NothingIsDrawnOnceTheFrameHasSettled) {
    host->settle();
    EXPECT_TRUE(host->draw_if_needed());
    for (int i = 0; i < 5; ++i) {
        host->frame();
        EXPECT_FALSE(host->app().needs_drawing()) << i;
        EXPECT_FALSE(host->draw_if_needed());
        EXPECT_FALSE(host->app().context().animating);
    }
}

TEST_F(IdleTest, WhatCanBeSeenChangesNeedsDrawing) {
    host->settle();
    host->draw_if_needed();
    // The picture of the level alone, with no letter of the user interface changed.
    editor().view.yaw += 0.01;
    host->frame();
    EXPECT_TRUE(host->app().needs_drawing());
    host->draw_if_needed();
    host->frame();
    EXPECT_FALSE(host->app().needs_drawing());
    editor().style.wireframe = !editor().style.wireframe;
    host->frame();
    EXPECT_TRUE(host->app().needs_drawing());
    host->draw_if_needed();
    editor().document->paint(std::vector<FaceId>{3}, ice);
    host->frame();
    EXPECT_TRUE(host->app().needs_drawing());
    host->draw_if_needed();
    host->app().redraw();
    EXPECT_TRUE(host->app().needs_drawing());
}

TEST_F(IdleTest, TheFirstImageOfALargeLevelIsADraftAndTheNextIsFull) {
    host->settle();
    const Image full = host->screenshot();
    OffscreenOptions options;
    options.draft_from = document().level().mesh.triangle_count();
    start(options);
    host->settle();
    EXPECT_TRUE(host->app().context().animating);
    EXPECT_NE(host->screenshot().rgba, full.rgba);
    host->frame();
    EXPECT_FALSE(host->app().context().animating);
    EXPECT_TRUE(host->app().needs_drawing());
    EXPECT_EQ(host->screenshot().rgba, full.rgba);
    editor().view.yaw += 0.01;
    host->frame();
    host->screenshot();
    EXPECT_FALSE(host->app().needs_drawing());
}

TEST_F(IdleTest, PlayingAnimatesAndComesToRestAfterwards) {
    start_playtest(editor());
    host->frame();
    EXPECT_TRUE(host->app().context().animating);
    stop_playtest(editor());
    host->settle();
    EXPECT_FALSE(host->app().context().animating);
}

TEST_F(IdleTest, SettlingEndsSoonAfterAnEvent) {
    host->settle();
    ASSERT_EQ(run("hover \"Toolbar/Paint\""), "");
    EXPECT_LE(host->settle(), 5);
    ASSERT_EQ(run("click \"Menu/File\""), "");
    EXPECT_LE(host->settle(), 5);
}

TEST_F(IdleTest, TwoRunsGiveTheSamePixels) {
    const auto image = [this] {
        start({});
        EXPECT_EQ(
            run("camera eye 4,9,14 target 4,0,4\nkey 1\nkey B\nviewport drag @0.5,0,4.5 @7.5,0,4.5\nclick "
                "\"Menu/Edit\""),
            "");
        return host->screenshot();
    };
    const Image first = image();
    EXPECT_EQ(first, image());
    EXPECT_EQ(first.pixel_count(), std::size_t{1280} * 720);
}

}  // namespace
}  // namespace slipface

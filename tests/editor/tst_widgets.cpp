#include <imgui_internal.h>

#include "app_fixture.h"
#include "widgets/theme.h"

namespace slipface {
namespace {

using WidgetsTest = AppFixture;

TEST_F(WidgetsTest, TheFontsHoldLettersPunctuationAndIcons) {
    const ui::Font& font = ui::fonts().regular;
    ASSERT_NE(font.face, nullptr);
    for (const int glyph :
         {0x41, 0xe4, 0x2026, 0x2013, 0x2014, 0xd7, 0xb0, 0xb7, 0x2192, 0x2022, 0xf04b, 0xf071, 0xf07c})
        EXPECT_TRUE(ui::has_glyph(font, static_cast<unsigned>(glyph))) << std::hex << glyph;
    EXPECT_FALSE(ui::has_glyph(font, 0x4e2d));
    // Every icon of the table of commands has its glyph.
    for (const Command& command : commands()) {
        if (!*command.icon) continue;
        unsigned code = 0;
        ImTextCharFromUtf8(&code, command.icon, nullptr);
        EXPECT_TRUE(ui::has_glyph(font, code)) << command.id;
    }
}

TEST_F(WidgetsTest, FontsGrowWithTheScaleByWholePixels) {
    EXPECT_EQ(ui::fonts().regular.pixels, 16.0f);
    OffscreenOptions options;
    options.scale = 1.5f;
    start(options);
    EXPECT_EQ(ui::fonts().regular.pixels, 24.0f);
    EXPECT_EQ(ui::fonts().small.pixels, 21.0f);
    EXPECT_EQ(ui::scale(), 1.5f);
}

TEST_F(WidgetsTest, EveryWidgetLiesInTheWindowOrIsMarkedAsOutOfSight) {
    host->settle();
    ASSERT_GT(ui::widgets().size(), 30u);
    for (const auto& [path, rect] : ui::widgets()) {
        EXPECT_LE(rect.min.x, rect.max.x) << path;
        EXPECT_LE(rect.min.y, rect.max.y) << path;
        if (!rect.visible) continue;
        EXPECT_TRUE(rect.centre().x >= 0 && rect.centre().x < 1280 && rect.centre().y >= 0 &&
                    rect.centre().y < 720)
            << path;
    }
}

TEST_F(WidgetsTest, PathsAreMadeOfScopesAndVisibleNames) {
    EXPECT_EQ(ui::widget_path("Save"), "Save");
    const ui::Scope menu("Menu");
    {
        const ui::Scope file("File##1");
        EXPECT_EQ(ui::widget_path("Save as\u2026##id"), "Menu/File/Save as\u2026");
        EXPECT_EQ(ui::widget_path("##Path"), "Menu/File/Path");
        EXPECT_EQ(ui::widget_path("###Path"), "Menu/File/Path");
    }
    EXPECT_EQ(ui::widget_path("Edit"), "Menu/Edit");
}

TEST_F(WidgetsTest, DisabledWidgetsAreKnownAsSuch) {
    host->settle();
    ASSERT_TRUE(ui::widgets().contains("Toolbar/Undo"));
    EXPECT_FALSE(ui::widgets().find("Toolbar/Undo")->second.enabled);
    EXPECT_TRUE(ui::widgets().find("Toolbar/Paint")->second.enabled);
    ASSERT_EQ(run("set gravity=3"), "");
    EXPECT_TRUE(ui::widgets().find("Toolbar/Undo")->second.enabled);
}

}  // namespace
}  // namespace slipface

#include <gtest/gtest.h>

#include <filesystem>

#include "slipface/level/preset.h"

namespace slipface {
namespace {

TEST(Presets, FilesAndProgramAgree) {
    ASSERT_EQ(shipped_presets().size(), 5U);
    for (const ShippedPreset& shipped : shipped_presets()) {
        const auto path = std::filesystem::path(SLIPFACE_SOURCE_DIR) / "assets" / "presets" /
                          (std::string(shipped.id) + ".json");
        const Result<Preset> loaded = load_preset(path);
        ASSERT_TRUE(loaded.ok()) << loaded.error().text();
        EXPECT_EQ(*loaded, shipped.preset) << shipped.id;
        const Result<Preset> found = find_preset(shipped.id);
        ASSERT_TRUE(found.ok());
        EXPECT_EQ(*found, shipped.preset);
    }
}

TEST(Presets, AreSavedAndLoadedWithoutLoss) {
    Preset mine{.name = "Mine", .about = "A \"test\"", .settings = {}};
    mine.settings.gravity = 0.1 + 0.2;
    mine.settings.step_up = true;
    const Result<Preset> read = preset_from_json(preset_to_json(mine), "mine.json");
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_EQ(*read, mine);
}

TEST(Presets, TheDefaultsAreThePlatformer) {
    EXPECT_EQ(find_preset("platformer").value().settings, MovementSettings{});
    const MovementSettings s;
    EXPECT_TRUE(s.step_up && s.snap_down && s.seam_filter && s.coyote && s.jump_buffer);
    EXPECT_EQ(s.push_out, PushOut::analytic);
}

TEST(Presets, ASettingThatTheFileDoesNotNameIsTheBasicOne) {
    const Result<Preset> read =
        preset_from_json(R"({"slipface_preset": 1, "name": "x", "movement": {"gravity": 3}})", "p.json");
    ASSERT_TRUE(read.ok()) << read.error().text();
    MovementSettings expected = basic_settings();
    expected.gravity = 3.0;
    EXPECT_EQ(read->settings, expected);
}

TEST(Presets, TheNearestOneIsNamedWithWhatDiffers) {
    for (const ShippedPreset& shipped : shipped_presets()) {
        EXPECT_EQ(nearest_preset(shipped.preset.settings).preset, &shipped);
        // A few changed rows leave it the nearest preset, and exactly these are reported.
        for (std::size_t row = 0; row + 2 < settings_table().size(); ++row) {
            MovementSettings settings = shipped.preset.settings;
            const SettingInfo &one = settings_table()[row], &other = settings_table()[row + 2];
            for (const SettingInfo* info : {&one, &other}) {
                const double now = get_setting(settings, *info);
                ASSERT_TRUE(
                    set_setting(settings, *info, now == info->minimum ? info->maximum : info->minimum).ok());
            }
            const PresetMatch match = nearest_preset(settings);
            if (match.preset != &shipped) {
                EXPECT_LT(match.changed.size(), 3U);  // another differs by as little
                continue;
            }
            EXPECT_EQ(match.changed, (std::vector<const SettingInfo*>{&one, &other}));
        }
    }
}

TEST(Presets, ErrorsNameThePlace) {
    const auto error = [](const char* json) {
        const Result<Preset> preset = preset_from_json(json, "p.json");
        return preset ? std::string() : preset.error().text();
    };
    EXPECT_NE(error("{").find("p.json:1"), std::string::npos);
    EXPECT_NE(error("{}").find("slipface_preset"), std::string::npos);
    for (const std::string version : {"0", "2"}) {
        const std::string preset = "{\"slipface_preset\": " + version + R"(, "name": "x", "movement": {}})";
        EXPECT_NE(error(preset.c_str()).find("/slipface_preset"), std::string::npos) << version;
    }
    EXPECT_NE(
        error(R"({"slipface_preset": 1, "name": "x", "movement": {"gravty": 3}})").find("/movement/gravty"),
        std::string::npos);
    EXPECT_NE(error(R"({"slipface_preset": 1, "name": "x", "movement": {"gravity": -3}})")
                  .find("/movement/gravity"),
              std::string::npos);
    EXPECT_FALSE(find_preset("no-such-preset").ok());
}

}  // namespace
}  // namespace slipface

#include <gtest/gtest.h>

#include <filesystem>

#include "slipface/level/preset.h"

namespace slipface {
namespace {

TEST(Presets, files_and_program_agree) {
    ASSERT_EQ(shipped_presets().size(), 4U);
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

TEST(Presets, are_saved_and_loaded_without_loss) {
    Preset mine{.name = "Mine", .about = "A \"test\"", .settings = {}};
    mine.settings.gravity = 0.1 + 0.2;
    mine.settings.step_up = true;
    const Result<Preset> read = preset_from_json(preset_to_json(mine), "mine.json");
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_EQ(*read, mine);
}

TEST(Presets, errors_name_the_place) {
    const auto error = [](const char* json) {
        const Result<Preset> preset = preset_from_json(json, "p.json");
        return preset ? std::string() : preset.error().text();
    };
    EXPECT_NE(error("{").find("p.json:1"), std::string::npos);
    EXPECT_NE(error("{}").find("slipface_preset"), std::string::npos);
    EXPECT_NE(error(R"({"slipface_preset": 2, "name": "x", "movement": {}})").find("/slipface_preset"),
              std::string::npos);
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

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include "test_geometry.h"

namespace slipface::test {

using ::testing::HasSubstr;

TEST(SettingsTable, DescribesEverySettingCompletely) {
    std::set<std::string> names;
    const MovementSettings defaults;
    for (const SettingInfo& info : settings_table()) {
        EXPECT_TRUE(names.insert(info.name).second) << info.name;
        EXPECT_STRNE(info.label, "") << info.name;
        EXPECT_STRNE(info.meaning, "") << info.name;
        EXPECT_STRNE(info.group, "") << info.name;
        EXPECT_LT(info.minimum, info.maximum) << info.name;
        EXPECT_GE(get_setting(defaults, info), info.minimum) << info.name;
        EXPECT_LE(get_setting(defaults, info), info.maximum) << info.name;
        EXPECT_EQ(find_setting(info.name), &info);
        EXPECT_EQ(std::string(info.too_small).empty(), is_switch(info) || is_choice(info)) << info.name;
        EXPECT_EQ(std::string(info.too_large).empty(), is_switch(info) || is_choice(info)) << info.name;
        if (*info.switch_name != '\0') {
            EXPECT_NE(find_setting(info.switch_name), nullptr) << info.name;
        }
    }
    for (const char* group : {"Body", "Speed", "Collision", "Hacks", "Jump", "Moves"}) {
        bool used = false;
        for (const SettingInfo& info : settings_table())
            used = used || std::string(info.group) == group;
        EXPECT_TRUE(used) << group;
    }
    EXPECT_EQ(find_setting("no_such"), nullptr);
}

TEST(SettingsTable, HasASectionOfThePageForEveryHack) {
    std::ifstream file(SLIPFACE_SOURCE_DIR "/docs/movement.md");
    const std::string page(std::istreambuf_iterator<char>(file), {});
    for (const SettingInfo& info : settings_table()) {
        const std::string_view group = info.group;
        // The numbers of a hack are listed in docs/settings.md, which is made from this table.
        if ((group != "Hacks" && group != "Jump" && group != "Moves") || *info.switch_name) continue;
        EXPECT_NE(page.find(std::string("`") + info.name + "`"), std::string::npos)
            << info.name << " is not in docs/movement.md";
    }
}

TEST(SettingsTable, ReachesEveryMember) {
    // Every row sets its own member and no other: set all rows to their minimum one by one; each must change
    // the struct.
    for (const SettingInfo& info : settings_table()) {
        const MovementSettings defaults;
        MovementSettings changed;
        const double other = get_setting(defaults, info) == info.minimum ? info.maximum : info.minimum;
        ASSERT_TRUE(set_setting(changed, info, other).ok()) << info.name;
        EXPECT_EQ(get_setting(changed, info), other);
        EXPECT_FALSE(changed == defaults) << info.name;
        for (const SettingInfo& unrelated : settings_table()) {
            if (&unrelated == &info) continue;
            EXPECT_EQ(get_setting(changed, unrelated), get_setting(defaults, unrelated)) << info.name;
        }
        // And back through its text.
        MovementSettings read;
        ASSERT_TRUE(set_setting(read, std::string(info.name) + "=" + setting_text(changed, info)).ok())
            << info.name;
        EXPECT_TRUE(read == changed) << info.name;
    }
}

TEST(SetSetting, ReadsNumbersSwitchesChoicesAndDegrees) {
    MovementSettings s;
    EXPECT_TRUE(set_setting(s, "walk_speed=7.5").ok());
    EXPECT_EQ(s.walk_speed, 7.5);
    EXPECT_TRUE(set_setting(s, " max_slides = 5 ").ok());
    EXPECT_EQ(s.max_slides, 5);
    for (const char* off : {"off", "false", "0", "OFF"}) {
        s.keep_energy = true;
        EXPECT_TRUE(set_setting(s, std::string("keep_energy=") + off).ok()) << off;
        EXPECT_FALSE(s.keep_energy) << off;
    }
    EXPECT_TRUE(set_setting(s, "keep_energy=on").ok());
    EXPECT_TRUE(s.keep_energy);
    EXPECT_TRUE(set_setting(s, "push_out=analytic").ok());
    EXPECT_EQ(s.push_out, PushOut::analytic);
    EXPECT_TRUE(set_setting(s, "max_slope=45deg").ok());
    EXPECT_NEAR(s.max_slope, pi / 4, 1e-12);
    EXPECT_TRUE(set_setting(s, "max_slope=0.7").ok());
    EXPECT_EQ(s.max_slope, 0.7);
    EXPECT_TRUE(set_setting(s, "radius_y=1.5").ok());
    EXPECT_EQ(s.radii, Vec3(0.4, 1.5, 0.4));
}

TEST(SetSetting, RefusesBadInputAndLeavesTheSettingsAlone) {
    MovementSettings s;
    const auto error = [&](std::string_view assignment) {
        const Status status = set_setting(s, assignment);
        EXPECT_FALSE(status.ok()) << assignment;
        EXPECT_TRUE(s == MovementSettings{}) << assignment;
        return status.ok() ? std::string() : status.error().text();
    };
    EXPECT_THAT(error("walk_sped=3"), HasSubstr("did you mean 'walk_speed'?"));
    EXPECT_THAT(error("Keep_Energi=on"), HasSubstr("did you mean 'keep_energy'?"));
    EXPECT_THAT(error("walk_speed=900"), HasSubstr("found 900, expected a number from 0 to 100 m/s"));
    EXPECT_THAT(error("walk_speed=fast"), HasSubstr("found 'fast', expected a number"));
    EXPECT_THAT(error("walk_speed="), HasSubstr("walk_speed"));
    EXPECT_THAT(error("walk_speed"), HasSubstr("is not name=value"));
    EXPECT_THAT(error("max_slope=95deg"), HasSubstr("0deg to 89deg"));
    EXPECT_THAT(error("max_slides=2.5"), HasSubstr("a whole number from 1 to 8"));
    EXPECT_THAT(error("keep_energy=2"), HasSubstr("on or off"));
    EXPECT_THAT(error("keep_energy=0.5"), HasSubstr("on or off"));
    EXPECT_THAT(error("push_out=magic"), HasSubstr("off, iterative or analytic"));
    EXPECT_THAT(error("sub_step=1e-9"), HasSubstr("found 1e-9, expected 0 or a number from 0.001 to 0.25 s"));
    EXPECT_THAT(error("step_form=never"), HasSubstr("when_blocked or every_move"));
    error("push_out=3");
    error("gravity=nan");
    error("gravity=inf");
    error("gravity=1e999");
    error("=");
    error("");
    EXPECT_LT(error(std::string(1000000, 'x') + "=1").size(), 300u);
    EXPECT_LT(error("gravity=" + std::string(1000000, '1')).size(), 300u);
    const SettingInfo* gravity = find_setting("gravity");
    ASSERT_NE(gravity, nullptr);
    EXPECT_FALSE(set_setting(s, *gravity, std::numeric_limits<double>::quiet_NaN()).ok());
    EXPECT_FALSE(set_setting(s, *gravity, -1.0).ok());
}

}  // namespace slipface::test

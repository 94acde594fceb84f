// The level file's text: everything comes back, nothing hostile gets in.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "level/faces.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

constexpr const char* level_place = "easy.slipface.json";

Faces painted_tiles() {
    Faces faces = tiles(3);
    faces[1].painted = 1;
    faces[4].painted = 0;
    faces[5].material = "grass";
    faces[5].painted = 3;
    return faces;
}

// A level in which nothing has its standard value.
Level rich_level() {
    Level level = level_of(painted_tiles());
    SurfaceType mud;
    mud.name = "mud, \"deep\" \xC3\xA4";
    mud.color = {0.1f, 0.25f, 1.0f / 3.0f};
    mud.hatch = Hatch::rings;
    mud.hotkey = 9;
    mud.friction = 0.1;
    mud.restitution = 0.7;
    mud.keeps_energy = true;
    mud.climbable = true;
    mud.climb_speed = 1.5;
    mud.sticky = true;
    mud.velocity = Vec3(0.5, -0.25, 1.0 / 3.0);
    mud.angular_velocity = -1.5;
    mud.spin_centre = Vec3(1, 2, 3);
    mud.one_sided = true;
    mud.solid = false;
    mud.hazardous = true;
    mud.max_slope = 0.3;
    level.surfaces.push_back(mud);
    level.rules = {{"*ice*", "ice"}, {"*ice*", "ladder"}, {"mud?", mud.name}};
    level.spawn = Vec3(1.0 / 3.0, 2e-7, -1e6);
    level.spawn_yaw = 0.1;
    level.cameras = {{"door", Vec3(1, 2, 3), Vec3(0.1, 0, 0), 0.7},
                     {"door", Vec3(3, 2, 1), Vec3(0, 0.1, 0), 1.1}};
    for (const SettingInfo& info : settings_table()) {
        const bool whole = !std::holds_alternative<double MovementSettings::*>(info.member) &&
                           !std::holds_alternative<Vec3 MovementSettings::*>(info.member);
        const double value = info.minimum + (info.maximum - info.minimum) / 3.0;
        EXPECT_TRUE(set_setting(level.movement, info, whole ? std::floor(value) : value).ok()) << info.name;
    }
    level.movement.static_friction = false;
    Orphan orphan;
    orphan.key = face_key(*mesh_of(tiles(1, 40.0f)), 0);
    orphan.key.copy = 2;
    orphan.key.material = "gone";
    orphan.type = "ladder";
    level.orphans = {orphan};
    return level;
}

Result<LoadedLevel> load(std::string_view json) {
    return level_from_json(json, level_place, mesh_of(painted_tiles()));
}

TEST(LevelJson, EverythingComesBack) {
    const Level level = rich_level();
    const std::string json = level_to_json(level);
    const Result<LoadedLevel> loaded = load(json);
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_EQ(loaded->level.surfaces, level.surfaces);
    EXPECT_EQ(loaded->level.rules, level.rules);
    EXPECT_EQ(loaded->level.overrides, level.overrides);
    EXPECT_EQ(loaded->level.orphans, level.orphans);
    EXPECT_EQ(loaded->level.spawn, level.spawn);
    EXPECT_EQ(loaded->level.spawn_yaw, level.spawn_yaw);
    EXPECT_EQ(loaded->level.cameras, level.cameras);
    EXPECT_EQ(loaded->level.movement, level.movement);
    EXPECT_EQ(loaded->level.unknown, level.unknown);
    EXPECT_EQ(loaded->match.exact, 3u);
}

TEST(LevelJson, TheTextIsStable) {
    Level level = rich_level();
    const std::string json = level_to_json(level);
    Result<LoadedLevel> loaded = load(json);
    ASSERT_TRUE(loaded.ok());
    loaded->level.mesh_path = level.mesh_path;
    loaded->level.file_path = level.file_path;
    EXPECT_EQ(level_to_json(loaded->level), json);
}

TEST(LevelJson, OneLineANumberListAndShortestNumbers) {
    Level level = level_of(tiles(1));
    level.spawn = Vec3(0.1, -0.0, 1e-7);
    const std::string json = level_to_json(level);
    EXPECT_THAT(json,
                HasSubstr("  \"spawn\": {\n    \"position\": [0.1, 0, 1e-07],\n    \"yaw\": 0\n  },\n"));
    EXPECT_THAT(json, HasSubstr("\"color\": [0.62, 0.64, 0.67]"));
    EXPECT_EQ(json.rfind("{\n  \"slipface\": 1,\n  \"mesh\": \"test.obj\",\n", 0), 0u);
    EXPECT_EQ(json.back(), '\n');
}

TEST(LevelJson, TheSmallestFileGivesTheDefaultsAndBasicMovement) {
    const Result<LoadedLevel> loaded = load("{\"slipface\": 1}");
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_EQ(loaded->level.surfaces, preset_surface_types());
    EXPECT_EQ(loaded->level.movement, basic_settings());
    EXPECT_EQ(loaded->level.overrides.size(), 9u);
    EXPECT_TRUE(loaded->warnings.empty());
}

// Files were written before there were today's defaults, and before there were today's settings.
TEST(LevelJson, MovementCanBeTheNameOfAShippedPreset) {
    const auto movement = [](const std::string& json) {
        return level_from_json(R"({"slipface": 2, "movement": )" + json + "}", level_place,
                               mesh_of(tiles(2)));
    };
    const auto platformer = movement("\"platformer\"");
    ASSERT_TRUE(platformer) << platformer.error().text();
    EXPECT_EQ(platformer->level.movement, MovementSettings{});
    const auto unknown = movement("\"swimmer\"");
    ASSERT_FALSE(unknown);
    EXPECT_THAT(unknown.error().text(), HasSubstr("easy.slipface.json:/movement: found \"swimmer\""));
}

TEST(LevelJson, ASettingThatIsNotNamedIsTheBasicOne) {
    for (const SettingInfo& info : settings_table()) {
        Level level = level_of(tiles(1));
        std::string json = level_to_json(level);
        const std::size_t at = json.find(std::string("\n    \"") + info.name + "\": ");
        ASSERT_NE(at, std::string::npos) << info.name;
        json.insert(at + 6, "not_");
        MovementSettings expected = level.movement;
        ASSERT_TRUE(set_setting(expected, info, get_setting(basic_settings(), info)).ok());
        const Result<LoadedLevel> loaded = load(json);
        ASSERT_TRUE(loaded.ok()) << loaded.error().text();
        EXPECT_EQ(loaded->level.movement, expected) << info.name;
    }
}

// Version 1 meant by friction what a bounce kept of the speed along the surface.
TEST(LevelJson, FrictionOfVersionOneIsConverted) {
    for (const double restitution : {0.0, 0.001, 0.5, 1.0}) {
        for (const double kept : {0.0, 0.05, 0.1, 0.25, 0.9, 1.0}) {
            const std::string json =
                fmt::format(R"({{"slipface": 1, "surfaces": [{{"name": "default", "friction": {}, )"
                            R"("restitution": {}}}]}})",
                            kept, restitution);
            const Result<LoadedLevel> loaded = load(json);
            ASSERT_TRUE(loaded.ok()) << loaded.error().text();
            const double friction = loaded->level.surfaces[0].friction;
            if (restitution == 0.0) {
                EXPECT_EQ(friction, 1.0);
            } else {
                EXPECT_NEAR(std::min(1.0, 1.0 / friction), std::max(kept, 0.1), 1e-12) << kept;
            }
            EXPECT_EQ(loaded->warnings.size(), kept == 1.0 ? 0u : 1u) << json;
            // Written, it is read as it is.
            const std::string text = level_to_json(loaded->level);
            EXPECT_EQ(text.find("\"slipface\": 2,") != std::string::npos, friction != 1.0);
            const Result<LoadedLevel> again = load(text);
            ASSERT_TRUE(again.ok()) << again.error().text();
            EXPECT_EQ(again->level.surfaces[0].friction, friction);
            EXPECT_TRUE(again->warnings.empty());
        }
    }
}

TEST(LevelJson, UnknownKeysAreKeptWhereTheyStand) {
    std::string deep = "1";
    for (int i = 0; i < 60; ++i)
        deep = "[" + deep + "]";
    const std::string unknown_top =
        R"({"b": [1, 2.50, 1e3, 123456789012345678901234567890, -0.0, -0, -7], "a": {"z": null, "y": true, "text": "\u00e4\n\u0000"}})";
    const std::string json = R"({"slipface": 1, "studio": )" + unknown_top + R"(, "deep": )" + deep + R"(,
        "surfaces": [{"name": "default", "sound": "thud.ogg"}, {"name": "ice", "sound": {"file": "crack.ogg"}}],
        "rules": [{"pattern": "*", "type": "ice", "note": 1}, {"pattern": "*", "type": "default", "note": 2}],
        "cameras": [{"name": "c", "eye": [0,0,0], "target": [1,0,0], "lens": "wide"}],
        "spawn": {"position": [1, 2, 3], "facing_hint": "door"},
        "movement": {"gravity": 10, "wall_run": true},
        "overrides": [{"type": "ice", "material": "gone", "artist": "me",
                       "faces": ["0123456789abcdef 500,0,0 0,1,0 1"]}]})";
    Result<LoadedLevel> loaded = load(json);
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    // studio, deep, two sounds, two notes, lens, facing_hint, wall_run, artist; and one orphan.
    EXPECT_EQ(loaded->warnings.size(), 11u);
    EXPECT_EQ(loaded->warnings[0].location, "easy.slipface.json:/spawn/facing_hint");

    // Reordering the surfaces must not mix up what belongs to them.
    loaded->level.surfaces.insert(loaded->level.surfaces.begin() + 1, preset_surface_types()[2]);
    const std::string saved = level_to_json(loaded->level);
    const Result<LoadedLevel> again = load(saved);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(again->level.unknown, loaded->level.unknown);
    EXPECT_EQ(level_to_json(again->level), saved);

    EXPECT_THAT(saved, HasSubstr("\"b\": [1, 2.50, 1e3, 123456789012345678901234567890, -0.0, -0, -7]"));
    EXPECT_THAT(saved, HasSubstr("\"text\": \"\xC3\xA4\\n\\u0000\""));
    EXPECT_THAT(saved, HasSubstr("\"sound\": \"thud.ogg\""));
    const std::size_t ice = saved.find("\"name\": \"ice\"");
    EXPECT_GT(saved.find("crack.ogg"), ice);
    EXPECT_THAT(saved, HasSubstr("\"note\": 2"));
    EXPECT_THAT(saved, HasSubstr("\"lens\": \"wide\""));
    EXPECT_THAT(saved, HasSubstr("\"facing_hint\": \"door\""));
    EXPECT_THAT(saved, HasSubstr("\"wall_run\": true"));
    EXPECT_THAT(saved, HasSubstr("\"artist\": \"me\""));
    EXPECT_LT(saved.find("\"studio\""), saved.find("\"deep\""));
}

struct Hostile {
    const char* name;
    std::string json;
    std::string location;  // how the error's place begins
    std::string expected;  // in its message
};

std::string nested(std::size_t depth, char open, char close) {
    return "{\"slipface\": 1, \"x\": " + std::string(depth, open) + std::string(depth, close) + "}";
}

std::string with(const std::string& members) {
    return "{\"slipface\": 1, " + members + "}";
}

std::string row(const std::string& text) {
    return with(R"("overrides": [{"type": "ice", "material": "stone", "faces": [")" + text + "\"]}]");
}

const char* const surfaces_path = "easy.slipface.json:/surfaces";

const std::vector<Hostile>& hostile_files() {
    static const std::vector<Hostile> files{
        {"Empty", "", "easy.slipface.json:1:1", "not valid JSON"},
        {"OnlySpace", " \n\n ", "easy.slipface.json:3", "not valid JSON"},
        {"Junk",
         std::string("\x7f"
                     "ELF\x02\x01\x00\x00",
                     8),
         "easy.slipface.json:1:1", "not valid JSON"},
        {"JunkBehind", "{\"slipface\": 1}\n}", "easy.slipface.json:2:1", "not valid JSON"},
        {"BadUtf8", with("\"a\": \"\xC3(\""), "easy.slipface.json:1:", "UTF-8"},
        {"Comment", "{\"slipface\": 1 // hi\n}", "easy.slipface.json:1:16", "not valid JSON"},
        {"NotANumber", with("\"spawn\": {\"yaw\": NaN}"), "easy.slipface.json:1:", "not valid JSON"},
        {"NumberOverflow", with("\"spawn\": {\"yaw\": 1e999}"), "easy.slipface.json:1:", "1e999"},
        {"AnArray", "[1, 2]", "easy.slipface.json:/", "expected an object"},
        {"ANumber", "7", "easy.slipface.json:/", "the number 7"},
        {"NoVersion", "{}", "easy.slipface.json:/", "\"slipface\""},
        {"LaterVersion", "{\"slipface\": 3}", "easy.slipface.json:/slipface", "version 1 or 2"},
        {"TextVersion", "{\"slipface\": \"1\"}", "easy.slipface.json:/slipface", "the string \"1\""},
        {"FractionVersion", "{\"slipface\": 1.0}", "easy.slipface.json:/slipface", "1.0"},
        {"DuplicateTop", "{\"slipface\": 1, \"rules\": [], \"rules\": []}", "easy.slipface.json:/rules",
         "duplicate key"},
        {"DuplicateVersion", "{\"slipface\": 1, \"slipface\": 1}", "easy.slipface.json:/slipface",
         "duplicate key"},
        {"DuplicateDeep", with(R"("x": [{"a": {"k": 1, "j": 2, "k": 1}}])"), "easy.slipface.json:/x/0/a/k",
         "duplicate key"},
        {"DuplicateEscaped", with(R"("a": 1, "\u0061": 2)"), "easy.slipface.json:/a", "duplicate key"},
        {"DeepArrays", nested(64, '[', ']'), "easy.slipface.json:/x/0/0", "at most 64 levels"},
        {"DeepUnclosed", std::string(3'000'000, '['), "easy.slipface.json:/0/0", "at most 64 levels"},
        {"MeshType", with("\"mesh\": 3"), "easy.slipface.json:/mesh", "expected a string"},
        {"SpawnType", with("\"spawn\": [1, 2, 3]"), "easy.slipface.json:/spawn", "expected an object"},
        {"SpawnShort", with(R"("spawn": {"position": [1, 2]})"), "easy.slipface.json:/spawn/position",
         "three numbers"},
        {"SpawnText", with(R"("spawn": {"position": [1, "2", 3]})"), "easy.slipface.json:/spawn/position/1",
         "\"2\""},
        {"SpawnFar", with(R"("spawn": {"position": [1, 2, 1e300]})"), "easy.slipface.json:/spawn/position/2",
         "1e300"},
        {"SurfacesType", with("\"surfaces\": {}"), surfaces_path, "expected an array"},
        {"SurfacesEmpty", with("\"surfaces\": []"), surfaces_path, "\"default\" first"},
        {"SurfacesOrder", with(R"("surfaces": [{"name": "ice"}])"), surfaces_path, "\"default\" first"},
        {"SurfacesNameless", with(R"("surfaces": [{"hotkey": 1}])"), "easy.slipface.json:/surfaces/0",
         "\"name\""},
        {"SurfacesEmptyName", with(R"("surfaces": [{"name": ""}])"), "easy.slipface.json:/surfaces/0/name",
         "empty"},
        {"SurfacesTwin", with(R"("surfaces": [{"name": "default"}, {"name": "default"}])"),
         "easy.slipface.json:/surfaces/1/name", "a second time"},
        {"SurfaceFriction",
         with(R"("surfaces": [{"name": "default"}, {"name": "a"}, {"name": "b", "friction": "low"}])"),
         "easy.slipface.json:/surfaces/2/friction",
         "found the string \"low\", expected a number from 0 to 10"},
        {"SurfaceOldFriction", with(R"("surfaces": [{"name": "default", "friction": 3}])"),
         "easy.slipface.json:/surfaces/0/friction", "found 3, expected a number from 0 to 1"},
        {"SurfaceRange", with(R"("surfaces": [{"name": "default", "restitution": 1.5}])"),
         "easy.slipface.json:/surfaces/0/restitution", "1.5"},
        {"SurfaceFlag", with(R"("surfaces": [{"name": "default", "solid": 1}])"),
         "easy.slipface.json:/surfaces/0/solid", "true or false"},
        {"SurfaceHatch", with(R"("surfaces": [{"name": "default", "hatch": "plaid"}])"),
         "easy.slipface.json:/surfaces/0/hatch", "diagonal"},
        {"SurfaceHotkey", with(R"("surfaces": [{"name": "default", "hotkey": 10}])"),
         "easy.slipface.json:/surfaces/0/hotkey", "a whole number from 0 to 9"},
        {"SurfaceColor", with(R"("surfaces": [{"name": "default", "color": [0, 0, 256]}])"),
         "easy.slipface.json:/surfaces/0/color/2", "256"},
        {"SurfaceSlope", with(R"("surfaces": [{"name": "default", "max_slope": true}])"),
         "easy.slipface.json:/surfaces/0/max_slope", "a number"},
        {"RulesType", with("\"rules\": \"ice\""), "easy.slipface.json:/rules", "expected an array"},
        {"RuleType", with("\"rules\": [[]]"), "easy.slipface.json:/rules/0", "expected an object"},
        {"RulePattern", with(R"("rules": [{"type": "ice"}])"), "easy.slipface.json:/rules/0", "\"pattern\""},
        {"OverridesType", with("\"overrides\": {}"), "easy.slipface.json:/overrides", "expected an array"},
        {"OverridesNoFaces", with(R"("overrides": [{"type": "ice"}])"), "easy.slipface.json:/overrides/0",
         "\"faces\""},
        {"RowNumber", with(R"("overrides": [{"type": "ice", "faces": [3]}])"),
         "easy.slipface.json:/overrides/0/faces/0", "HASH"},
        {"RowEmpty", row(""), "easy.slipface.json:/overrides/0/faces/0", "HASH"},
        {"RowShortHash", row("123 0,0,0 0,1,0 1"), "easy.slipface.json:/overrides/0/faces/0", "HASH"},
        {"RowBadHash", row("000000000000000g 0,0,0 0,1,0 1"), "easy.slipface.json:/overrides/0/faces/0",
         "HASH"},
        {"RowBadPoint", row("0000000000000000 0,0 0,1,0 1"), "easy.slipface.json:/overrides/0/faces/0",
         "HASH"},
        {"RowFarPoint", row("0000000000000000 0,0,1e39 0,1,0 1"), "easy.slipface.json:/overrides/0/faces/0",
         "HASH"},
        {"RowLongNormal", row("0000000000000000 0,0,0 0,2,0 1"), "easy.slipface.json:/overrides/0/faces/0",
         "HASH"},
        {"RowNegativeArea", row("0000000000000000 0,0,0 0,1,0 -1"), "easy.slipface.json:/overrides/0/faces/0",
         "HASH"},
        {"RowBadCopy", row("0000000000000000 0,0,0 0,1,0 1 -1"), "easy.slipface.json:/overrides/0/faces/0",
         "HASH"},
        {"OrphansType", with("\"orphans\": 0"), "easy.slipface.json:/orphans", "expected an array"},
        {"CameraEye", with(R"("cameras": [{"name": "a", "target": [0,0,0]}])"),
         "easy.slipface.json:/cameras/0", "\"eye\""},
        {"CameraFov", with(R"("cameras": [{"name": "a", "eye": [0,0,0], "target": [0,0,0], "fov_y": 0}])"),
         "easy.slipface.json:/cameras/0/fov_y", "the number 0"},
        {"MovementType", with("\"movement\": true"), "easy.slipface.json:/movement", "expected an object"},
        {"MovementRange", with(R"("movement": {"gravity": -1})"), "easy.slipface.json:/movement/gravity",
         "-1"},
        {"MovementSwitch", with(R"("movement": {"static_friction": 1})"),
         "easy.slipface.json:/movement/static_friction", "true or false"},
        {"MovementWhole", with(R"("movement": {"max_slides": 2.5})"),
         "easy.slipface.json:/movement/max_slides", "a whole number"},
        {"MovementChoice", with(R"("movement": {"push_out": "hard"})"),
         "easy.slipface.json:/movement/push_out", "hard"},
        {"MovementChoiceNumber", with(R"("movement": {"push_out": 1})"),
         "easy.slipface.json:/movement/push_out", "expected a string"},
    };
    return files;
}

class HostileJson : public testing::TestWithParam<std::size_t> {};

TEST_P(HostileJson, IsRefusedWithItsLocation) {
    const Hostile& hostile = hostile_files()[GetParam()];
    const Result<LoadedLevel> loaded = load(hostile.json);
    ASSERT_FALSE(loaded.ok());
    EXPECT_EQ(loaded.error().location.rfind(hostile.location, 0), 0u) << loaded.error().text();
    EXPECT_THAT(loaded.error().message, HasSubstr(hostile.expected));
    EXPECT_LT(loaded.error().text().size(), 600u);
}

INSTANTIATE_TEST_SUITE_P(Files, HostileJson, testing::Range(std::size_t{0}, hostile_files().size()),
                         [](const auto& row_) { return std::string(hostile_files()[row_.param].name); });

// A dialog must be able to show it: a key, a string or a number may be as long as the file.
TEST(LevelJson, MessagesStayShortHoweverLongWhatTheyName) {
    const std::string lengthy(2'000'000, 'y');
    const std::string texts[] = {
        "{\"slipface\": 1, \"a\": \"" + lengthy,                            // cut off in a string
        with("\"spawn\": {\"yaw\": " + std::string(2'000'000, '9') + "}"),  // a number beyond double
        with("\"" + lengthy + "\": 1, \"" + lengthy + "\": 2"),             // a key twice
        with("\"" + lengthy + "\": {\"a\": 1, \"a\": 2}"),
        with("\"a\": \"" + lengthy + "\xff\""),
        with("\"mesh\": 1, \"x\": \"" + lengthy + "\""),
    };
    for (const std::string& text : texts) {
        const Result<LoadedLevel> loaded = load(text);
        ASSERT_FALSE(loaded.ok());
        EXPECT_LT(loaded.error().text().size(), 600u);
        EXPECT_THAT(loaded.error().location, testing::StartsWith("easy.slipface.json:"));
    }
    const Result<LoadedLevel> opened = load(
        with("\"" + lengthy + "\": 1, \"rules\": [{\"pattern\": \"*\", \"type\": \"" + lengthy + "\"}]"));
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    ASSERT_EQ(opened->warnings.size(), 2u);
    for (const Diagnostic& warning : opened->warnings)
        EXPECT_LT(warning.text().size(), 600u);
}

TEST(LevelJson, BytesThatAreNoTextAreNoneInTheMessageEither) {
    const Result<LoadedLevel> loaded = load("{\"slipface\": 1, \"a\": \"\xff");
    ASSERT_FALSE(loaded.ok());
    EXPECT_EQ(loaded.error().text().find('\xff'), std::string::npos);
    EXPECT_THAT(loaded.error().text(), HasSubstr("\xEF\xBF\xBD"));
}

TEST(LevelJson, AHundredWarningsAreListedAndTheOthersCounted) {
    std::string members;
    for (int i = 0; i < 250; ++i)
        members += (i > 0 ? ", \"k" : "\"k") + std::to_string(i) + "\": 1";
    const Result<LoadedLevel> loaded = load(with(members));
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    ASSERT_EQ(loaded->warnings.size(), 101u);
    EXPECT_EQ(loaded->warnings.back().message, "150 more warnings");
    EXPECT_THAT(level_to_json(loaded->level), HasSubstr("\"k249\": 1"));
}

TEST(LevelJson, SixtyFourLevelsAreAllowedAndKept) {
    const Result<LoadedLevel> loaded = load(nested(63, '[', ']'));
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    const Result<LoadedLevel> again = load(level_to_json(loaded->level));
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(again->level.unknown, loaded->level.unknown);
    EXPECT_THAT(level_to_json(again->level), HasSubstr("\"x\""));
}

TEST(LevelJson, MoreValuesThanAFileMayHoldAreRefused) {
    std::string json = "{\"slipface\": 1, \"x\": [0";
    for (int i = 0; i < 4'000'000; ++i)
        json += ",0";
    const Result<LoadedLevel> loaded = load(json + "]}");
    ASSERT_FALSE(loaded.ok());
    EXPECT_THAT(loaded.error().message, HasSubstr("4000000"));
}

TEST(LevelJson, CutOffAnywhereItIsAnErrorAndNeverHalfALevel) {
    std::string json = level_to_json(rich_level());
    json.pop_back();  // behind the last brace only the line's end follows
    for (std::size_t size = 0; size < json.size(); ++size) {
        const Result<LoadedLevel> loaded = load(std::string_view(json).substr(0, size));
        ASSERT_FALSE(loaded.ok()) << size;
        ASSERT_EQ(loaded.error().location.rfind("easy.slipface.json:", 0), 0u) << loaded.error().text();
    }
    EXPECT_TRUE(load(json).ok());
}

TEST(LevelJson, AChangedByteIsAnErrorOrAnotherLevelButNeverACrash) {
    const std::string json = level_to_json(rich_level());
    std::mt19937 random(11);
    std::size_t refused = 0;
    for (int i = 0; i < 5000; ++i) {
        std::string changed = json;
        for (unsigned k = 0; k < 1 + random() % 3; ++k)
            changed[random() % changed.size()] = static_cast<char>(random());
        const Result<LoadedLevel> loaded = load(changed);
        if (!loaded) {
            ++refused;
            continue;
        }
        // What was accepted can be written and read again.
        const Result<LoadedLevel> again = load(level_to_json(loaded->level));
        ASSERT_TRUE(again.ok()) << again.error().text();
    }
    EXPECT_GT(refused, 1000u);
}

TEST(LevelJson, RulesOfUnknownTypesAreKeptWithAWarning) {
    const Result<LoadedLevel> loaded = load(with(R"("rules": [{"pattern": "a", "type": "lava"}])"));
    ASSERT_TRUE(loaded.ok());
    ASSERT_EQ(loaded->warnings.size(), 1u);
    EXPECT_EQ(loaded->warnings[0].location, "easy.slipface.json:/rules/0/type");
    EXPECT_THAT(loaded->warnings[0].message, HasSubstr("lava"));
    EXPECT_EQ(loaded->level.rules.size(), 1u);
}

TEST(LevelJson, WithoutGeometryIsRefused) {
    EXPECT_FALSE(level_from_json("{\"slipface\": 1}", level_place, nullptr).ok());
}

TEST(LevelJson, BytesThatAreNoTextDoNotSpoilTheFile) {
    Level level = level_of(tiles(1));
    level.rules = {{"caf\xE9*", "ice"}};
    const Result<LoadedLevel> loaded = level_from_json(level_to_json(level), level_place, level.mesh);
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_EQ(loaded->level.rules[0].pattern, "caf\xEF\xBF\xBD*");
}

TEST(LevelJson, AHundredThousandFarAndHugeMissingFacesDoNotHang) {
    std::string json = R"({"slipface": 1, "overrides": [{"type": "ice", "material": "stone", "faces": [)";
    for (int i = 0; i < 100'000; ++i) {
        json += i == 0 ? "\n" : ",\n";
        json += "\"" + std::string(16, '0') + " " + std::to_string(i % 40) + ",3,0 0,-1,0 1e12\"";
    }
    Faces faces = tiles(60);
    const Result<LoadedLevel> loaded = level_from_json(json + "]}]}", level_place, mesh_of(faces));
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_EQ(loaded->match.orphaned, 100'000u);
    EXPECT_THAT(loaded->warnings.back().message, HasSubstr("too many faces have moved"));
}

}  // namespace
}  // namespace slipface::test

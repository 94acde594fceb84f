// A diff that names things: levels are changed in known ways, and the explanation must say which.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "goldens/level_digest.h"
#include "goldens/report.h"
#include "goldens/screen.h"
#include "slipface/base/files.h"
#include "slipface/level/level_file.h"
#include "slipface/mesh/light_charts.h"
#include "snapshots/scene_stage.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// A floor of six strips across the way, the fourth of them with the material `slick`, and a wall at its end.
std::string course_obj(double wall_top, const char* strip_material) {
    std::string obj = "o course\n";
    for (int i = 0; i <= 6; ++i) {
        const std::string z = std::to_string(6 - 3 * i);
        obj += "v -3 0 " + z + "\nv 3 0 " + z + "\n";
    }
    const std::string top = std::to_string(wall_top);
    obj += "v -3 " + top + " -12\nv 3 " + top + " -12\no floor\n";
    for (int i = 0; i < 6; ++i) {
        obj += std::string("usemtl ") + (i == 3 ? strip_material : "floor") + "\n";
        const int v = 2 * i + 1;
        obj += "f " + std::to_string(v) + " " + std::to_string(v + 1) + " " + std::to_string(v + 3) + " " +
               std::to_string(v + 2) + "\n";
    }
    return obj + "o wall\nusemtl wall\nf 13 14 16 15\n";
}

class ExplainTest : public testing::Test {
  protected:
    void SetUp() override {
        folder_ =
            fs::path(testing::TempDir()) / ("slipface_explain_" + std::to_string(::getpid()) + "_" +
                                            testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
        write("run.tape", "slipface-tape 1\ndt 1/60\nstart 0,0.95,5\n100 wish 0,-1\n60 wish 0,0\n");
        write("course.obj", course_obj(2.0, "floor__ice"));
        auto context = make_offscreen_context();
        ASSERT_TRUE(context.ok()) << context.error().text();
        context_ = std::move(*context);
    }
    void TearDown() override {
        context_.reset();
        fs::remove_all(folder_);
    }
    void write(const char* name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

    Snapshot snapshot(const std::string& more) const {
        const std::string style = more.find("style") == more.npos ? R"(, "style": "plain overlay")" : "";
        const auto scenes = parse_scene_suite(
            R"({"version": 1, "scenes": [{"name": "a", "level": "course.obj", "size": [240, 135])" + style +
                more + "}]}",
            folder_ / "scenes.json");
        EXPECT_TRUE(scenes.ok()) << scenes.error().text();
        return scene_snapshots(*scenes, std::make_shared<SceneStage>(*context_)).front();
    }
    void approve(const std::string& more) const {
        const Snapshot now = snapshot(more);
        const auto rendering = now.render();
        ASSERT_TRUE(rendering.ok()) << rendering.error().text();
        const auto written = approve_golden(folder_ / "goldens", now, *rendering);
        ASSERT_TRUE(written.ok()) << written.error().text();
        ASSERT_GE(written->size(), 2U);  // image, numbers, and the digest of a new level
    }
    GoldenResult check(const std::string& more) const {
        return check_snapshot(snapshot(more), folder_ / "goldens", folder_ / "out");
    }
    static std::string text_of(const GoldenResult& result) {
        std::string text;
        for (const Finding& finding : result.findings)
            text += std::to_string(finding.pixels) + " px " + cause_name(finding.cause) + ": " +
                    finding.text + "\n";
        return text;
    }
    static std::string first_text(const GoldenResult& result) {
        return result.findings.empty() ? result.message : result.findings.front().text;
    }
    static const Finding* of(const GoldenResult& result, Cause cause) {
        for (const Finding& finding : result.findings)
            if (finding.cause == cause) return &finding;
        return nullptr;
    }

    fs::path folder_;
    std::unique_ptr<OffscreenContext> context_;
};

constexpr const char* with_tape = R"(, "tape": "run.tape")";

TEST_F(ExplainTest, NothingChangedIsTheSame) {
    approve(with_tape);
    EXPECT_EQ(check(with_tape).state, GoldenState::same);
}

TEST_F(ExplainTest, TypeOfAFaceAndWhatItDoesToTheTape) {
    approve(with_tape);
    write("course.obj", course_obj(2.0, "floor"));
    const GoldenResult result = check(with_tape);
    ASSERT_EQ(result.state, GoldenState::different);
    const Finding *level = of(result, Cause::level), *movement = of(result, Cause::movement);
    ASSERT_TRUE(level != nullptr && movement != nullptr) << text_of(result);
    EXPECT_NE(level->text.find("and so ice to default"), std::string::npos) << text_of(result);
    EXPECT_GT(level->pixels, 100U);
    EXPECT_NE(movement->text.find("trajectory diverges at tick"), std::string::npos) << text_of(result);
    EXPECT_NE(movement->text.find("because face 3 of `floor` is no longer ice"), std::string::npos)
        << text_of(result);
    EXPECT_EQ(of(result, Cause::renderer), nullptr) << text_of(result);
}

TEST_F(ExplainTest, MovedAndRemovedGeometry) {
    approve("");
    write("course.obj", course_obj(2.12, "floor__ice"));
    const GoldenResult moved = check("");
    const Finding* level = of(moved, Cause::level);
    ASSERT_NE(level, nullptr) << text_of(moved);
    EXPECT_NE(level->text.find("face 6 of `wall`: a vertex moved 0.12 m"), std::string::npos)
        << text_of(moved);
    EXPECT_GT(level->pixels, 10U);
    std::string without_wall = course_obj(2.0, "floor__ice");
    write("course.obj", without_wall.substr(0, without_wall.find("o wall")));
    const GoldenResult removed = check("");
    ASSERT_NE(of(removed, Cause::level), nullptr) << text_of(removed);
    EXPECT_NE(of(removed, Cause::level)->text.find("face 6 of `wall` removed"), std::string::npos)
        << text_of(removed);
}

TEST_F(ExplainTest, ViewSettingsAndRenderer) {
    approve(R"(, "camera": {"eye": [6, 5, 9], "target": [0, 0, -2]}, "tape": "run.tape")");
    const GoldenResult view =
        check(R"(, "camera": {"eye": [6, 5, 9.3], "target": [0, 0, -2]}, "tape": "run.tape")");
    ASSERT_NE(of(view, Cause::view), nullptr) << text_of(view);
    EXPECT_EQ(view.findings.front().cause, Cause::view) << text_of(view);
    const GoldenResult slower = check(
        R"(, "camera": {"eye": [6, 5, 9], "target": [0, 0, -2]}, "tape": "run.tape", "settings": ["walk_speed=4"])");
    ASSERT_NE(of(slower, Cause::movement), nullptr) << text_of(slower);
    EXPECT_EQ(of(slower, Cause::movement)->text, "settings: walk_speed was \"6\", is \"4\"");
    EXPECT_NE(text_of(slower).find("because walk_speed is \"4\" instead of \"6\""), std::string::npos)
        << text_of(slower);
    EXPECT_EQ(of(slower, Cause::level), nullptr) << text_of(slower);
    // A golden that another renderer drew a little brighter: nothing in the level, the view or the movement
    // explains it.
    const fs::path png = folder_ / "goldens/a.png";
    Image brighter = *load_image(png);
    for (std::size_t i = 0; i < brighter.rgba.size(); ++i)
        if (i % 4 != 3 && brighter.rgba[i] < 240)
            brighter.rgba[i] = static_cast<std::uint8_t>(brighter.rgba[i] + 6);
    ASSERT_TRUE(save_png(png, brighter).ok());
    const GoldenResult renderer =
        check(R"(, "camera": {"eye": [6, 5, 9], "target": [0, 0, -2]}, "tape": "run.tape")");
    ASSERT_FALSE(renderer.findings.empty());
    EXPECT_EQ(renderer.findings.front().cause, Cause::renderer) << text_of(renderer);
}

// Baked light is a picture that the level is drawn with, so a new one is the level's doing and no renderer's.
TEST_F(ExplainTest, LightMapThatChanged) {
    auto level = load_level(folder_ / "course.obj");
    ASSERT_TRUE(level.ok());
    level->level.light = LevelLight{.image = "course.light.png"};
    ASSERT_TRUE(save_level(level->level).ok());
    Image light = make_image(4, 4, 200, 200, 200);
    ASSERT_TRUE(save_png(folder_ / "course.light.png", light).ok());
    approve("");
    light.rgba[0] ^= 1;
    ASSERT_TRUE(save_png(folder_ / "course.light.png", light).ok());
    Image other = *load_image(folder_ / "goldens/a.png");
    for (std::size_t i = 0; i < other.rgba.size(); ++i)
        if (i % 4 != 3 && other.rgba[i] < 240) other.rgba[i] = static_cast<std::uint8_t>(other.rgba[i] + 6);
    ASSERT_TRUE(save_png(folder_ / "goldens/a.png", other).ok());
    const GoldenResult relit = check("");
    ASSERT_FALSE(relit.findings.empty());
    EXPECT_EQ(relit.findings.front().cause, Cause::level) << text_of(relit);
    EXPECT_NE(text_of(relit).find("course.light.png has changed"), std::string::npos) << text_of(relit);
}

// A cause stands before its effects, and the drawing code is never blamed beside another difference.
TEST_F(ExplainTest, TheTapeIsNamedWithItsTick) {
    approve(with_tape);
    write("run.tape", "slipface-tape 1\ndt 1/60\nstart 0,0.95,5\n100 wish 0,-1\n61 wish 0,0\n");
    const GoldenResult longer = check(with_tape);
    EXPECT_EQ(first_text(longer), "the tape has changed from tick 160, it has 161 ticks instead of 160");
    write("run.tape",
          "slipface-tape 1\ndt 1/60\nstart 0,0.95,5\n40 wish 0,-1\n60 wish 0.01,-0.99\n60 wish 0,0\n");
    const GoldenResult turned = check(with_tape);
    EXPECT_EQ(first_text(turned), "the tape has changed from tick 40") << text_of(turned);
    EXPECT_EQ(text_of(turned).find("code"), std::string::npos) << text_of(turned);
}

TEST_F(ExplainTest, FlippedFacesMaterialsAndTextureCoordinates) {
    const std::string course = course_obj(2.0, "floor__ice");
    approve("");
    const auto first = [&](const std::string& obj) {
        write("course.obj", obj);
        const GoldenResult result = check("");
        EXPECT_EQ(result.state, GoldenState::different);
        EXPECT_EQ(text_of(result).find("drawing"), std::string::npos) << text_of(result);
        return first_text(result);
    };
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string obj = course;
        for (std::size_t at = 0; (at = obj.find(from, at)) != std::string::npos; at += to.size())
            obj.replace(at, from.size(), to);
        return obj;
    };
    EXPECT_EQ(first(changed("f 13 14 16 15", "f 15 16 14 13")), "face 6 of `wall` flipped");
    EXPECT_EQ(first(changed("usemtl wall", "usemtl brick")),
              "face 6 of the level changed material `wall` to `brick`");
    EXPECT_EQ(first(changed("f 13 14 16 15", "vt 0 0\nvt 1 0\nvt 1 1\nf 13/1 14/2 16/3 15/3")),
              "face 6 of `wall` changed texture coordinates");
    write("course.mtl", "newmtl wall\nKd 0.9 0.1 0.1\n");
    EXPECT_NE(first("mtllib course.mtl\n" + course)
                  .find("of material `wall`: its color was 0.8 0.8 0.8, is 0.9 0.1 0.1"),
              std::string::npos);
}

// Baked light fits one geometry. A moved vertex drops it, and that explains most of the pixels.
TEST_F(ExplainTest, LightThatNoLongerFitsStandsBehindTheFaceThatMoved) {
    auto level = load_level(folder_ / "course.obj");
    ASSERT_TRUE(level.ok());
    const auto charts = light_charts(*level->level.mesh, 0.25);
    ASSERT_TRUE(charts.ok());
    level->level.light = LevelLight{.image = "course.light.png", .geometry = charts->geometry};
    ASSERT_TRUE(save_level(level->level).ok());
    ASSERT_TRUE(
        save_png(folder_ / "course.light.png", make_image(charts->width, charts->height, 90, 90, 90)).ok());
    const std::string lit = R"(, "style": "textured")";
    approve(lit);
    write("course.obj", course_obj(2.12, "floor__ice"));
    const GoldenResult result = check(lit);
    ASSERT_EQ(result.findings.size(), 3U) << text_of(result);
    EXPECT_NE(result.findings[2].text.find("it follows the level's bounds"), std::string::npos);
    EXPECT_NE(first_text(result).find("a vertex moved 0.12 m"), std::string::npos) << text_of(result);
    EXPECT_NE(result.findings[1].text.find("the baked light is not drawn"), std::string::npos)
        << text_of(result);
    EXPECT_GT(result.findings[1].pixels, result.findings[0].pixels);
}

TEST_F(ExplainTest, ParametersOfTypesAreCompared) {
    auto level = load_level(folder_ / "course.obj");
    ASSERT_TRUE(level.ok());
    ASSERT_TRUE(save_level(level->level).ok());
    approve(with_tape);
    for (SurfaceType& type : level->level.surfaces)
        if (type.name == "ladder") type.climbable = false;
    ASSERT_TRUE(save_level(level->level).ok());
    const GoldenResult result = check(with_tape);
    ASSERT_EQ(result.state, GoldenState::different);
    EXPECT_EQ(first_text(result), "type `ladder`, of 0 faces: climbable was yes, is no");
}

TEST_F(ExplainTest, ASpawnIsNamed) {
    write("run.tape", "slipface-tape 1\ndt 1/60\n100 wish 0,-1\n");
    auto level = load_level(folder_ / "course.obj");
    ASSERT_TRUE(level.ok());
    level->level.spawn = {0, 1.2, 5};
    level->level.spawn_is_set = true;
    ASSERT_TRUE(save_level(level->level).ok());
    approve(with_tape);
    level->level.spawn.x() += 0.001;
    ASSERT_TRUE(save_level(level->level).ok());
    const GoldenResult result = check(with_tape);
    ASSERT_FALSE(result.findings.empty());
    EXPECT_EQ(first_text(result).find("the spawn moved 0.001 m"), 0U) << text_of(result);
}

TEST_F(ExplainTest, ARemovedFaceIsTheOnlyCause) {
    const std::string far = "v 20 0 0\nv 21 0 0\nv 21 0 1\no far\nusemtl floor\nf 17 18 19\n";
    write("course.obj", course_obj(2.0, "floor__ice") + far);
    const std::string probe =
        R"(, "camera": {"eye": [6, 5, 9], "target": [0, 0, -2]}, "probe": {"from": [0, 1.2, 3], "move": [0, -1, -3]}, "tape": "run.tape")";
    approve(probe);
    write("course.obj", course_obj(2.0, "floor__ice"));
    const GoldenResult result = check(probe);
    ASSERT_EQ(result.findings.size(), 1U) << text_of(result);
    EXPECT_NE(first_text(result).find("face 7 of `far` removed"), std::string::npos) << text_of(result);
}

TEST_F(ExplainTest, TheCameraStandsBeforeWhatItMoves) {
    const std::string camera =
        R"(, "camera": {"eye": [6, 5, 9], "target": [0, 0, -2]}, "probe": {"from": [0, 1.2, 3], "move": [0, -1, -3]})";
    std::string moved = camera;
    moved.replace(moved.find("9]"), 1, "9.3");
    approve(camera);
    const GoldenResult view = check(moved);
    ASSERT_FALSE(view.findings.empty());
    EXPECT_EQ(view.findings.front().cause, Cause::view) << text_of(view);
    const std::string follow = R"(, "camera": "tape:2/3", "tape": "run.tape")";
    approve(follow);
    const GoldenResult slower = check(follow + R"(, "settings": ["walk_speed=4"])");
    ASSERT_GE(slower.findings.size(), 3U) << text_of(slower);
    EXPECT_EQ(first_text(slower).find("settings: walk_speed was"), 0U) << text_of(slower);
    EXPECT_EQ(slower.findings.back().cause, Cause::view) << text_of(slower);
}

TEST_F(ExplainTest, AProbeThatChangedIsNoChangeOfTheCode) {
    const auto probe = [](const char* move) {
        return std::string(with_tape) + R"(, "probe": {"from": [0, 1.2, 3], "move": )" + move + "}";
    };
    approve(probe("[0, -1, -3]"));
    const GoldenResult result = check(probe("[0, -1, -4]"));
    ASSERT_EQ(result.state, GoldenState::different);
    EXPECT_NE(first_text(result).find("probe"), std::string::npos) << text_of(result);
    EXPECT_EQ(text_of(result).find("the movement code"), std::string::npos) << text_of(result);
}

TEST_F(ExplainTest, SettingsYoungerThanTheGolden) {
    approve(with_tape);
    const fs::path file = folder_ / "goldens/a.json";
    std::string numbers = *read_file(file);
    const std::size_t line = numbers.find("\"bounce\"");
    ASSERT_NE(line, std::string::npos);
    const bool on = numbers.substr(line, 20).find("on") != std::string::npos;
    numbers.erase(line, numbers.find('\n', line) + 1 - line);
    ASSERT_TRUE(write_file_atomic(file, numbers).ok());
    EXPECT_EQ(check(with_tape).state, GoldenState::same) << "the value that changes nothing";
    const GoldenResult result =
        check(std::string(with_tape) + R"(, "settings": ["bounce=)" + (on ? "off" : "on") + "\"]");
    ASSERT_EQ(result.state, GoldenState::different);
    EXPECT_EQ(first_text(result).find("settings: bounce was"), 0U) << text_of(result);
}

TEST_F(ExplainTest, DigestKeepsTheLevelAndRefusesDamage) {
    const auto level = load_level(folder_ / "course.obj");
    ASSERT_TRUE(level.ok());
    const std::string bytes = *encode_digest(level->level);
    const auto back = decode_digest(bytes, "digest");
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back->mesh->positions, level->level.mesh->positions);
    EXPECT_EQ(back->mesh->triangles, level->level.mesh->triangles);
    EXPECT_EQ(back->mesh->groups, level->level.mesh->groups);
    EXPECT_EQ(resolve_surfaces(*back).surface, resolve_surfaces(level->level).surface);
    for (std::size_t cut = 0; cut < bytes.size(); cut += 7)
        EXPECT_FALSE(decode_digest(std::string_view(bytes).substr(0, cut), "cut").ok());
    for (std::size_t i = 0; i < bytes.size(); i += 5) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
        EXPECT_FALSE(decode_digest(damaged, "damaged").ok()) << i;
    }
}

TEST(Widgets, ChangedPixelsAreNamed) {
    const Image before = make_image(100, 60, 20, 20, 20);
    Image after = before;
    for (int x = 10; x < 20; ++x)
        after.pixel(x, 12)[0] = 250;
    for (int x = 60; x < 64; ++x)
        after.pixel(x, 40)[1] = 250;
    after.pixel(99, 59)[1] = 250;
    const std::string
        was =
            R"({"version":1,"widgets":{"Panel":[0,0,90,58],"Panel/Run":[8,10,20,8],"Panel/Old":[59,38,9,9]}})",
        is = R"({"version":1,"widgets":{"Panel":[0,0,90,58],"Panel/Run":[8,10,26,8]}})";
    const auto findings = explain_widgets({before, {after, is}, was, {}, "", ui_tolerance});
    ASSERT_EQ(findings.size(), 3U);
    EXPECT_EQ(findings[0].pixels, 10U);
    EXPECT_EQ(findings[0].text, "`Panel/Run` is 26 x 8 instead of 20 x 8 pixels");
    EXPECT_EQ(findings[1].text, "`Panel` looks different");
    EXPECT_EQ(findings[2].text, "outside all named widgets");
}

GoldenResult entry(const char* name, GoldenState state) {
    GoldenResult result;
    result.name = name;
    result.state = state;
    result.message = "why <so> & \"how\"";
    return result;
}

TEST(Report, SurvivesJsonAndShards) {
    const fs::path folder = fs::path(testing::TempDir()) / ("slipface_report_" + std::to_string(::getpid()));
    Report first, second;
    first.goldens = second.goldens = "screenshots";
    first.shard = {1, 2};
    second.shard = {2, 2};
    first.entries = {entry("a", GoldenState::same), entry("b/c", GoldenState::different),
                     entry("gone", GoldenState::orphan)};
    first.entries[1].comparison =
        compare_images(make_image(20, 20, 0, 0, 0), make_image(20, 20, 9, 0, 0), scene_tolerance);
    first.entries[1].findings = {{Cause::movement, 12, "`x` </script> <!-- moved"}};
    first.entries[1].numbers = {{"/level/faces", Cause::level, "4", "5", true}};
    second.entries = {entry("d", GoldenState::missing), entry("gone", GoldenState::orphan)};
    fs::create_directories(folder / "one/b");
    ASSERT_TRUE(save_png(folder / "one/b/c.expected.png", make_image(20, 20, 0, 0, 0)).ok());
    ASSERT_TRUE(save_png(folder / "one/b/c.actual.png", make_image(20, 20, 9, 0, 0)).ok());
    ASSERT_TRUE(write_report(first, folder / "one").ok());
    ASSERT_TRUE(write_report(second, folder / "two").ok());
    const auto merged =
        merge_reports({folder / "one/report.json", folder / "two/report.json"}, folder / "all");
    ASSERT_TRUE(merged.ok()) << merged.error().text();
    std::vector<std::string> names;
    for (const GoldenResult& e : merged->entries)
        names.push_back(e.name);
    EXPECT_EQ(names, (std::vector<std::string>{"b/c", "d", "gone", "a"}));
    EXPECT_EQ(merged->entries[0].findings[0].text, "`x` </script> <!-- moved");
    EXPECT_EQ(merged->entries[0].comparison.verdict, first.entries[1].comparison.verdict);
    EXPECT_TRUE(fs::exists(folder / "all/b/c.actual.png"));
    EXPECT_FALSE(
        merge_reports({folder / "one/report.json", folder / "one/report.json"}, folder / "all").ok());

    const std::string html = report_to_html(*merged, folder / "all");
    EXPECT_NE(html.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
    EXPECT_EQ(html.find("http"), html.npos) << "the page must not need a network";
    const std::size_t script = html.find("const DATA");
    EXPECT_EQ(html.find("</script>", script), html.rfind("</script>"));
    EXPECT_NE(report_to_junit(*merged).find("tests=\"4\" failures=\"3\""), std::string::npos);
    EXPECT_NE(report_to_junit(*merged).find("why &lt;so&gt; &amp; &quot;how&quot;"), std::string::npos);
    EXPECT_NE(
        report_to_annotations(*merged).find("::error file=screenshots/b/c.png,title=Snapshot different::"),
        std::string::npos);
    EXPECT_EQ(approve_command(*merged, "out"), "slipface snapshot approve --from out/report.json b/c d");
    for (const char* bad : {"", "{}", "[]", R"({"version":2})",
                            R"({"version":1,"goldens":"x","entries":[{"name":"../x","state":"same"}]})"})
        EXPECT_FALSE(report_from_json(bad, "bad").ok()) << bad;
    fs::remove_all(folder);
}

}  // namespace
}  // namespace slipface

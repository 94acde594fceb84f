// A diff that names things: levels are changed in known ways, and the explanation must say which.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "goldens/numbers_json.h"
#include "goldens/report.h"
#include "goldens/screen.h"
#include "slipface/base/files.h"
#include "slipface/level/level_file.h"
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

    Snapshot snapshot(const std::string& more) {
        const std::string style = more.find("style") == more.npos ? R"(, "style": "plain overlay")" : "";
        const auto scenes = parse_scene_suite(
            R"({"version": 1, "scenes": [{"name": "a", "level": "course.obj", "size": [240, 135])" + style +
                more + "}]}",
            folder_ / "scenes.json");
        EXPECT_TRUE(scenes.ok()) << scenes.error().text();
        book_ = std::make_unique<InputBook>(folder_);
        const auto stage = std::make_shared<SceneStage>(*context_, *book_);
        return scene_snapshot(
            scenes->front(), [stage, scene = scenes->front()] { return stage->render(scene); }, *book_);
    }
    void approve(const std::string& more) {
        const Snapshot now = snapshot(more);
        const auto rendering = now.render();
        ASSERT_TRUE(rendering.ok()) << rendering.error().text();
        const auto written = approve_golden(folder_ / "goldens", now, *rendering);
        ASSERT_TRUE(written.ok()) << written.error().text();
        for (const std::string& input : now.inputs) {
            const Snapshot facts = book_->snapshot(input);
            ASSERT_TRUE(approve_golden(folder_ / "goldens", facts, *facts.render()).ok());
        }
    }
    // The facts of the level alone.
    GoldenResult check_level() {
        const Snapshot now = snapshot("");
        return check_snapshot(book_->snapshot(now.inputs.front()), folder_ / "goldens", folder_ / "out");
    }
    GoldenResult check(const std::string& more) {
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
    std::unique_ptr<InputBook> book_;
};

constexpr const char* with_tape = R"(, "tape": "run.tape")";

TEST_F(ExplainTest, NothingChangedIsTheSame) {
    approve(with_tape);
    EXPECT_EQ(check(with_tape).state, GoldenState::same);
}

TEST_F(ExplainTest, AnActStandsBeforeWhatFollowsFromIt) {
    approve(with_tape);
    write("course.obj", course_obj(2.0, "floor"));
    const GoldenResult result = check(with_tape);
    ASSERT_EQ(result.state, GoldenState::different);
    EXPECT_EQ(first_text(result), "1 face of `floor` changed material `floor__ice` to `floor` (course)")
        << text_of(result);
    const Finding* const movement = of(result, Cause::movement);
    ASSERT_NE(movement, nullptr) << text_of(result);
    EXPECT_NE(movement->text.find("the path leaves the approved one between ticks"), std::string::npos);
    EXPECT_FALSE(movement->act);
    EXPECT_EQ(of(result, Cause::program), nullptr) << text_of(result);
    EXPECT_EQ(first_text(check_level()), first_text(result));
}

TEST_F(ExplainTest, TheProgramIsNamedOnlyWhereNoInputChanged) {
    const std::string row = R"(, "camera": {"eye": [6, 5, 9], "target": [0, 0, -2]}, "tape": "run.tape")";
    approve(row);
    // A golden that was drawn a little brighter.
    const fs::path png = folder_ / "goldens/a.png";
    const Image drawn = *load_image(png);
    Image brighter = drawn;
    for (std::size_t i = 0; i < brighter.rgba.size(); ++i)
        if (i % 4 != 3 && brighter.rgba[i] < 240)
            brighter.rgba[i] = static_cast<std::uint8_t>(brighter.rgba[i] + 6);
    ASSERT_TRUE(save_png(png, brighter).ok());
    EXPECT_EQ(first_text(check(row)), "no input changed, so the program did: drawing");
    const GoldenResult moved =
        check(R"(, "camera": {"eye": [6, 5, 9.5], "target": [0, 0, -2]}, "tape": "run.tape")");
    EXPECT_EQ(first_text(moved), "the camera of the suite moved 0.5 m") << text_of(moved);
    EXPECT_EQ(of(moved, Cause::program), nullptr) << text_of(moved);
    // One pixel by one level: the same renderer draws the same inputs with the same pixels.
    const Snapshot now = snapshot(row);
    Rendering nearly{drawn, now.render()->numbers};
    nearly.image.rgba[0] ^= 1;
    ASSERT_TRUE(approve_golden(folder_ / "goldens", now, nearly, {.force = true}).ok());
    EXPECT_EQ(check(row).state, GoldenState::different);
    std::string numbers = *read_file(folder_ / "goldens/a.json");
    const std::size_t at = numbers.find("\"processor\": \"") + 14;
    numbers.insert(at, "other ");
    ASSERT_TRUE(write_file_atomic(folder_ / "goldens/a.json", numbers).ok());
    EXPECT_EQ(check(row).state, GoldenState::same)
        << "another processor may differ as far as the gate forgives";
}

TEST_F(ExplainTest, TheSameBytesReadOtherwiseAreTheReadersDoing) {
    approve(with_tape);
    const fs::path file = folder_ / "goldens/inputs/course.json";
    std::string facts = *read_file(file);
    const std::size_t at = facts.find("\"gravity\": ") + 11;
    facts.replace(at, facts.find_first_of(",\n", at) - at, "9");
    ASSERT_TRUE(write_file_atomic(file, facts).ok());
    std::string numbers = *read_file(folder_ / "goldens/a.json");
    const std::size_t mark = numbers.find("\"inputs/course\": \"") + 18;
    numbers.replace(mark, 33, input_mark(facts, numbers.substr(mark, 16)));
    ASSERT_TRUE(write_file_atomic(folder_ / "goldens/a.json", numbers).ok());
    const GoldenResult read = check_level();
    ASSERT_EQ(read.state, GoldenState::different);
    EXPECT_EQ(first_text(read).find("no input changed, so the program did: reading: setting gravity was 9"),
              0U)
        << text_of(read);
    write("course.obj", course_obj(2.0, "floor__ice") + "# other bytes\n");
    EXPECT_EQ(first_text(check_level()).find("setting gravity was 9"), 0U);
}

TEST_F(ExplainTest, AnImageThatWasApprovedBeforeItsLevelBlamesNoReader) {
    approve("");
    write("course.obj", course_obj(2.3, "floor__ice"));
    const Snapshot now = snapshot("");
    ASSERT_TRUE(approve_golden(folder_ / "goldens", now, *now.render()).ok());
    EXPECT_EQ(first_text(check_level()), "2 vertices of `wall` moved by up to 0.3 m (course)");
}

TEST_F(ExplainTest, AnotherOrderAloneFailsNothing) {
    approve(with_tape);
    std::string obj = course_obj(2.0, "floor__ice");
    obj.replace(obj.find("f 13 14 16 15"), 13, "f 14 16 15 13");
    write("course.obj", obj);
    EXPECT_EQ(check(with_tape).state, GoldenState::same);
    const GoldenResult level = check_level();
    EXPECT_EQ(level.state, GoldenState::same);
    EXPECT_EQ(level.message, "only the order of faces changed (course)");
}

TEST_F(ExplainTest, WhatNoImageShowsIsPinned) {
    auto level = load_level(folder_ / "course.obj");
    ASSERT_TRUE(level.ok());
    ASSERT_TRUE(save_level(level->level).ok());
    approve(with_tape);
    for (SurfaceType& type : level->level.surfaces)
        if (type.name == "ladder") type.climbable = false;
    ASSERT_TRUE(save_level(level->level).ok());
    EXPECT_EQ(check(with_tape).state, GoldenState::same);
    EXPECT_EQ(first_text(check_level()), "type `ladder`: climbable was yes, is no (course)");
}

TEST_F(ExplainTest, WhatRepeatsOtherwiseIsNeitherRedNorApproved) {
    int calls = 0;
    const Snapshot flaky{
        "f", scene_tolerance, [&]() -> Result<Rendering> {
            return Rendering{make_image(32, 32, static_cast<std::uint8_t>(++calls * 40), 0, 0), ""};
        }};
    EXPECT_EQ(check_snapshot(flaky, folder_ / "goldens", folder_ / "out").state,
              GoldenState::nondeterministic);
    EXPECT_FALSE(what_repeats_otherwise(flaky, *flaky.render(), *flaky.render()).empty());
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
            R"({"version":2,"widgets":{"Panel":[0,0,90,58],"Panel/Run":[8,10,20,8],"Panel/Old":[59,38,9,9]}})",
        is = R"({"version":2,"widgets":{"Panel":[0,0,90,58],"Panel/Run":[8,10,26,8]}})";
    const auto findings = explain_widgets({before, {after, is}, was, {}, {}, ui_tolerance});
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
    first.entries[1].findings = {{Cause::movement, 12, "`x` </script> <!-- moved", true}};
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
    EXPECT_NE(report_to_annotations(*merged).find(
                  "::error file=screenshots/b/c.png,title=Snapshots::movement: `x` </script>"),
              std::string::npos);
    EXPECT_EQ(approve_command(*merged, "out"), "slipface snapshot approve --from out/report.json b/c d");
    for (const char* bad : {"", "{}", "[]", R"({"version":2})",
                            R"({"version":1,"goldens":"x","entries":[{"name":"../x","state":"same"}]})"})
        EXPECT_FALSE(report_from_json(bad, "bad").ok()) << bad;
    fs::remove_all(folder);
}

}  // namespace
}  // namespace slipface

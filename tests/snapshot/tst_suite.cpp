#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "snapshots/scene_stage.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

std::string suite_of(const std::string& scene) {
    return R"({"version": 1, "scenes": [)" + scene + "]}";
}

Result<std::vector<Scene>> parse(const std::string& text) {
    return parse_scene_suite(text, "folder/scenes.json");
}

TEST(SceneSuite, ReadsEveryField) {
    const auto scenes = parse(suite_of(R"({
        "name": "scenes/a", "level": "../levels/a.obj",
        "camera": {"eye": [1, 2, 3], "target": [4, 5, 6], "fov_deg": 90}, "size": [320, 200],
        "style": "textured wireframe",
        "probe": {"from": [0, 1, 0], "move": [0, 0, -3], "radii": [0.5, 1, 0.5], "settings": ["max_slides=5"]},
        "tape": "run.tape"})"));
    ASSERT_TRUE(scenes.ok()) << scenes.error().text();
    ASSERT_EQ(scenes->size(), 1U);
    const Scene& scene = scenes->front();
    EXPECT_EQ(scene.name, "scenes/a");
    EXPECT_EQ(scene.level, fs::path("levels/a.obj"));
    EXPECT_EQ(*scene.tape, fs::path("folder/run.tape"));
    const auto& camera = std::get<Camera>(scene.camera);
    EXPECT_EQ(camera.eye, Vec3(1, 2, 3));
    EXPECT_EQ(camera.target, Vec3(4, 5, 6));
    EXPECT_NEAR(camera.fov_y, 1.5707963267948966, 1e-12);
    EXPECT_EQ(scene.width, 320);
    EXPECT_EQ(scene.height, 200);
    EXPECT_TRUE(scene.style.textured);
    EXPECT_TRUE(scene.style.wireframe);
    EXPECT_EQ(scene.style.overlay, 0.0f);
    ASSERT_TRUE(scene.probe.has_value());
    EXPECT_EQ(*scene.probe->from, Vec3(0, 1, 0));
    EXPECT_EQ(scene.probe->move, Vec3(0, 0, -3));
    EXPECT_EQ(*scene.probe->radii, Vec3(0.5, 1, 0.5));
    EXPECT_EQ(scene.probe->settings, std::vector<std::string>{"max_slides=5"});
    EXPECT_EQ(scene.location, "scenes.json:/scenes/0");
}

TEST(SceneSuite, DefaultsAndSpawn) {
    const auto scenes =
        parse(suite_of(R"({"name": "a", "level": "a.obj", "probe": {"from": "spawn", "move": [1, 0, 0]}})"));
    ASSERT_TRUE(scenes.ok()) << scenes.error().text();
    const Scene& scene = scenes->front();
    EXPECT_EQ(std::get<std::string>(scene.camera), "auto:iso");
    EXPECT_EQ(scene.width, 960);
    EXPECT_TRUE(scene.style.textured);
    EXPECT_GT(scene.style.overlay, 0.0f);
    EXPECT_FALSE(scene.probe->from.has_value());
    EXPECT_FALSE(scene.probe->radii.has_value());
}

// Each fault is refused at its own place.
TEST(SceneSuite, ErrorsNameTheLocation) {
    struct Case {
        const char* scene;
        const char* location;
    };
    const Case cases[] = {
        {R"(7)", "scenes.json:/scenes/0"},
        {R"({"level": "a.obj"})", "scenes.json:/scenes/0"},
        {R"({"name": "a"})", "scenes.json:/scenes/0"},
        {R"({"name": "../a", "level": "a.obj"})", "scenes.json:/scenes/0/name"},
        {R"({"name": 3, "level": "a.obj"})", "scenes.json:/scenes/0/name"},
        {R"({"name": "a", "level": ""})", "scenes.json:/scenes/0/level"},
        {R"({"name": "a", "level": "a.obj", "colour": 1})", "scenes.json:/scenes/0/colour"},
        {R"({"name": "a", "level": "a.obj", "camera": "auto:sideways"})", "scenes.json:/scenes/0/camera"},
        {R"({"name": "a", "level": "a.obj", "camera": 4})", "scenes.json:/scenes/0/camera"},
        {R"({"name": "a", "level": "a.obj", "camera": {"eye": [1, 2, 3]}})", "scenes.json:/scenes/0/camera"},
        {R"({"name": "a", "level": "a.obj", "camera": {"eye": [1, 2], "target": [0, 0, 0]}})",
         "scenes.json:/scenes/0/camera/eye"},
        {R"({"name": "a", "level": "a.obj", "camera": {"eye": [1, 2, 1e300], "target": [0, 0, 0]}})",
         "scenes.json:/scenes/0/camera/eye/2"},
        {R"({"name": "a", "level": "a.obj", "camera": {"eye": [1, 2, 3], "target": [1, 2, 3]}})",
         "scenes.json:/scenes/0/camera"},
        {R"({"name": "a", "level": "a.obj", "camera": {"eye": [1, 2, 3], "target": [0, 0, 0], "fov_deg": 0}})",
         "scenes.json:/scenes/0/camera/fov_deg"},
        {R"({"name": "a", "level": "a.obj", "size": 100})", "scenes.json:/scenes/0/size"},
        {R"({"name": "a", "level": "a.obj", "size": [100, 1e9]})", "scenes.json:/scenes/0/size/1"},
        {R"({"name": "a", "level": "a.obj", "size": [15, 100]})", "scenes.json:/scenes/0/size/0"},
        {R"({"name": "a", "level": "a.obj", "size": [99.5, 100]})", "scenes.json:/scenes/0/size/0"},
        {R"({"name": "a", "level": "a.obj", "style": "shiny"})", "scenes.json:/scenes/0/style"},
        {R"({"name": "a", "level": "a.obj", "probe": {"move": [1, 0, 0]}})", "scenes.json:/scenes/0/probe"},
        {R"({"name": "a", "level": "a.obj", "probe": {"from": "here", "move": [1, 0, 0]}})",
         "scenes.json:/scenes/0/probe/from"},
        {R"({"name": "a", "level": "a.obj", "probe": {"from": "spawn", "move": ["1", 0, 0]}})",
         "scenes.json:/scenes/0/probe/move/0"},
        {R"({"name": "a", "level": "a.obj", "probe": {"from": "spawn", "move": [1, 0, 0], "radii": [1, 0, 1]}})",
         "scenes.json:/scenes/0/probe/radii"},
        {R"({"name": "a", "level": "a.obj", "probe": {"from": "spawn", "move": [1, 0, 0], "settings": ["warp=9"]}})",
         "scenes.json:/scenes/0/probe/settings/0"},
        {R"({"name": "a", "level": "a.obj", "tape": []})", "scenes.json:/scenes/0/tape"},
        {R"({"name": "a", "level": "a.obj", "profile": "soft"})", "scenes.json:/scenes/0/profile"},
        {R"({"name": "a", "level": "a.obj", "settings": ["warp=9"]})", "scenes.json:/scenes/0/settings/0"},
        {R"({"name": "a", "level": "a.obj"}, {"name": "a", "level": "a.obj"})", "scenes.json:/scenes/1/name"},
    };
    for (const Case& c : cases) {
        const auto scenes = parse(suite_of(c.scene));
        ASSERT_FALSE(scenes.ok()) << c.scene;
        EXPECT_EQ(scenes.error().location, c.location) << c.scene << ": " << scenes.error().text();
        EXPECT_FALSE(scenes.error().message.empty());
    }
}

TEST(SceneSuite, FileErrors) {
    const auto location = [](const std::string& text) {
        const auto scenes = parse(text);
        return scenes.ok() ? std::string("accepted") : scenes.error().location;
    };
    EXPECT_EQ(location(""), "scenes.json:1");
    EXPECT_EQ(location("{\n\"version\": 1,\n\"scenes\": [}\n"), "scenes.json:3");
    EXPECT_EQ(location("[]"), "scenes.json:");
    EXPECT_EQ(location("{}"), "scenes.json:");
    EXPECT_EQ(location(R"({"version": 2, "scenes": []})"), "scenes.json:/version");
    EXPECT_EQ(location(R"({"version": 1, "scenes": {}})"), "scenes.json:/scenes");
    EXPECT_EQ(location(R"({"version": 1, "scenes": [], "more": 1})"), "scenes.json:/more");
    EXPECT_EQ(location(R"({"version": 1, "version": 1, "scenes": []})"), "scenes.json");
    EXPECT_EQ(location(std::string(100000, '[')), "scenes.json:1");
    EXPECT_EQ(location("\xff\xfe junk"), "scenes.json:1");
    EXPECT_EQ(location(R"({"version": 1, "scenes": []})"), "accepted");
}

class SceneTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = fs::path(testing::TempDir()) / ("slipface_scenes_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
        // A floor of 12 x 12 m with a wall across it at z = -2, and one camera.
        std::ofstream(folder_ / "room.obj") << "v -6 0 6\nv 6 0 6\nv 6 0 -6\nv -6 0 -6\n"
                                               "v -6 0 -2\nv 6 0 -2\nv 6 3 -2\nv -6 3 -2\n"
                                               "f 1 2 3 4\nf 5 6 7 8\n";
        std::ofstream(folder_ / "run.tape") << "slipface-tape 1\ndt 1/60\nstart 0,1,4\n60 wish 0,-1\n";
        auto context = make_offscreen_context();
        ASSERT_TRUE(context.ok()) << context.error().text();
        context_ = std::move(*context);
    }
    static void TearDownTestSuite() {
        context_.reset();
        fs::remove_all(folder_);
    }

    static Result<Image> render(const std::string& more) {
        const Result<Rendering> rendering = render_all(more);
        if (!rendering) return rendering.error();
        return rendering->image;
    }
    static Result<Rendering> render_all(const std::string& more) {
        const auto scenes = parse_scene_suite(
            suite_of(R"({"name": "a", "level": "room.obj", "size": [160, 90])" + more + "}"),
            folder_ / "scenes.json");
        if (!scenes) return scenes.error();
        InputBook book(folder_);
        return SceneStage(*context_, book).render(scenes->front());
    }

    static inline fs::path folder_;
    static inline std::unique_ptr<OffscreenContext> context_;
};

TEST_F(SceneTest, ProbeAndTapeAreDrawn) {
    const auto bare = render("");
    ASSERT_TRUE(bare.ok()) << bare.error().text();
    EXPECT_EQ(bare->width, 160);
    const auto probe =
        render(R"(, "probe": {"from": [0, 1, 2], "move": [1, 0, -6], "settings": ["max_slides=2"]})");
    ASSERT_TRUE(probe.ok()) << probe.error().text();
    const auto tape = render(R"(, "tape": "run.tape")");
    ASSERT_TRUE(tape.ok()) << tape.error().text();
    EXPECT_GT(compare_images(*bare, *probe, scene_tolerance).differing, 100U);
    EXPECT_GT(compare_images(*bare, *tape, scene_tolerance).differing, 100U);
    EXPECT_FALSE(compare_images(*probe, *tape, scene_tolerance).same);
}

TEST_F(SceneTest, ErrorsNameTheScene) {
    struct Case {
        const char* more;
        const char* location;
        const char* part;
    };
    for (const Case& c : {Case{R"(, "camera": "balcony")", "scenes.json:/scenes/0/camera", "balcony"},
                          Case{R"(, "tape": "gone.tape")", "scenes.json:/scenes/0/tape", "gone.tape"}}) {
        const auto image = render(c.more);
        ASSERT_FALSE(image.ok());
        EXPECT_EQ(image.error().location, c.location);
        EXPECT_NE(image.error().message.find(c.part), std::string::npos) << image.error().text();
    }
    Scene scene;
    scene.level = folder_ / "gone.obj";
    scene.location = "scenes.json:/scenes/4";
    InputBook book(folder_);
    const auto image = SceneStage(*context_, book).render(scene);
    ASSERT_FALSE(image.ok());
    EXPECT_EQ(image.error().location, "scenes.json:/scenes/4/level");
}

TEST_F(SceneTest, SnapshotsRenderTheScenesTwiceAlike) {
    const auto scenes = parse_scene_suite(
        R"({"version": 1, "scenes": [{"name": "a", "level": "room.obj", "size": [160, 90]},
            {"name": "b", "level": "room.obj", "size": [160, 90], "camera": "auto:top", "style": "plain"}]})",
        folder_ / "scenes.json");
    ASSERT_TRUE(scenes.ok()) << scenes.error().text();
    InputBook book(folder_);
    SceneStage stage(*context_, book);
    for (const Scene& scene : *scenes) {
        const Snapshot snapshot = scene_snapshot(
            scene, [&] { return stage.render(scene); }, book);
        EXPECT_EQ(snapshot.name, scene.name);
        const GoldenResult result = check_snapshot(snapshot, folder_ / "goldens", folder_ / "out", true);
        EXPECT_EQ(result.state, GoldenState::missing) << result.message;
    }
}

// Each camera is another picture; the map has its grid.
TEST_F(SceneTest, CamerasAreExpanded) {
    const auto scenes =
        parse_scene_suite(suite_of(R"({"name": "a", "level": "room.obj", "size": [96, 54], "tape": "run.tape",
                     "cameras": ["auto:iso4", "auto:map", "auto:top", "auto:turntable:3", "tape:2", "contacts"]})"),
                          folder_ / "scenes.json");
    ASSERT_TRUE(scenes.ok()) << scenes.error().text();
    const auto expanded = expand_suite(*scenes);
    ASSERT_TRUE(expanded.ok()) << expanded.error().text();
    std::vector<std::string> names;
    std::vector<Image> images;
    InputBook book(folder_);
    SceneStage stage(*context_, book);
    for (const Scene& scene : *expanded) {
        names.push_back(scene.name);
        const auto rendering = stage.render(scene);
        ASSERT_TRUE(rendering.ok()) << scene.name << ": " << rendering.error().text();
        for (const Image& other : images)
            EXPECT_NE(rendering->image, other) << scene.name;
        images.push_back(rendering->image);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"a@iso-1", "a@iso-2", "a@iso-3", "a@iso-4", "a@map", "a@top",
                                               "a@turntable-1", "a@turntable-2", "a@turntable-3", "a@tape-1",
                                               "a@tape-2", "a@contact-1"}));
}

// What no run reaches is named, and is gone from the list with the row that reaches it.
TEST_F(SceneTest, CoverageIsWhatTheRunsReach) {
    InputBook book(folder_);
    SceneStage stage(*context_, book);
    const auto missing = [&](const std::string& row, const std::string& word) {
        const auto scenes = parse_scene_suite(suite_of(row), folder_ / "scenes.json");
        EXPECT_TRUE(scenes.ok()) << scenes.error().text();
        EXPECT_TRUE(stage.render(scenes->front()).ok());
        const std::vector<std::string> words = not_reached(stage.coverage());
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    const auto demo = [](const char* name) {
        return fmt::format(R"({{"name": "a", "level": "demo:{}:on", "size": [32, 32]}})", name);
    };
    const char* const still = R"({"name": "a", "level": "room.obj", "size": [32, 32]})";
    EXPECT_TRUE(missing(still, "setting coyote"));
    EXPECT_TRUE(missing(still, "object platform"));
    EXPECT_TRUE(missing(demo("step-up"), "setting coyote"));
    EXPECT_FALSE(missing(still, "setting step_up"));
    EXPECT_FALSE(missing(demo("coyote"), "setting coyote"));
    EXPECT_TRUE(missing(still, "surface restitution"));
    EXPECT_FALSE(missing(demo("bounce"), "surface restitution"));
}

TEST(SceneSuite, EveryDemoHasItsPair) {
    const auto scenes = parse(suite_of(R"({"name": "h", "level": "demo:*", "size": [96, 54]})"));
    ASSERT_TRUE(scenes.ok()) << scenes.error().text();
    const auto expanded = expand_suite(*scenes);
    ASSERT_TRUE(expanded.ok()) << expanded.error().text();
    EXPECT_GE(expanded->size(), 40U);
    const auto found = std::find_if(expanded->begin(), expanded->end(),
                                    [](const Scene& scene) { return scene.name == "h/step-up-on"; });
    ASSERT_NE(found, expanded->end());
    EXPECT_EQ(found->level, "demo:step-up:on");
    EXPECT_EQ(std::get<std::string>(found->camera), "Step up");
    EXPECT_EQ(found->width, 96);
}

TEST_F(SceneTest, CameraNamesAreChecked) {
    for (const char* camera :
         {"auto:iso:5", "auto:turntable:0", "auto:turntable:4/3", "tape:x", "contact:0", "auto:"}) {
        const auto scenes = parse(suite_of(
            fmt::format(R"({{"name": "a", "level": "a.obj", "cameras": ["auto:iso", "{}"]}})", camera)));
        ASSERT_FALSE(scenes.ok()) << camera;
        EXPECT_EQ(scenes.error().location, "scenes.json:/scenes/0/cameras/1");
    }
    const auto no_tape = render(R"(, "camera": "tape:1/2")");
    ASSERT_FALSE(no_tape.ok());
    EXPECT_NE(no_tape.error().message.find("needs a scene with a tape"), std::string::npos);
    const auto no_contact =
        render(R"(, "camera": "contact:2", "probe": {"from": [0, 1, 2], "move": [0, 0, -6]})");
    ASSERT_FALSE(no_contact.ok());
    EXPECT_NE(no_contact.error().message.find("make 1 contacts"), std::string::npos)
        << no_contact.error().text();
}

TEST_F(SceneTest, DefaultsProfileAndMasks) {
    const auto scenes = parse(R"({"version": 1, "defaults": {"size": [64, 32], "style": "plain"}, "scenes": [
        {"name": "a", "level": "a.obj", "profile": "ui", "masks": [[1, 2, 3, 4]]},
        {"name": "b", "level": "a.obj", "size": [32, 32], "style": "textured grid"}]})");
    ASSERT_TRUE(scenes.ok()) << scenes.error().text();
    EXPECT_EQ((*scenes)[0].width, 64);
    EXPECT_FALSE((*scenes)[0].style.textured);
    EXPECT_EQ((*scenes)[0].tolerance.pixel_delta, ui_tolerance.pixel_delta);
    EXPECT_EQ((*scenes)[0].masks, (std::vector<MaskRect>{{1, 2, 3, 4}}));
    EXPECT_EQ((*scenes)[1].width, 32);
    EXPECT_TRUE((*scenes)[1].style.textured && (*scenes)[1].grid);
    EXPECT_EQ(parse(suite_of(R"({"name": "a", "level": "a.obj", "masks": [[1, 2, 3]]})")).error().location,
              "scenes.json:/scenes/0/masks/0");
}

// The suite that ships is read without an error.
TEST(ShippedSuite, IsValid) {
    const auto scenes = load_scene_suite(fs::path(SLIPFACE_SOURCE_DIR) / "screenshots" / "scenes.json");
    ASSERT_TRUE(scenes.ok()) << scenes.error().text();
    EXPECT_GE(scenes->size(), 5U);
}

}  // namespace
}  // namespace slipface

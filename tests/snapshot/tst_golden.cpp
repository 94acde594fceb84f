#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "goldens/golden.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// A picture with some detail: a slope of grey, and bars.
Image sample(int width = 96, int height = 64) {
    Image image = make_image(width, height, 0, 0, 0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            std::uint8_t* pixel = image.pixel(x, y);
            pixel[0] = static_cast<std::uint8_t>(60 + x);
            pixel[1] = static_cast<std::uint8_t>(80 + y);
            pixel[2] = (x / 7) % 2 == 0 ? 90 : 180;
        }
    }
    return image;
}

Image with_patch(Image image) {
    for (int y = 10; y < 20; ++y) {
        for (int x = 10; x < 20; ++x)
            image.pixel(x, y)[1] = 250;
    }
    return image;
}

Image with_noise(Image image) {
    for (int x = 0; x < image.width; x += 9)
        image.pixel(x, 5)[0] ^= 1;
    return image;
}

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class GoldenTest : public testing::Test {
  protected:
    void SetUp() override {
        root_ =
            fs::path(testing::TempDir()) / ("slipface_golden_" + std::to_string(::getpid()) + "_" +
                                            testing::UnitTest::GetInstance()->current_test_info()->name());
        folder_ = root_ / "goldens";
        out_ = root_ / "out";
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(root_); }

    static Snapshot named(const std::string& name) { return {name, scene_tolerance, {}}; }
    GoldenResult check(const Image& image, const std::string& name = "scenes/a") const {
        return check_golden(folder_, named(name), {image, ""}, out_);
    }
    bool approve(const std::string& name, const Image& image, const ApproveOptions& options = {}) const {
        return approve_golden(folder_, named(name), {image, ""}, options).ok();
    }
    std::size_t files_in_goldens() const {
        std::size_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            count += entry.is_regular_file() ? 1U : 0U;
        return count;
    }

    fs::path root_, folder_, out_;
};

TEST_F(GoldenTest, MissingWritesOnlyTheActualPicture) {
    const GoldenResult result = check(sample());
    EXPECT_EQ(result.state, GoldenState::missing);
    EXPECT_EQ(result.name, "scenes/a");
    EXPECT_NE(result.message.find("scenes/a.png: no golden"), std::string::npos) << result.message;
    EXPECT_EQ(files_in_goldens(), 0U);
    const auto actual = load_image(out_ / "scenes/a.actual.png");
    ASSERT_TRUE(actual.ok());
    EXPECT_EQ(*actual, sample());
}

TEST_F(GoldenTest, ApprovedIsSame) {
    ASSERT_TRUE(approve("scenes/a", sample()));
    EXPECT_EQ(check(sample()).state, GoldenState::same);
    EXPECT_EQ(check(with_noise(sample())).state, GoldenState::same);
    EXPECT_FALSE(fs::exists(out_));
}

TEST_F(GoldenTest, DifferentWritesThreePictures) {
    ASSERT_TRUE(approve("scenes/a", sample()));
    const std::string before = bytes_of(folder_ / "scenes/a.png");
    const GoldenResult result = check(with_patch(sample()));
    EXPECT_EQ(result.state, GoldenState::different);
    EXPECT_EQ(result.comparison.differing, 100U);
    EXPECT_EQ(result.message.find('\n'), std::string::npos);
    EXPECT_EQ(*load_image(out_ / "scenes/a.expected.png"), sample());
    EXPECT_EQ(*load_image(out_ / "scenes/a.actual.png"), with_patch(sample()));
    EXPECT_EQ(load_image(out_ / "scenes/a.difference.png")->width, 96);
    for (const char* ending : {"expected", "actual", "difference"}) {
        EXPECT_NE(result.message.find(std::string("scenes/a.") + ending + ".png"), std::string::npos);
    }
    EXPECT_EQ(bytes_of(folder_ / "scenes/a.png"), before);
}

TEST_F(GoldenTest, OtherSizeIsDifferent) {
    ASSERT_TRUE(approve("a", sample()));
    const GoldenResult result = check(sample(95, 64), "a");
    EXPECT_EQ(result.state, GoldenState::different);
    EXPECT_TRUE(result.comparison.size_differs);
    EXPECT_TRUE(fs::exists(out_ / "a.difference.png"));
}

TEST_F(GoldenTest, UnreadableIsNotMissing) {
    std::ofstream(folder_ / "junk.png") << "no picture";
    std::ofstream(folder_ / "empty.png");
    fs::create_directories(folder_ / "folder.png");
    fs::create_symlink("nowhere", folder_ / "dangling.png");
    for (const char* name : {"junk", "empty", "folder", "dangling"}) {
        const GoldenResult result = check(sample(), name);
        EXPECT_EQ(result.state, GoldenState::unreadable) << name;
        EXPECT_TRUE(fs::exists(out_ / (std::string(name) + ".actual.png")));
    }
}

TEST_F(GoldenTest, LfsPointerSaysWhatToDo) {
    std::ofstream(folder_ / "a.png") << "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n";
    const GoldenResult result = check(sample(), "a");
    EXPECT_EQ(result.state, GoldenState::unreadable);
    EXPECT_NE(result.message.find("git lfs pull"), std::string::npos) << result.message;
}

// Approving what passes leaves the file's bytes and time alone; approving a change replaces it.
TEST_F(GoldenTest, ApproveTouchesOnlyWhatDiffers) {
    ASSERT_TRUE(approve("a", sample()));
    const auto time = fs::last_write_time(folder_ / "a.png");
    const std::string before = bytes_of(folder_ / "a.png");
    ASSERT_TRUE(approve("a", with_noise(sample())));
    EXPECT_EQ(bytes_of(folder_ / "a.png"), before);
    EXPECT_EQ(fs::last_write_time(folder_ / "a.png"), time);
    ASSERT_TRUE(approve("a", with_patch(sample())));
    EXPECT_EQ(*load_image(folder_ / "a.png"), with_patch(sample()));
}

TEST_F(GoldenTest, ApproveReplacesAnUnreadableGolden) {
    std::ofstream(folder_ / "a.png") << "no picture";
    ASSERT_TRUE(approve("a", sample()));
    EXPECT_EQ(check(sample(), "a").state, GoldenState::same);
}

// Names cannot leave the folder.
TEST_F(GoldenTest, NamesAreBounded) {
    for (const char* name :
         {"", "/etc/a", "../a", "a/../b", "a//b", "a/", ".a", "a\\b", "a b", "a\nb", "a..b"}) {
        EXPECT_FALSE(valid_snapshot_name(name)) << name;
        EXPECT_EQ(check(sample(), name).state, GoldenState::unreadable) << name;
        EXPECT_FALSE(approve(name, sample())) << name;
    }
    EXPECT_FALSE(valid_snapshot_name(std::string(201, 'a')));
    for (const char* name : {"a", "scenes/easy-overview", "v1.2/x_y"})
        EXPECT_TRUE(valid_snapshot_name(name)) << name;
    EXPECT_EQ(files_in_goldens(), 0U);
    EXPECT_FALSE(fs::exists(out_));
}

TEST_F(GoldenTest, UnwritableFolderIsAnError) {
    std::ofstream(root_ / "file") << "x";
    EXPECT_FALSE(approve_golden(root_ / "file", named("a"), {sample(), ""}).ok());
    const GoldenResult result = check_golden(folder_, named("a"), {sample(), ""}, root_ / "file");
    EXPECT_EQ(result.state, GoldenState::missing);
    EXPECT_EQ(result.message.find("wrote"), std::string::npos) << result.message;
}

TEST_F(GoldenTest, SnapshotThatChangesIsNondeterministic) {
    int calls = 0;
    const Snapshot snapshot{"a", scene_tolerance, [&]() -> Result<Rendering> {
                                return Rendering{++calls % 2 == 1 ? sample() : with_noise(sample()), ""};
                            }};
    ASSERT_TRUE(approve("a", sample()));
    EXPECT_EQ(check_snapshot(snapshot, folder_, out_, true).state, GoldenState::nondeterministic);
    EXPECT_TRUE(fs::exists(out_ / "a.first.png") && fs::exists(out_ / "a.second.png"));
    calls = 0;
    EXPECT_EQ(check_snapshot(snapshot, folder_, out_).state, GoldenState::same);
    EXPECT_FALSE(fs::exists(out_ / "a.first.png"));  // pictures of an earlier check do not stay
}

TEST_F(GoldenTest, SnapshotThatFailsSaysWhy) {
    const Snapshot snapshot{"a", scene_tolerance, []() -> Result<Rendering> { return Error{"here", "no"}; }};
    const GoldenResult result = check_snapshot(snapshot, folder_, out_, true);
    EXPECT_EQ(result.state, GoldenState::failed);
    EXPECT_EQ(result.message, "here: no");
}

TEST_F(GoldenTest, OrphansAreFoundAndAlternatesAreNone) {
    for (const char* name : {"scenes/a", "scenes/a.alt1", "scenes/b", "old", "old.alt3"})
        ASSERT_TRUE(approve(name, sample()));
    std::ofstream(folder_ / "scenes.json") << "{}";
    EXPECT_EQ(orphan_goldens(folder_, {"scenes/a"}),
              (std::vector<std::string>{"old", "old.alt3", "scenes/b"}));
    EXPECT_TRUE(orphan_goldens(root_ / "nowhere", {}).empty());
}

// A second picture that is right, too: said when it is the one that fits.
TEST_F(GoldenTest, AlternatesFit) {
    ASSERT_TRUE(approve("a", sample()));
    ASSERT_TRUE(approve("a.alt1", sample(95, 64)));
    EXPECT_EQ(check(with_patch(sample()), "a").state, GoldenState::different);
    ASSERT_TRUE(approve("a.alt2", with_patch(sample())));
    const GoldenResult result = check(with_patch(sample()), "a");
    EXPECT_EQ(result.state, GoldenState::same);
    EXPECT_EQ(result.matched, "a.alt2");
    EXPECT_TRUE(check(sample(), "a").matched.empty());
}

TEST_F(GoldenTest, MasksAreNotCompared) {
    ASSERT_TRUE(approve("a", sample()));
    Snapshot snapshot = named("a");
    const Rendering changed{with_patch(sample()), ""};
    EXPECT_EQ(check_golden(folder_, snapshot, changed, out_).state, GoldenState::different);
    snapshot.masks = {{10, 10, 10, 10}};
    EXPECT_EQ(check_golden(folder_, snapshot, changed, out_).state, GoldenState::same);
    snapshot.masks = {{11, 10, 10, 10}};
    EXPECT_EQ(check_golden(folder_, snapshot, changed, out_).state, GoldenState::different);
}

// Numbers decide beside equal pixels, and say what is wrong; the renderer's never do.
TEST_F(GoldenTest, NumbersDecideToo) {
    const auto with = [](const char* numbers) { return Rendering{sample(), numbers}; };
    const Snapshot snapshot = named("a");
    const char* golden = R"({"version": 2, "level": {"faces": 4}, "renderer": {"version": "Mesa 1"}})";
    ASSERT_TRUE(approve("a", sample()));
    EXPECT_EQ(check_golden(folder_, snapshot, with(golden), out_).state, GoldenState::missing);
    ASSERT_TRUE(approve_golden(folder_, snapshot, with(golden)).ok());
    EXPECT_EQ(check_golden(folder_, snapshot, with(golden), out_).state, GoldenState::same);
    const char* elsewhere = R"({"version": 2, "level": {"faces": 4}, "renderer": {"version": "Mesa 2"}})";
    EXPECT_EQ(check_golden(folder_, snapshot, with(elsewhere), out_).state, GoldenState::same);
    const char* other = R"({"version": 2, "level": {"faces": 5}, "renderer": {"version": "Mesa 1"}})";
    const GoldenResult result = check_golden(folder_, snapshot, with(other), out_);
    EXPECT_EQ(result.state, GoldenState::different);
    EXPECT_NE(result.message.find("/level/faces was 4, is 5"), std::string::npos) << result.message;
    EXPECT_TRUE(fs::exists(out_ / "a.actual.json"));
    std::ofstream(folder_ / "a.json") << "nonsense";
    EXPECT_EQ(check_golden(folder_, snapshot, with(golden), out_).state, GoldenState::unreadable);
}

TEST(GoldenState, Names) {
    EXPECT_STREQ(golden_state_name(GoldenState::same), "same");
    EXPECT_STREQ(golden_state_name(GoldenState::nondeterministic), "nondeterministic");
}

}  // namespace
}  // namespace slipface

// Levels made of rooms are looked into from outside; all others are drawn from both sides.
#include <filesystem>
#include <random>

#include "app_fixture.h"
#include "document/inside_out.h"

namespace slipface {
namespace {

// Boxes, each wound to be seen from outside or from inside.
class Boxes {
  public:
    void add(const Vec3& min, const Vec3& max, bool inwards, int left_out = -1) {
        for (int i = 0; i < 8; ++i)
            text_ << "v " << (i & 1 ? max : min).x() << " " << (i & 2 ? max : min).y() << " "
                  << (i & 4 ? max : min).z() << "\n";
        static constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3},
                                            {0, 2, 3, 1}, {4, 5, 7, 6}};  // outwards; -Y is 2, +Y is 3
        for (int side = 0; side < 6; ++side) {
            if (side == left_out) continue;
            text_ << "f";
            for (int k = 0; k < 4; ++k)
                text_ << " " << first_ + sides[side][inwards ? 3 - k : k];
            text_ << "\n";
        }
        first_ += 8;
    }
    std::string text() const { return text_.str(); }

  private:
    std::ostringstream text_;
    int first_ = 1;
};

class BackFacesTest : public LevelFixture {
  protected:
    void load(const std::string& text) {
        write_text(obj, text);
        open_level(editor, obj);
        ASSERT_FALSE(editor.message) << editor.message->text;
    }
    bool drawn_from(const Vec3& eye) {
        Camera camera;
        camera.eye = eye;
        camera.target = eye + Vec3(0.3, -0.4, 0.5);
        return draws_back_faces(editor, camera);
    }
    Editor editor;
    std::mt19937 random{20240229};
    double number(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    }
    Vec3 point(const Vec3& min, const Vec3& max) {
        return {number(min.x(), max.x()), number(min.y(), max.y()), number(min.z(), max.z())};
    }
};

TEST_F(BackFacesTest, RoomsOfAnySizeAreLookedIntoFromOutsideOnly) {
    for (int i = 0; i < 60; ++i) {
        const Vec3 min = point(Vec3::Constant(-80), Vec3::Constant(80));
        const Vec3 max = min + point(Vec3::Constant(1), Vec3::Constant(i % 2 ? 200 : 8));
        Boxes boxes;
        boxes.add(min, max, true, i % 3 == 0 ? 3 : -1);  // every third without a ceiling
        // Crates in it, at most a fifth as large.
        for (int crate = 0; crate < i % 5; ++crate) {
            const Vec3 size = number(0.05, 0.2) * (max - min), at = point(min, max - size);
            boxes.add(at, at + size, false);
        }
        load(boxes.text());
        EXPECT_TRUE(is_made_of_rooms(editor.document->collision())) << i;
        EXPECT_FALSE(drawn_from(max + Vec3(5, 3, 4))) << i;
        EXPECT_FALSE(drawn_from(min - Vec3(1, 1, 1))) << i;
        Camera plan;
        plan.orthographic = true;
        plan.eye = 0.5 * (min + max);
        EXPECT_FALSE(draws_back_faces(editor, plan)) << i;
        if (i % 5 == 0 && i % 3 != 0) {
            EXPECT_TRUE(drawn_from(point(min, max))) << i;
        }
    }
}

TEST_F(BackFacesTest, BetweenTwoRoomsOneIsOutside) {
    Boxes boxes;
    boxes.add({0, 0, 0}, {10, 4, 10}, true);
    boxes.add({20, 0, 20}, {30, 4, 30}, true);
    load(boxes.text());
    EXPECT_TRUE(drawn_from({5, 2, 5}));
    EXPECT_TRUE(drawn_from({25, 1, 28}));
    EXPECT_FALSE(drawn_from({15, 2, 15})) << "within the bounds, in neither room";
}

TEST_F(BackFacesTest, SolidBodiesFloorsAndTerrainAreDrawnAsEver) {
    Boxes solid;
    solid.add({0, 0, 0}, {4, 4, 4}, false);
    load(solid.text());
    EXPECT_TRUE(drawn_from({9, 9, 9}));
    load(floor_and_wall_obj(8));
    EXPECT_TRUE(drawn_from({4, 9, 4}));
    EXPECT_TRUE(drawn_from({4, -9, 4})) << "a floor seen from below shows its back";
    std::ostringstream hills;
    constexpr int n = 20;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            hills << "v " << i << " " << number(0.0, 1.5) << " " << j << "\n";
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j + 1;
            hills << "f " << a << " " << a + 1 << " " << a + n + 2 << " " << a + n + 1 << "\n";
        }
    load(hills.str());
    EXPECT_TRUE(drawn_from({10, 30, 10}));
    EXPECT_TRUE(drawn_from({10, -30, 10}));
}

TEST_F(BackFacesTest, TheSwitchGoesToTheOppositeAndBackAndIsRemembered) {
    Boxes room;
    room.add({0, 0, 0}, {10, 4, 10}, true);
    const auto config = folder / "config";
    std::filesystem::create_directory(config);
    begin_session(editor, config, {});
    load(room.text());
    EXPECT_FALSE(sees_back_faces(editor)) << "a level without cameras opens seen from outside";
    ASSERT_TRUE(run_command(editor, "view.back_faces"));
    EXPECT_EQ(editor.back_faces, BackFaces::always);
    EXPECT_TRUE(sees_back_faces(editor));
    ASSERT_TRUE(run_command(editor, "view.back_faces"));
    EXPECT_EQ(editor.back_faces, BackFaces::automatic);
    ASSERT_TRUE(run_command(editor, "view.back_faces_never"));
    EXPECT_FALSE(drawn_from({5, 2, 5}));
    store_preferences(editor);
    Editor next;
    begin_session(next, config, {});
    EXPECT_EQ(next.back_faces, BackFaces::never);
}

// What is looked through cannot be picked either.
TEST_F(BackFacesTest, ThePickGoesThroughToTheFloor) {
    Boxes room;
    room.add({0, 0, 0}, {10, 4, 10}, true);
    load(room.text());
    editor.view.look_at({5, 20, 5.01}, {5, 0, 5});
    hover(editor, {{5, 20, 5}, {0, -1, 0}});
    EXPECT_NEAR(editor.hovered_point.y(), 0.0, 1e-9);
    editor.back_faces = BackFaces::always;
    hover(editor, {{5, 20, 5}, {0, -1, 0}});
    EXPECT_NEAR(editor.hovered_point.y(), 4.0, 1e-9);
}

}  // namespace
}  // namespace slipface

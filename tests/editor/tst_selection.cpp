// Each operation of the selection algebra, with the exact faces it must give.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "document/selection.h"
#include "level_fixture.h"
#include "tools/commands/commands.h"
#include "tools/selection/selecting.h"
#include "tools/view/cameras.h"

namespace slipface {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using Faces = std::vector<FaceId>;

// A staircase of slopes along x, each a quad 1 m wide (z 0..1): face 0 flat, 1 at 30 degrees, 2 at 60, 3
// upright, 4 hanging over. Face 5 is flat too but 10 m away, in a group and with a material of its own, twice
// as large.
const char* const slopes_obj =
    "o stairs\nusemtl stone\n"
    "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 1 0 1\n"
    "v 1.8660254 0.5 0\nv 1.8660254 0.5 1\n"
    "v 2.3660254 1.3660254 0\nv 2.3660254 1.3660254 1\n"
    "v 2.3660254 2.3660254 0\nv 2.3660254 2.3660254 1\n"
    "v 1.8660254 3.2320508 0\nv 1.8660254 3.2320508 1\n"
    "f 1 2 4 3\nf 3 4 6 5\nf 5 6 8 7\nf 7 8 10 9\nf 9 10 12 11\n"
    "o far\nusemtl wood\n"
    "v 10 0 0\nv 10 0 1\nv 12 0 0\nv 12 0 1\nf 13 14 16 15\n";

class SelectionTest : public LevelFixture {
  protected:
    void load(const std::string& text) {
        write_text(obj, text);
        open_level(editor, obj);
        ASSERT_TRUE(editor.document) << (editor.message ? editor.message->text : "");
    }
    void SetUp() override {
        LevelFixture::SetUp();
        open_level(editor, obj);
        ASSERT_TRUE(editor.document);
    }
    const Document& document() const { return *editor.document; }
    Faces selected() const { return {document().selection().begin(), document().selection().end()}; }
    void select(Faces faces) { editor.document->select(std::move(faces)); }
    Faces in_outline(const Camera& camera, const Vec2& size, const std::vector<Vec2>& outline, bool through,
                     bool whole = false) {
        editor.select_through = through;
        editor.select_whole = whole;
        return faces_in_outline(editor, camera, size, outline);
    }
    // Runs it, looks, and sees that one undo brings the selection of before.
    Faces after(const char* command) {
        const Faces before = selected();
        const std::size_t steps = document().history_cursor();
        EXPECT_TRUE(run_command(editor, command)) << command;
        const Faces result = selected();
        if (document().history_cursor() > steps) {
            EXPECT_EQ(document().history_cursor(), steps + 1) << command;
            editor.document->undo();
            EXPECT_EQ(selected(), before) << command;
            editor.document->redo();
            EXPECT_EQ(selected(), result) << command;
        }
        return result;
    }
    Editor editor;
};

TEST_F(SelectionTest, FlatStopsAtTheWallAndAngleCrossesIt) {
    select({0});
    EXPECT_THAT(after("select.flat"), SizeIs(64));
    select({wall + 3});
    EXPECT_THAT(after("select.flat"), ElementsAre(64, 65, 66, 67, 68, 69, 70, 71));
    select({0});
    editor.fill_angle = 0.25 * std::numbers::pi;
    EXPECT_THAT(after("select.smooth"), SizeIs(64));
    select({0});
    editor.fill_angle = 0.5 * std::numbers::pi;
    EXPECT_THAT(after("select.smooth"), SizeIs(72));
}

// Two floors of the same height that touch in a corner only, and one a step higher beside the first.
TEST_F(SelectionTest, FlatNeedsASharedEdgeAndTheSamePlane) {
    load(
        "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 1 0 2\nv 2 0 2\nv 2 0 1\n"
        "v 0 1 0\nv 1 1 0\nv 0 1 -1\nv 1 1 -1\n"
        "f 1 2 3 4\nf 3 5 6 7\nf 1 4 9 8\nf 8 9 11 10\n");
    select({0});
    EXPECT_THAT(after("select.flat"), ElementsAre(0));
    select({3});
    EXPECT_THAT(after("select.flat"), ElementsAre(3));
    editor.fill_angle = std::numbers::pi;
    select({0});
    EXPECT_THAT(after("select.smooth"), ElementsAre(0, 2, 3));
}

TEST_F(SelectionTest, MaterialAndTypeBoundTheirFloods) {
    select({wall});
    EXPECT_THAT(after("select.within_material"), SizeIs(8));
    select({0});
    EXPECT_THAT(after("select.within_material"), SizeIs(64));
    // A row of ice cuts the floor in two.
    Faces row;
    for (FaceId j = 0; j < 8; ++j)
        row.push_back(3 * 8 + j);
    editor.document->paint(row, ice);
    select({0});
    EXPECT_THAT(after("select.within_type"), SizeIs(24));
    select({63});
    EXPECT_THAT(after("select.within_type"), SizeIs(32));
    select({24});
    EXPECT_EQ(after("select.within_type"), row);
}

TEST_F(SelectionTest, GrowShrinkAndInvert) {
    select({9});
    EXPECT_THAT(after("select.grow"), ElementsAre(1, 8, 9, 10, 17));
    EXPECT_THAT(after("select.shrink"), ElementsAre(9));
    EXPECT_THAT(after("select.shrink"), IsEmpty());
    select({0});
    EXPECT_THAT(after("select.grow"), ElementsAre(0, 1, 8));
    EXPECT_THAT(after("select.shrink"), ElementsAre(0));  // the level's border does not shrink
    EXPECT_THAT(after("select.invert"), SizeIs(71));
    EXPECT_THAT(after("select.all"), SizeIs(72));
    EXPECT_THAT(after("select.none"), IsEmpty());
}

TEST_F(SelectionTest, SimilarByMaterialTypeGroupDirectionAndArea) {
    load(slopes_obj);
    select({0});
    EXPECT_THAT(after("select.same_material"), ElementsAre(0, 1, 2, 3, 4));
    select({5});
    EXPECT_THAT(after("select.same_group"), ElementsAre(5));
    select({0});
    EXPECT_THAT(after("select.same_direction"), ElementsAre(0, 5));
    select({0});
    EXPECT_THAT(after("select.same_area"), ElementsAre(0, 1, 2, 3, 4));
    select({5});
    EXPECT_THAT(after("select.same_area"), ElementsAre(5));
    editor.document->paint(Faces{1, 5}, ice);
    select({1});
    EXPECT_THAT(after("select.same_type"), ElementsAre(1, 5));
    select({0, 1});
    EXPECT_THAT(after("select.same_type"), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST_F(SelectionTest, SlopeClassesFollowTheLimitOfSettingsAndType) {
    load(slopes_obj);
    EXPECT_THAT(after("select.steep"), ElementsAre(2, 3, 4));
    select({1});
    EXPECT_THAT(after("select.same_slope"), ElementsAre(0, 1, 5));
    select({2});
    EXPECT_THAT(after("select.same_slope"), ElementsAre(2, 3));
    EXPECT_EQ(slope_class(document(), 4), SlopeClass::overhang);
    MovementSettings movement = document().level().movement;
    movement.max_slope = 61.0 * std::numbers::pi / 180.0;
    editor.document->set_movement(movement, "Steeper");
    EXPECT_THAT(after("select.steep"), ElementsAre(3, 4));
    std::vector<SurfaceType> surfaces = document().level().surfaces;
    surfaces[ice].max_slope = 10.0 * std::numbers::pi / 180.0;
    editor.document->set_surfaces(surfaces, "Slippery");
    editor.document->paint(Faces{1}, ice);
    EXPECT_THAT(after("select.steep"), ElementsAre(1, 3, 4));
    const SlopeCounts& counts = slope_counts(document());
    EXPECT_THAT(counts.faces, ElementsAre(0u, 3u, 2u, 1u));
    EXPECT_NEAR(counts.area[static_cast<std::size_t>(SlopeClass::walkable)], 1.0 + 1.0 + 2.0, 1e-5);
}

TEST_F(SelectionTest, ByTypePaintedAndByDigit) {
    editor.document->paint(Faces{5, 6}, ice);
    EXPECT_THAT(after("select.type_2"), ElementsAre(5, 6));
    EXPECT_THAT(after("select.type_3"), SizeIs(8));  // the wall's suffix
    EXPECT_THAT(after("select.painted"), ElementsAre(5, 6));
    editor.brush = ice;
    select({});
    EXPECT_THAT(after("select.brush_type"), ElementsAre(5, 6));
    editor.brush.reset();
    EXPECT_THAT(after("select.brush_type"), SizeIs(70));
    select({0, 1, 2});
    ASSERT_TRUE(run_command(editor, "paint.2"));
    EXPECT_EQ(document().face_count_of(ice), 5u);
    EXPECT_NEAR(document().area_of(ice), 5.0, 1e-6);
}

TEST_F(SelectionTest, HiddenFacesAreNeitherSelectedNorPicked) {
    select({0, 1});
    ASSERT_TRUE(run_command(editor, "select.hide"));
    EXPECT_THAT(selected(), IsEmpty());
    EXPECT_THAT(document().hidden(), ElementsAre(0, 1));
    EXPECT_TRUE(document().dirty()) << "the level file keeps what is hidden";
    hover(editor, Ray{Vec3(0.5, 10, 0.5), Vec3(0, -1, 0)});
    EXPECT_EQ(editor.hovered, no_id);
    EXPECT_THAT(after("select.all"), SizeIs(70));
    editor.document->undo();
    editor.document->undo();
    EXPECT_THAT(document().hidden(), IsEmpty());
    EXPECT_THAT(selected(), ElementsAre(0, 1));
    ASSERT_TRUE(run_command(editor, "select.isolate"));
    EXPECT_THAT(document().hidden(), SizeIs(70));
    EXPECT_THAT(selected(), ElementsAre(0, 1));
    hover(editor, Ray{Vec3(0.5, 10, 0.5), Vec3(0, -1, 0)});
    EXPECT_EQ(editor.hovered, 0u);
    ASSERT_TRUE(run_command(editor, "select.show_all"));
    EXPECT_THAT(document().hidden(), IsEmpty());
    EXPECT_FALSE(run_command(editor, "select.show_all"));
}

// Five floors above one another.
TEST_F(SelectionTest, DrillingGoesThroughEveryFaceUnderTheMouse) {
    std::string text;
    for (int i = 0; i < 5; ++i)
        for (const char* corner : {" 0", " 1"})
            text += "v 0 " + std::to_string(-i) + corner + "\nv 1 " + std::to_string(-i) + corner + "\n";
    for (int i = 0; i < 5; ++i)
        text += "f " + std::to_string(4 * i + 1) + " " + std::to_string(4 * i + 3) + " " +
                std::to_string(4 * i + 4) + " " + std::to_string(4 * i + 2) + "\n";
    load(text);
    const Ray down{Vec3(0.5, 3, 0.5), Vec3(0, -1, 0)};
    for (const FaceId face : {0u, 1u, 2u, 3u, 4u, 0u}) {
        drill_select(editor, down, 1);
        EXPECT_THAT(selected(), ElementsAre(face));
    }
    drill_select(editor, down, -1);
    EXPECT_THAT(selected(), ElementsAre(4));
    editor.document->hide({1, 2, 3}, "Hide");
    drill_select(editor, down, 1);
    EXPECT_THAT(selected(), ElementsAre(0));
    drill_select(editor, down, 1);
    EXPECT_THAT(selected(), ElementsAre(4));
    drill_select(editor, Ray{Vec3(9, 3, 9), Vec3(0, -1, 0)}, 1);
    EXPECT_THAT(selected(), ElementsAre(4));
}

// The camera looks straight down on the floor; 80 pixels are a metre.
TEST_F(SelectionTest, ABoxTakesWhatIsSeenAndThroughTakesCentres) {
    Camera camera;
    camera.orthographic = true;
    camera.eye = {4, 10, 4};
    camera.target = {4, 0, 4};
    camera.ortho_height = 10.0;
    const Vec2 size{800, 800};
    const auto box = [](double x0, double z0, double x1, double z1) {
        const auto pixel = [](double x, double z) { return Vec2(80 * (x + 1), 80 * (z + 1)); };
        return std::vector<Vec2>{pixel(x0, z0), pixel(x1, z0), pixel(x1, z1), pixel(x0, z1)};
    };
    EXPECT_THAT(in_outline(camera, size, box(0.2, 0.2, 0.8, 1.8), false), ElementsAre(0, 1));
    EXPECT_THAT(in_outline(camera, size, box(0.2, 0.2, 0.8, 1.8), true), ElementsAre(0, 1));
    EXPECT_THAT(in_outline(camera, size, box(0.6, 0.2, 1.4, 0.8), false), ElementsAre(0, 8));
    EXPECT_THAT(in_outline(camera, size, box(0.6, 0.2, 1.4, 0.8), true), IsEmpty());
    // From below the floor hides nothing that lies above it: the wall is seen from its edge only.
    EXPECT_THAT(in_outline(camera, size, box(-1, -1, 9, 9), true), SizeIs(72));
    EXPECT_THAT(in_outline(camera, size, box(20, 20, 30, 30), false), IsEmpty());
    const std::vector<Vec2> triangle{{80, 80}, {80, 240}, {240, 80}};  // x + z < 2
    EXPECT_THAT(in_outline(camera, size, triangle, false), ElementsAre(0, 1, 8));
    // Wholly inside lies none of the three: a corner of each is at 2, on the line or beyond.
    EXPECT_THAT(in_outline(camera, size, triangle, false, true), IsEmpty());
    EXPECT_THAT(in_outline(camera, size, box(-0.1, -0.1, 1.5, 2.1), false), ElementsAre(0, 1, 2, 8, 9, 10));
    EXPECT_THAT(in_outline(camera, size, box(-0.1, -0.1, 1.5, 2.1), false, true), ElementsAre(0, 1));
    EXPECT_THAT(in_outline(camera, size, box(-0.1, -0.1, 1.6, 2.1), true), ElementsAre(0, 1, 8, 9));
    EXPECT_THAT(in_outline(camera, size, box(-0.1, -0.1, 1.6, 2.1), true, true), ElementsAre(0, 1));
    // A dent of the outline cuts into face 0, whose corners all lie inside.
    const std::vector<Vec2> dented{{70, 70},  {120, 70},  {120, 120}, {125, 70},
                                   {170, 70}, {170, 250}, {70, 250}};
    EXPECT_THAT(in_outline(camera, size, dented, false, true), ElementsAre(1));
    editor.document->hide({0}, "Hide");
    EXPECT_THAT(in_outline(camera, size, triangle, false), ElementsAre(1, 8));
    EXPECT_THAT(in_outline(camera, size, std::vector<Vec2>{{0, 0}, {9, 9}}, false), IsEmpty());
}

TEST_F(SelectionTest, WhatIsCoveredIsSelectedOnlyThrough) {
    load("v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 2 0\nv 0 2 1\nv 1 2 1\nv 1 2 0\nf 1 2 3 4\nf 5 6 7 8\n");
    Camera camera;
    camera.eye = {0.5, 6, 0.5};
    camera.target = {0.5, 0, 0.5};
    const std::vector<Vec2> all{{0, 0}, {400, 0}, {400, 400}, {0, 400}};
    EXPECT_THAT(in_outline(camera, {400, 400}, all, false), ElementsAre(1));
    EXPECT_THAT(in_outline(camera, {400, 400}, all, true), ElementsAre(0, 1));
}

TEST_F(SelectionTest, SavedSelectionsAreKeptRecalledRenamedAndUndone) {
    select({3, 4});
    ASSERT_TRUE(run_command(editor, "select.save"));
    EXPECT_EQ(document().saved_selections()[0].name, "Selection 1");
    select({9});
    save_selection(editor, "door");
    EXPECT_THAT(after("select.recall_1"), ElementsAre(3, 4));
    EXPECT_THAT(after("select.recall_2"), ElementsAre(9));
    EXPECT_FALSE(run_command(editor, "select.recall_3"));
    recall_selection(editor, 0, SelectBy::add);
    EXPECT_THAT(selected(), ElementsAre(3, 4, 9));
    rename_selection(editor, 0, "door");  // taken
    EXPECT_EQ(document().saved_selections()[0].name, "Selection 1");
    rename_selection(editor, 0, "gate");
    replace_selection(editor, 0);
    EXPECT_THAT(document().saved_selections()[0].faces, ElementsAre(3, 4, 9));
    remove_selection(editor, 1);
    ASSERT_THAT(document().saved_selections(), SizeIs(1));
    while (document().can_undo())
        editor.document->undo();
    EXPECT_THAT(document().saved_selections(), IsEmpty());
}

TEST_F(SelectionTest, ReplacingATypeMovesItsFacesOnly) {
    editor.document->paint(Faces{5, 6, 7}, ice);
    replace_type(editor, ice, ladder);
    EXPECT_EQ(document().face_count_of(ice), 0u);
    EXPECT_EQ(document().face_count_of(ladder), 11u);
    EXPECT_EQ(document().history().back().name, "Replace ice by ladder");
    editor.document->undo();
    select({6, 40});
    replace_type(editor, ice, std::nullopt);
    EXPECT_EQ(document().face_count_of(ice), 2u);
    select({});
    editor.brush = ladder;
    hover(editor, Ray{Vec3(0.5, 10, 5.5), Vec3(0, -1, 0)});
    ASSERT_TRUE(run_command(editor, "edit.replace_type"));
    EXPECT_EQ(document().face_count_of(ice), 0u);
}

TEST_F(SelectionTest, CamerasAreAddedRenamedMovedDeletedAndUndone) {
    editor.view.look_at({0, 5, 5}, {0, 0, 0});
    ASSERT_TRUE(run_command(editor, "camera.add"));
    editor.view.look_at({5, 5, 0}, {0, 0, 0});
    save_camera(editor, "side");
    ASSERT_THAT(document().level().cameras, SizeIs(2));
    ASSERT_TRUE(run_command(editor, "camera.go_1"));
    EXPECT_NEAR((editor.view.camera().eye - Vec3(0, 5, 5)).norm(), 0.0, 1e-9);
    ASSERT_TRUE(run_command(editor, "camera.next"));
    EXPECT_NEAR((editor.view.camera().eye - Vec3(5, 5, 0)).norm(), 0.0, 1e-9);
    EXPECT_FALSE(camera_name_problem(document(), 0, "side").empty());
    rename_camera(editor, 0, "front");
    EXPECT_EQ(document().level().cameras[0].name, "front");
    editor.view.look_at({0, 9, 1}, {0, 0, 0});
    replace_camera(editor, 0);
    EXPECT_NEAR((document().level().cameras[0].eye - Vec3(0, 9, 1)).norm(), 0.0, 1e-9);
    ASSERT_TRUE(run_command(editor, "camera.delete"));
    EXPECT_THAT(document().level().cameras, SizeIs(1));
    editor.document->go_to(0);
    EXPECT_THAT(document().level().cameras, IsEmpty());
}

TEST_F(SelectionTest, FourPanesKeepTheirCameras) {
    const ViewCamera first = editor.view;
    ASSERT_TRUE(run_command(editor, "view.four_panes"));
    EXPECT_STREQ(pane_view(editor, 1).name(), "Top");
    EXPECT_STREQ(pane_view(editor, 2).name(), "Front");
    EXPECT_STREQ(pane_view(editor, 3).name(), "Right");
    activate_pane(editor, 1);
    editor.view.zoom(3);
    const double distance = editor.view.distance;
    activate_pane(editor, 0);
    EXPECT_EQ(editor.view.distance, first.distance);
    EXPECT_EQ(pane_view(editor, 1).distance, distance);
    double area = 0.0;
    for (const PaneRect& rect : pane_rects(editor.panes))
        area += rect.width * rect.height;
    EXPECT_NEAR(area, 1.0, 1e-12);
    activate_pane(editor, 3);
    ASSERT_TRUE(run_command(editor, "view.two_panes"));
    EXPECT_EQ(editor.panes.active, 0u);
    EXPECT_EQ(editor.view.distance, first.distance);
    activate_pane(editor, 3);  // not shown
    EXPECT_EQ(editor.panes.active, 0u);
}

TEST_F(SelectionTest, LookingAlongAnAxisIsExact) {
    ASSERT_TRUE(run_command(editor, "view.top"));
    EXPECT_STREQ(editor.view.name(), "Top");
    const Camera camera = editor.view.camera();
    EXPECT_TRUE(camera.orthographic);
    // A map: x to the right, -z upwards.
    const Vec3 middle = project(camera, editor.view.pivot, {100, 100});
    const Vec3 east = project(camera, editor.view.pivot + Vec3::UnitX(), {100, 100});
    const Vec3 south = project(camera, editor.view.pivot + Vec3::UnitZ(), {100, 100});
    EXPECT_GT(east.x(), middle.x() + 1.0);
    EXPECT_NEAR(east.y(), middle.y(), 1e-6);
    EXPECT_GT(south.y(), middle.y() + 1.0);
    ASSERT_TRUE(run_command(editor, "view.front"));
    EXPECT_STREQ(editor.view.name(), "Front");
    ASSERT_TRUE(run_command(editor, "view.orthographic"));
    EXPECT_STREQ(editor.view.name(), "Perspective");
}

}  // namespace
}  // namespace slipface

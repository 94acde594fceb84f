// The geometry's file changes under an open document.
#include <algorithm>
#include <cmath>

#include "editor/app_fixture.h"
#include "tools/commands/commands.h"

namespace slipface {
namespace {

using Reload = LevelFixture;

// The same faces in another order, as a modelling tool that sorts them leaves them: every second one first.
// (Backwards could also be the same order of what was turned, which is a question.)
FaceId sorted_place(FaceId face, std::size_t faces) {
    return face / 2 + static_cast<FaceId>(face % 2 == 0 ? 0 : (faces + 1) / 2);
}
std::string sorted_faces(std::string text) {
    std::istringstream lines(text);
    std::vector<std::string> vertices, faces;
    std::string material;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("usemtl"))
            material = line + "\n";
        else
            (line.starts_with('f') ? faces : vertices)
                .push_back((line.starts_with('f') ? material : std::string()) + line + "\n");
    }
    std::vector<std::string> sorted(faces.size());
    for (FaceId face = 0; face < faces.size(); ++face)
        sorted[sorted_place(face, faces.size())] = faces[face];
    std::string result;
    for (const std::string& line : vertices)
        result += line;
    for (const std::string& line : sorted)
        result += line;
    return result;
}

TEST_F(Reload, FindsPaintedFacesAgainAsOneStep) {
    auto document = open();
    const std::vector<FaceId> painted{0, 5, wall};
    document->paint(painted, ice);
    document->select({3});
    const MeshPtr old_mesh = document->level().mesh;
    EXPECT_FALSE(document->changed_on_disk());

    write_text(obj, sorted_faces(floor_and_wall_obj(n)));
    EXPECT_TRUE(document->changed_on_disk());
    const std::size_t steps = document->history().size();
    ASSERT_TRUE(document->reload());
    EXPECT_EQ(document->match().text(), "3 exact, 0 by plane, 0 orphaned");
    EXPECT_EQ(document->history().size(), steps + 1);
    EXPECT_FALSE(document->changed_on_disk());
    EXPECT_TRUE(document->selection().empty());
    EXPECT_EQ(document->face_count_of(ice), 3u);
    for (const FaceId face : painted)
        EXPECT_EQ(document->surface_of(sorted_place(face, face_count)), ice);
    const auto hit = document->pick({0.5, 5, 5.5}, {0, -1, 0}, false);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->face, sorted_place(5, face_count));

    document->undo();
    EXPECT_EQ(document->level().mesh, old_mesh);
    EXPECT_EQ(document->surface_of(0), ice);
    EXPECT_EQ(document->selection().size(), 1u);
    document->undo();
    document->undo();
    EXPECT_EQ(document->face_count_of(ice), 0u);
    document->go_to(document->history().size());
    EXPECT_EQ(document->surface_of(sorted_place(5, face_count)), ice);
}

class TwoReadings : public AppFixture {};

// The first tile was deleted and one appended, or all moved by one.
TEST_F(TwoReadings, AreAskedAboutOnce) {
    write_text(obj, tiles(0, 12));
    open_level(editor(), obj);
    editor().import_card.shown = false;
    Document& document = *editor().document;
    document.paint(std::vector<FaceId>{3, 4, 8}, ice);
    ASSERT_TRUE(document.save());
    write_text(obj, tiles(1, 12));
    reload_geometry(editor());
    host->frame();
    host->frame();
    ASSERT_EQ(run("expect widget Notices/Readings"), "");
    const auto painted = [&] {
        std::vector<FaceId> faces;
        for (FaceId face = 0; face < 12; ++face)
            if (document.surface_of(face) == ice) faces.push_back(face);
        return faces;
    };
    const std::vector<FaceId> moved{3, 4, 8}, stayed{2, 3, 7};
    const std::vector<FaceId> first = painted();
    ASSERT_TRUE(first == moved || first == stayed);
    ASSERT_TRUE(run_command(editor(), "select.two_readings"));
    EXPECT_EQ(document.selection().size(), 4u);
    ASSERT_TRUE(run_command(editor(), "select.take_reading"));
    EXPECT_EQ(painted(), first == moved ? stayed : moved);
    EXPECT_TRUE(document.guessed().empty());
    host->frame();
    host->frame();
    EXPECT_EQ(run("expect no_widget Notices/Readings"), "");
    document.undo();
    EXPECT_EQ(painted(), first);
    ASSERT_TRUE(run_command(editor(), "select.keep_reading"));
    EXPECT_EQ(painted(), first);
    EXPECT_TRUE(document.second_reading().empty());
    ASSERT_TRUE(document.save());
    open_level(editor(), obj);
    EXPECT_TRUE(editor().document->second_reading().empty()) << "the answer is remembered";
}

TEST_F(Reload, KeepsWhatFoundNoFaceUntilItIsAttachedByHand) {
    auto document = open();
    document->paint(std::vector<FaceId>{wall + 2}, ice);
    std::string without_wall = floor_and_wall_obj(n);
    write_text(obj, without_wall.substr(0, without_wall.find("usemtl wall")));
    ASSERT_TRUE(document->reload());
    ASSERT_EQ(document->level().orphans.size(), 1u);
    EXPECT_EQ(document->match().orphaned, 1u);

    EXPECT_FALSE(document->attach_orphan(1, std::vector<FaceId>{7})) << "there is only one";
    EXPECT_FALSE(document->attach_orphan(0, {})) << "no face";
    ASSERT_TRUE(document->attach_orphan(0, std::vector<FaceId>{7}));
    EXPECT_TRUE(document->level().orphans.empty());
    EXPECT_EQ(document->surface_of(7), ice);
    document->undo();
    EXPECT_EQ(document->level().orphans.size(), 1u);
    EXPECT_NE(document->surface_of(7), ice);

    document->drop_orphan(0);
    EXPECT_TRUE(document->level().orphans.empty());
    EXPECT_EQ(document->history().back().name, "Drop orphan");
}

TEST_F(Reload, ChangesNothingWhenTheFileIsBroken) {
    auto document = open();
    document->paint(std::vector<FaceId>{1}, ice);
    const std::size_t steps = document->history().size();
    write_text(obj, "v 0 0 0\nf 1 2 3\n");
    EXPECT_FALSE(document->reload());
    EXPECT_EQ(document->history().size(), steps);
    EXPECT_EQ(document->face_count(), face_count);
    EXPECT_EQ(document->surface_of(1), ice);

    Progress cancelled;
    cancelled.cancel();
    write_text(obj, floor_and_wall_obj(n));
    EXPECT_FALSE(document->reload(&cancelled));
    EXPECT_FALSE(Document::open(obj, &cancelled));
    EXPECT_TRUE(document->reload());
}

TEST_F(Reload, ANewScaleKeepsThePaint) {
    auto document = open();
    document->paint(std::vector<FaceId>{0, wall}, ice);
    ASSERT_TRUE(document->set_import_transform({.scale = 0.5, .up = UpAxis::z}));
    EXPECT_EQ(document->surface_of(0), ice);
    EXPECT_EQ(document->surface_of(wall), ice);
    EXPECT_DOUBLE_EQ(document->bounds().max.x(), n * 0.5);
    ASSERT_TRUE(document->save());

    const auto again = Document::open(obj);
    ASSERT_TRUE(again) << again.error().text();
    EXPECT_EQ((*again)->match().text(), "2 exact, 0 by plane, 0 orphaned");
    EXPECT_EQ((*again)->level().import_transform, document->level().import_transform);
    document->undo();
    EXPECT_DOUBLE_EQ(document->bounds().max.x(), n);
    const std::uint64_t before = document->face_revision();
    for (const double scale : {-1.0, 0.0, std::nan("")})
        EXPECT_FALSE(document->set_import_transform({.scale = scale, .up = {}})) << "out of range";
    EXPECT_EQ(document->face_revision(), before);
}

TEST_F(Reload, TheSpawnPointGoesWithTheScaleInOneStep) {
    auto document = open();
    const double above_feet = document->level().movement.radii.y();
    document->set_spawn({{2, 3 + above_feet, 4}, 0.5});
    ASSERT_TRUE(document->set_import_transform({.scale = 10.0, .up = UpAxis::z}));
    EXPECT_TRUE(document->level().spawn.isApprox(Vec3(20, 40 + above_feet, -30)));
    document->undo();
    EXPECT_EQ(document->level().spawn, Vec3(2, 3 + above_feet, 4));
    EXPECT_DOUBLE_EQ(document->bounds().max.x(), n);
    document->redo();
    EXPECT_TRUE(document->level().spawn.isApprox(Vec3(20, 40 + above_feet, -30)));
}

}  // namespace
}  // namespace slipface

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>

#include "document/document.h"
#include "level_fixture.h"

namespace slipface {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using DocumentTest = LevelFixture;

// What is worked out step by step must equal what is worked out from nothing.
void expect_consistent(const Document& document) {
    const ResolvedSurfaces fresh = resolve_surfaces(document.level());
    ASSERT_EQ(document.resolved().surface, fresh.surface);
    ASSERT_EQ(document.resolved().source, fresh.source);
    std::vector<std::size_t> counts(document.level().surfaces.size(), 0);
    for (FaceId face = 0; face < fresh.surface.size(); ++face) {
        ASSERT_EQ(document.collision().face_surface(face), fresh.surface[face]) << "face " << face;
        ++counts[fresh.surface[face]];
    }
    for (std::size_t i = 0; i < counts.size(); ++i)
        EXPECT_EQ(document.face_count_of(static_cast<SurfaceId>(i)), counts[i]) << "type " << i;
}

TEST_F(DocumentTest, OpensWithTheSuffixesTypes) {
    const auto document = open();
    ASSERT_EQ(document->face_count(), face_count);
    EXPECT_EQ(document->surface_of(0), default_surface);
    EXPECT_EQ(document->surface_of(wall), ladder);
    EXPECT_EQ(document->source_of(wall), SurfaceSource::suffix);
    EXPECT_FALSE(document->dirty());
    EXPECT_FALSE(document->can_undo());
    EXPECT_FALSE(document->can_redo());
    expect_consistent(*document);
}

TEST_F(DocumentTest, OpenNamesWhatIsWrong) {
    EXPECT_FALSE(Document::open(folder / "missing.obj").ok());
    EXPECT_FALSE(Document::open(folder).ok());
    write_text(folder / "broken.obj", "v 0 0 0\nf 1 2 3\n");
    const auto broken = Document::open(folder / "broken.obj");
    ASSERT_FALSE(broken.ok());
    EXPECT_THAT(broken.error().text(), HasSubstr("broken.obj"));
}

TEST_F(DocumentTest, PaintsUndoesAndRedoes) {
    const auto document = open();
    document->paint(std::vector<FaceId>{5, 3, 5, 4}, ice);
    EXPECT_EQ(document->face_count_of(ice), 3u);
    EXPECT_EQ(document->source_of(4), SurfaceSource::override_);
    ASSERT_EQ(document->history().size(), 1u);
    EXPECT_EQ(document->history()[0].name, "Paint ice");
    EXPECT_EQ(std::get<FaceEdit>(document->history()[0].edits[0]).faces.size(), 3u);  // 5 was given twice
    expect_consistent(*document);

    document->undo();
    EXPECT_EQ(document->face_count_of(ice), 0u);
    EXPECT_EQ(document->paint_of(4), std::nullopt);
    expect_consistent(*document);
    document->redo();
    EXPECT_EQ(document->face_count_of(ice), 3u);
    expect_consistent(*document);
}

TEST_F(DocumentTest, UnsetIsNotDefault) {
    const auto document = open();
    const std::vector<FaceId> faces{wall};
    document->paint(faces, default_surface);
    EXPECT_EQ(document->surface_of(wall), default_surface);
    EXPECT_EQ(document->source_of(wall), SurfaceSource::override_);
    document->paint(faces, std::nullopt);
    EXPECT_EQ(document->surface_of(wall), ladder);
    EXPECT_EQ(document->source_of(wall), SurfaceSource::suffix);
    expect_consistent(*document);
}

TEST_F(DocumentTest, WhatChangesNothingLeavesNoStep) {
    const auto document = open();
    document->paint(std::vector<FaceId>{1, 2}, std::nullopt);
    document->paint({}, ice);
    document->paint(std::vector<FaceId>{100000, no_id}, ice);
    document->paint(std::vector<FaceId>{1}, SurfaceId{200});
    document->select({});
    document->select({no_id});
    document->set_movement(document->level().movement, "Nothing");
    document->set_spawn({Vec3(std::nan(""), 0, 0), 0});
    document->set_surfaces({}, "Nothing");
    document->set_rules(document->level().rules);
    EXPECT_TRUE(document->history().empty());
    EXPECT_FALSE(document->dirty());

    Transaction transaction(*document, "There and back");
    document->paint(std::vector<FaceId>{1}, ice);
    document->paint(std::vector<FaceId>{1}, std::nullopt);
    transaction.commit();
    EXPECT_TRUE(document->history().empty());
}

TEST_F(DocumentTest, RevisionsTellWhatChanged) {
    const auto document = open();
    const std::uint64_t revision = document->revision(), faces = document->face_revision();
    document->select({1});
    EXPECT_GT(document->revision(), revision);
    EXPECT_EQ(document->face_revision(), faces);
    document->paint(std::vector<FaceId>{1}, ice);
    EXPECT_GT(document->face_revision(), faces);
    const auto other = open();
    EXPECT_NE(other->revision(), document->revision());
}

TEST_F(DocumentTest, StrokeIsOneStep) {
    const auto document = open();
    {
        Transaction stroke(*document, "Paint ice");
        for (FaceId face = 0; face < 20; ++face)
            document->paint(std::vector<FaceId>{face}, ice);
        EXPECT_FALSE(document->can_undo());
        document->undo();  // does nothing while the stroke is made
        EXPECT_EQ(document->face_count_of(ice), 20u);
        stroke.commit();
    }
    ASSERT_EQ(document->history().size(), 1u);
    EXPECT_EQ(document->history()[0].edits.size(), 1u);
    document->undo();
    EXPECT_EQ(document->face_count_of(ice), 0u);
    expect_consistent(*document);
}

TEST_F(DocumentTest, AbandonedTransactionTakesEverythingBack) {
    const auto document = open();
    const std::string before = level_to_json(document->level());
    {
        Transaction abandoned(*document, "Change a lot");
        document->paint(std::vector<FaceId>{1, 2, 3}, ice);
        document->paint(std::vector<FaceId>{2}, ladder);
        document->select({7});
        document->set_spawn({Vec3(1, 2, 3), 0.5});
        document->set_rules({{"floor", "ice"}});
        MovementSettings movement;
        movement.gravity = 3;
        document->set_movement(movement, "Change gravity");
    }
    EXPECT_EQ(level_to_json(document->level()), before);
    EXPECT_TRUE(document->selection().empty());
    EXPECT_TRUE(document->history().empty());
    EXPECT_FALSE(document->dirty());
    expect_consistent(*document);
}

TEST_F(DocumentTest, NestedTransactionsAreOneStepUnderTheOuterName) {
    const auto document = open();
    document->begin("Outer");
    document->begin("Inner");
    document->paint(std::vector<FaceId>{1}, ice);
    document->commit();
    EXPECT_TRUE(document->in_transaction());
    document->set_spawn({Vec3(0, 5, 0), 0});
    document->commit();
    document->commit();  // one too many does no harm
    EXPECT_FALSE(document->in_transaction());
    ASSERT_EQ(document->history().size(), 1u);
    EXPECT_EQ(document->history()[0].name, "Outer");
    document->undo();
    EXPECT_EQ(document->paint_of(1), std::nullopt);
}

TEST_F(DocumentTest, SliderDragIsOneEdit) {
    const auto document = open();
    document->begin("Change gravity");
    for (int i = 1; i <= 100; ++i) {
        MovementSettings movement;
        movement.gravity = 20.0 + i;
        document->set_movement(movement, "Change gravity");
    }
    document->commit();
    ASSERT_EQ(document->history().size(), 1u);
    ASSERT_EQ(document->history()[0].edits.size(), 1u);
    const auto& edit = std::get<MovementEdit>(document->history()[0].edits[0]);
    EXPECT_EQ(edit.before.gravity, 20.0);
    EXPECT_EQ(edit.after.gravity, 120.0);
}

TEST_F(DocumentTest, SavesAndOpensAgain) {
    const auto document = open();
    document->paint(std::vector<FaceId>{1, 2, 3}, ice);
    document->paint(std::vector<FaceId>{wall}, default_surface);
    document->set_spawn({Vec3(1, 2, 3), 0.5});
    EXPECT_TRUE(document->dirty());
    ASSERT_TRUE(document->save().ok());
    EXPECT_FALSE(document->dirty());
    const auto again = open();
    EXPECT_EQ(level_to_json(again->level()), level_to_json(document->level()));
    EXPECT_EQ(again->match().exact, 4u);
    EXPECT_EQ(again->resolved().surface, document->resolved().surface);
}

TEST_F(DocumentTest, DirtyFollowsUndoAndIgnoresSelecting) {
    const auto document = open();
    document->select({1, 2});
    EXPECT_FALSE(document->dirty());
    document->paint(std::vector<FaceId>{1}, ice);
    ASSERT_TRUE(document->save().ok());
    document->select({3});
    EXPECT_FALSE(document->dirty());
    document->undo();
    EXPECT_FALSE(document->dirty());
    document->undo();
    EXPECT_TRUE(document->dirty());
    document->redo();
    EXPECT_FALSE(document->dirty());
}

TEST_F(DocumentTest, DirtyOnceTheSavedStateHasLeftTheHistory) {
    const auto document = open();
    document->paint(std::vector<FaceId>{1}, ice);
    ASSERT_TRUE(document->save().ok());
    document->undo();
    document->paint(std::vector<FaceId>{2}, ice);
    EXPECT_TRUE(document->dirty());
    document->undo();
    EXPECT_TRUE(document->dirty());  // the file has face 1 painted
    EXPECT_EQ(document->saved_cursor(), std::nullopt);
}

TEST_F(DocumentTest, UndoneSelectingDoesNotLoseTheSavedState) {
    const auto document = open();
    document->paint(std::vector<FaceId>{1}, ice);
    document->select({1});
    ASSERT_TRUE(document->save().ok());
    document->undo();
    document->select({2});
    EXPECT_FALSE(document->dirty());
}

TEST_F(DocumentTest, SavingDuringAStrokeStaysDirty) {
    const auto document = open();
    document->begin("Paint ice");
    document->paint(std::vector<FaceId>{1}, ice);
    ASSERT_TRUE(document->save().ok());
    document->paint(std::vector<FaceId>{2}, ice);
    document->commit();
    EXPECT_TRUE(document->dirty());
}

TEST_F(DocumentTest, RefusesToSaveOverTheGeometry) {
    const auto document = open();
    const std::string before = read_text(obj);
    for (const std::filesystem::path& name : {obj, folder / "." / "grid.obj", std::filesystem::path()}) {
        EXPECT_FALSE(document->save_as(name).ok()) << name;
        EXPECT_EQ(document->level().file_path, level_file);
    }
    EXPECT_EQ(read_text(obj), before);
}

TEST_F(DocumentTest, FailedSaveKeepsTheDocumentDirty) {
    const auto document = open();
    document->paint(std::vector<FaceId>{1}, ice);
    const Status status = document->save_as(folder / "no such folder" / "a.slipface.json");
    ASSERT_FALSE(status.ok());
    EXPECT_THAT(status.error().text(), HasSubstr("no such folder"));
    EXPECT_TRUE(document->dirty());
    EXPECT_EQ(document->level().file_path, level_file);
}

TEST_F(DocumentTest, SaveAsMovesOn) {
    const auto document = open();
    document->paint(std::vector<FaceId>{1}, ice);
    const auto other = folder / "other.slipface.json";
    ASSERT_TRUE(document->save_as(other).ok());
    EXPECT_FALSE(document->dirty());
    EXPECT_FALSE(std::filesystem::exists(level_file));
    const auto again = Document::open(other);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ((*again)->resolved().surface[1], ice);
}

TEST_F(DocumentTest, RenamingTakesRulesAlong) {
    const auto document = open();
    document->set_rules({{"floor", "ice"}});
    EXPECT_EQ(document->surface_of(0), ice);
    document->rename_surface(ice, "slick");
    EXPECT_EQ(document->level().surfaces[ice].name, "slick");
    EXPECT_EQ(document->level().rules[0].type, "slick");
    EXPECT_EQ(document->surface_of(0), ice);
    EXPECT_EQ(document->history().size(), 2u);
    expect_consistent(*document);
    document->undo();
    EXPECT_EQ(document->level().rules[0].type, "ice");
    expect_consistent(*document);
}

TEST_F(DocumentTest, RefusesNamesThatWouldMislead) {
    const auto document = open();
    for (const char* name : {"", "ladder", "default"}) {
        EXPECT_FALSE(document->rename_problem(ice, name).empty()) << name;
        document->rename_surface(ice, name);
    }
    EXPECT_FALSE(document->rename_problem(default_surface, "ground").empty());
    EXPECT_TRUE(document->rename_problem(ice, "ice").empty());
    EXPECT_TRUE(document->history().empty());
}

TEST_F(DocumentTest, RemovesOnlyUnusedTypesAndMovesTheRest) {
    const auto document = open();
    const SurfaceId sticky = 3, bouncy = 4;
    document->paint(std::vector<FaceId>{1}, bouncy);
    EXPECT_FALSE(document->removal_problem(default_surface).empty());
    EXPECT_THAT(document->removal_problem(ladder), HasSubstr("8 faces"));
    EXPECT_THAT(document->removal_problem(bouncy), HasSubstr("1 face has"));
    document->set_rules({{"no such material", "ice"}});
    EXPECT_THAT(document->removal_problem(ice), HasSubstr("rule"));
    const std::size_t before = document->history().size();
    document->remove_surface(ladder);
    EXPECT_EQ(document->history().size(), before);

    document->remove_surface(sticky);
    EXPECT_EQ(document->history().size(), before + 1);
    EXPECT_EQ(document->level().surfaces[3].name, "bouncy");
    EXPECT_EQ(document->paint_of(1), SurfaceId{3});
    expect_consistent(*document);
    document->undo();
    EXPECT_EQ(document->paint_of(1), bouncy);
    EXPECT_EQ(document->level().surfaces[3].name, "sticky");
    expect_consistent(*document);
    document->redo();
    expect_consistent(*document);
}

TEST_F(DocumentTest, TableCannotShrinkBelowPaintedFaces) {
    const auto document = open();
    document->paint(std::vector<FaceId>{1}, SurfaceId{7});
    auto shorter = document->level().surfaces;
    shorter.resize(4);
    document->set_surfaces(shorter, "Shrink");
    EXPECT_EQ(document->level().surfaces.size(), 8u);
    document->undo();
    document->set_surfaces(shorter, "Shrink");
    EXPECT_EQ(document->level().surfaces.size(), 4u);
}

TEST_F(DocumentTest, PicksFacesThatAreNotSolid) {
    const auto document = open();
    const Vec3 above(0.5, 5, 0.5), down(0, -1, 0);
    auto surfaces = document->level().surfaces;
    surfaces[ice].solid = false;
    document->set_surfaces(surfaces, "Open ice");
    document->paint(std::vector<FaceId>{0}, ice);
    EXPECT_FALSE(cast_ray(document->collision(), above, down).has_value());
    const auto hit = document->pick(above, down, false);
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->face, 0u);
    EXPECT_FALSE(cast_ray(document->collision(), above, down).has_value());  // as before
}

TEST_F(DocumentTest, PicksThroughBackFacesWhenTheyAreHidden) {
    const auto document = open();
    const Vec3 below(0.5, -5, 0.5), up(0, 1, 0);
    EXPECT_TRUE(document->pick(below, up, false).has_value());
    EXPECT_FALSE(document->pick(below, up, true).has_value());
    EXPECT_EQ(document->pick(Vec3(0.5, 5, 0.5), -up, true)->face, 0u);
}

TEST_F(DocumentTest, GoesToAnyStep) {
    const auto document = open();
    for (FaceId face = 0; face < 5; ++face)
        document->paint(std::vector<FaceId>{face}, ice);
    document->go_to(2);
    EXPECT_EQ(document->face_count_of(ice), 2u);
    document->go_to(5);
    EXPECT_EQ(document->face_count_of(ice), 5u);
    document->go_to(99);
    EXPECT_EQ(document->history_cursor(), 5u);
}

// However long the work, the history holds no more than its limit, and what is left of it can be undone.
TEST_F(DocumentTest, HistoryForgetsItsOldestSteps) {
    constexpr int side = 400;
    write_text(obj, floor_and_wall_obj(side));
    const auto document = open();
    std::vector<FaceId> all(side * side);
    std::iota(all.begin(), all.end(), FaceId{0});
    const std::size_t stroke = all.size() * sizeof(FaceEdit::Face);
    const std::size_t strokes = Document::max_history_bytes / stroke + 20;
    const std::size_t mark = document->history_mark();
    for (std::size_t i = 0; i < strokes; ++i)
        document->paint(all, i % 2 == 0 ? ice : ladder);
    std::size_t held = 0;
    for (const HistoryStep& step : document->history())
        held += step.bytes();
    EXPECT_LE(held, Document::max_history_bytes);
    EXPECT_GT(held, Document::max_history_bytes - 2 * stroke);
    EXPECT_EQ(document->history_cursor(), document->history().size());
    EXPECT_EQ(document->history_mark(), mark + strokes);
    EXPECT_FALSE(document->saved_cursor());
    EXPECT_TRUE(document->dirty());
    document->roll_back(mark + strokes - 3);
    EXPECT_EQ(document->history_mark(), mark + strokes - 3);
    document->roll_back(mark);
    EXPECT_EQ(document->history_cursor(), 0u) << "as far as there is a history";
    EXPECT_TRUE(document->dirty());
    EXPECT_NE(document->surface_of(0), default_surface);
}

class RecentFilesTest : public LevelFixture {
  protected:
    std::filesystem::path list() const { return folder / "config" / "recent"; }
};

TEST_F(RecentFilesTest, NewestFirstWithoutRepeatsAndKept) {
    RecentFiles recent(list());
    EXPECT_TRUE(recent.paths().empty());
    recent.add("/levels/a.obj");
    recent.add("/levels/b.obj");
    recent.add("/levels/../levels/a.obj");
    EXPECT_THAT(recent.paths(), ElementsAre("/levels/a.obj", "/levels/b.obj"));
    EXPECT_EQ(RecentFiles(list()).paths(), recent.paths());
    for (int i = 0; i < 40; ++i)
        recent.add("/levels/" + std::to_string(i));
    EXPECT_EQ(recent.paths().size(), RecentFiles::capacity);
    EXPECT_EQ(recent.paths().front(), "/levels/39");
}

TEST_F(RecentFilesTest, OddContentsAreLeftOut) {
    std::filesystem::create_directories(list().parent_path());
    using namespace std::string_literals;
    write_text(list(), "\n/a.obj\r\n/bin\0ary\nrelative.obj\n/a.obj\n/b c.obj\n\xff\xfe\n/last.obj"s);
    EXPECT_THAT(RecentFiles(list()).paths(), ElementsAre("/a.obj", "/b c.obj", "/last.obj"));
    write_text(list(), std::string(3 << 20, 'x'));
    EXPECT_TRUE(RecentFiles(list()).paths().empty());
    std::filesystem::remove(list());
    std::filesystem::create_directories(list());  // a folder where the file should be
    RecentFiles recent(list());
    recent.add("/levels/a.obj");
    EXPECT_THAT(recent.paths(), ElementsAre("/levels/a.obj"));
    recent.add(std::string("/levels/two\nlines.obj"));
    EXPECT_EQ(recent.paths().size(), 1u);
}

TEST(ConfigFolder, FollowsTheEnvironment) {
    const auto keep = [](const char* name) {
        const char* value = std::getenv(name);
        return value ? std::optional<std::string>(value) : std::nullopt;
    };
    const auto put = [](const char* name, const std::optional<std::string>& value) {
        if (value)
            setenv(name, value->c_str(), 1);
        else
            unsetenv(name);
    };
    const auto config = keep("XDG_CONFIG_HOME"), home = keep("HOME");
    put("XDG_CONFIG_HOME", "/x/config");
    put("HOME", "/home/someone");
    EXPECT_EQ(config_folder(), "/x/config/slipface");
    put("XDG_CONFIG_HOME", "relative");
    EXPECT_EQ(config_folder(), "/home/someone/.config/slipface");
    put("XDG_CONFIG_HOME", std::nullopt);
    put("HOME", std::nullopt);
    EXPECT_TRUE(config_folder().empty());
    put("XDG_CONFIG_HOME", config);
    put("HOME", home);
}

}  // namespace
}  // namespace slipface

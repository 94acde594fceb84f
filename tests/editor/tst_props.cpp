// Props in the editor: placed by clicks and scripts, changed by handles, undone step by step.
#include <cmath>
#include <random>

#include "app_fixture.h"
#include "slipface/level/level_file.h"
#include "tools/props/props.h"

namespace slipface {
namespace {

class EditorProps : public AppFixture {
  protected:
    void SetUp() override {
        AppFixture::SetUp();
        std::filesystem::create_directories(folder / "parts");
        // A box with its corner at the origin; the group's faces are 0 to 4.
        write_text(
            folder / "parts/box.obj",
            "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\no box\nusemtl side\n"
            "f 5 8 7 6\nf 1 2 3 4\nf 4 3 7 8\nf 2 1 5 6\nf 3 2 6 7\nf 1 4 8 5\n");
    }
    const std::vector<Prop>& props() { return document().level().props; }
};

TEST_F(EditorProps, ArePlacedChangedAndUndone) {
    EXPECT_EQ(find_prop_files(document().level()), std::vector<std::string>{"parts/box.obj"});
    EXPECT_EQ(run("prop place parts/box.obj 2,0,2"), "");
    EXPECT_EQ(run("prop place parts/box.obj 4,0,2"), "");
    ASSERT_EQ(props().size(), 2U);
    EXPECT_EQ(props()[0].name, "box");
    EXPECT_EQ(props()[1].name, "box 2");
    EXPECT_EQ(document().face_count(), face_count + 12);
    EXPECT_EQ(document().selection().size(), 6U);
    EXPECT_EQ(run("prop set \"box 2\" scale 1,-2,1\nprop set box rotation 0,90,0\nprop set box type ice"),
              "");
    EXPECT_EQ(props()[1].scale, Vec3(1, -2, 1));
    EXPECT_EQ(document().face_count_of(ice), 6U);
    // The first one's face is painted; it stays so when the other goes, and goes with its prop.
    const FaceId top = static_cast<FaceId>(face_count);
    editor().document->paint(std::array{top + 6}, ladder);
    EXPECT_EQ(run("prop delete box"), "");
    EXPECT_EQ(document().paint_of(top), ladder);
    EXPECT_EQ(run("command edit.undo"), "");
    EXPECT_EQ(document().paint_of(top + 6), ladder);
    EXPECT_EQ(document().paint_of(top), std::nullopt);
    EXPECT_EQ(run("prop duplicate \"box 2\""), "");
    ASSERT_EQ(props().size(), 3U);
    EXPECT_EQ(props()[2].name, "box 3");
    EXPECT_EQ(document().paint_of(top + 12), ladder);
    while (document().can_undo())
        editor().document->undo();
    EXPECT_TRUE(props().empty());
    EXPECT_EQ(document().face_count(), face_count);
    while (document().can_redo())
        editor().document->redo();
    EXPECT_EQ(props().size(), 3U);
    EXPECT_EQ(run("command file.save"), "");
    const auto again = load_level(level_file);
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(again->level.props, props());
    const ResolvedSurfaces read = resolve_surfaces(again->level), shown = document().resolved();
    ASSERT_EQ(read.source.size(), shown.source.size());
    for (FaceId face = 0; face < read.source.size(); ++face)
        EXPECT_EQ(read.source[face], shown.source[face]) << face;
}

// A change of the props is made in the present state; a new document computes all of it.
TEST_F(EditorProps, EditedAtRandomAreAsReadAnew) {
    write_text(folder / "parts/post.obj",
               "v 0 0 0\nv 0.3 0 0\nv 0.3 2 0\nv 0 2 0.1\nusemtl post\nf 1 2 3 4\nf 1 4 2\n");
    std::mt19937 random(11);
    const auto below = [&](std::size_t n) { return random() % n; };
    const auto number = [&](double size) {
        return size * (static_cast<double>(random()) / 4294967296.0 - 0.5);
    };
    std::size_t most = 0;
    for (int round = 0; round < 300; ++round) {
        SCOPED_TRACE(round);
        const std::size_t kind = below(12), count = props().size();
        const std::size_t prop = count == 0 ? 0 : below(count);
        if (kind <= 2 || count == 0) {
            const char* const files[] = {"parts/box.obj", "parts/post.obj", "parts/missing.obj"};
            add_prop(editor(), files[below(8) == 0 ? 2 : below(2)], {number(9), 0, number(9)});
        } else if (kind == 3) {
            duplicate_prop(editor(), prop);
        } else if (kind == 4) {
            remove_prop(editor(), prop);
        } else if (kind <= 6) {
            Prop to = props()[prop];
            to.position = {number(9), number(3), number(9)};
            to.rotation = {number(6), number(6), number(6)};
            if (below(2) == 0) to.scale = {number(3) + 2, -1 - number(1), 1};
            change_prop(editor(), prop, to, "Move");
        } else if (kind == 7) {
            paint_prop(editor(), prop, below(2) == 0 ? std::optional<SurfaceId>() : ice);
        } else if (kind == 8) {
            const auto face = static_cast<FaceId>(below(document().face_count()));
            editor().document->paint(std::array{face}, below(3) == 0 ? std::optional<SurfaceId>() : ladder);
        } else if (kind == 9) {
            editor().document->hide({static_cast<FaceId>(below(document().face_count()))}, "Hide");
        } else if (kind == 10) {
            for (std::size_t i = below(6); i > 0; --i)
                editor().document->undo();
        } else {
            for (std::size_t i = below(6); i > 0; --i)
                editor().document->redo();
        }
        most = std::max(most, props().size());
        const Level& level = document().level();
        const ResolvedSurfaces fresh = resolve_surfaces(level), now = document().resolved();
        ASSERT_EQ(now.surface, fresh.surface);
        ASSERT_EQ(now.source, fresh.source);
        std::vector<std::size_t> faces(level.surfaces.size());
        std::vector<double> areas(level.surfaces.size());
        for (FaceId face = 0; face < document().face_count(); ++face) {
            ASSERT_EQ(document().surface_of(face), fresh.surface[face]);
            ++faces[fresh.surface[face]];
            areas[fresh.surface[face]] += face_area(*level.mesh, face);
        }
        for (SurfaceId type = 0; type < faces.size(); ++type) {
            ASSERT_EQ(document().face_count_of(type), faces[type]) << int{type};
            ASSERT_NEAR(document().area_of(type), areas[type], 1e-3);
        }
        if (round % 10 != 9) continue;
        const CollisionWorld world = std::move(build_collision_world(level).value());
        ASSERT_EQ(world.triangle_count(), document().collision().triangle_count());
        for (TriangleId triangle = 0; triangle < world.triangle_count(); ++triangle) {
            ASSERT_EQ(world.triangle(triangle), document().collision().triangle(triangle));
            const FaceId face = world.triangle_face(triangle);
            ASSERT_EQ(face, document().collision().triangle_face(triangle));
            ASSERT_EQ(document().collision().face_surface(face), fresh.surface[face]);
        }
        ASSERT_TRUE(editor().document->save());
        const auto again = load_level(level_file);
        ASSERT_TRUE(again.ok());
        EXPECT_EQ(again->level.props, props());
        EXPECT_EQ(resolve_surfaces(again->level).surface, fresh.surface);
        EXPECT_EQ(again->level.hidden, level.hidden);
        EXPECT_EQ(again->level.mesh.fingerprint(), level.mesh.fingerprint());
    }
    EXPECT_GT(most, 20U);
}

// Other programs write the mesh of a prop, or one that was missing.
TEST_F(EditorProps, AreReadAgainWhenTheirMeshChanges) {
    EXPECT_EQ(run("prop place parts/box.obj 2,0,2\nprop place parts/late.obj 4,0,2"), "");
    EXPECT_EQ(document().face_count(), face_count + 6);
    bool shown_changed = false;
    double now = 100.0;
    const auto seconds = [&](int count) {
        for (int i = 0; i < count; ++i)
            tick_session(editor(), now += 1.0, shown_changed);
    };
    seconds(3);
    const std::string box = read_text(folder / "parts/box.obj");
    write_text(folder / "parts/box.obj", box + "v 9 9 9\nv 8 9 9\nv 8 9 8\nf 9 10 11\n");
    seconds(4);
    EXPECT_EQ(document().face_count(), face_count + 7) << editor().status;
    write_text(folder / "parts/late.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    seconds(4);
    EXPECT_EQ(document().face_count(), face_count + 8) << editor().status;
    const std::size_t steps = document().history().size();
    write_text(folder / "parts/late.obj", read_text(folder / "parts/late.obj"));
    seconds(4);
    EXPECT_EQ(document().history().size(), steps) << "the same bytes";
    write_text(folder / "parts/box.obj", "v 0 0 0\nf 1 2 3\n");
    seconds(4);
    EXPECT_EQ(document().face_count(), face_count + 1) << "of the other";
    EXPECT_EQ(props().size(), 2U);
    write_text(folder / "parts/box.obj", box);
    seconds(4);
    EXPECT_EQ(document().face_count(), face_count + 7);
}

TEST_F(EditorProps, StandWhereTheMouseClicksAndFollowTheirHandles) {
    look_down();
    EXPECT_EQ(run("prop file parts/box.obj\nviewport click @5,0,5\nexpect props 1"), "");
    EXPECT_LT((props()[0].position - Vec3(5, 0, 5)).norm(), 0.1);
    EXPECT_EQ(run("prop file none\nprop set box position 5,0,5\ncommand props.move"), "");
    const std::size_t steps = document().history_cursor();
    // From the middle of the handle along x; a drag is one step, in quarters of a metre.
    EXPECT_EQ(run("viewport drag @5.8,0,5 @3.83,0,5"), "");
    EXPECT_EQ(document().history_cursor(), steps + 1);
    EXPECT_EQ(props()[0].position, Vec3(3, 0, 5));
    EXPECT_EQ(run("viewport click @3.5,1,5.5"), "");
    EXPECT_EQ(chosen_prop(editor()), 0U);
    EXPECT_EQ(document().selection().size(), 6U);
    EXPECT_EQ(run("viewport click @7,0,7"), "");
    EXPECT_FALSE(chosen_prop(editor()).has_value());
}

TEST_F(EditorProps, TurnAboutOneAxisByTheAngleWhateverTheirRotation) {
    const Prop turned = turned_prop(turned_prop({}, 1, 0.3), 0, 0.7);
    const Prop more = turned_prop(turned, 2, -1.1);
    const Placement before = turned.placement(), after = more.placement();
    const double sine = std::sin(-1.1), cosine = std::cos(-1.1);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& from = before.columns[i];
        const Vec3 expected(cosine * from.x() - sine * from.y(), sine * from.x() + cosine * from.y(),
                            from.z());
        EXPECT_LT((after.columns[i] - expected).norm(), 1e-12);
    }
    // Upright: two of the axes are the same.
    const Prop upright = turned_prop({}, 0, 1.5707963267948966);
    const Prop again = turned_prop(upright, 1, 0.4);
    EXPECT_LT((again.placement().columns[0] - Vec3(std::cos(0.4), 0, -std::sin(0.4))).norm(), 1e-9);
}

TEST_F(EditorProps, MoveByThemselvesAsPlatforms) {
    EXPECT_EQ(run("prop place parts/box.obj 2,0,2 lift"), "");
    set_prop_motion(editor(), 0, {Vec3(0, 3, 0), 1.5, 0.5});
    ASSERT_EQ(document().level().platforms.size(), 1U);
    EXPECT_EQ(run("prop set lift name hoist\nprop set hoist position 5,0,2"), "");
    EXPECT_EQ(document().level().platforms[0].group, "hoist");
    EXPECT_EQ(document().level().platforms[0].spin_pivot, Vec3(5, 0, 2));
    EXPECT_EQ(prop_motion(document().level(), props()[0]).way, Vec3(0, 3, 0));
    EXPECT_EQ(run("prop delete hoist"), "");
    EXPECT_TRUE(document().level().platforms.empty());
    EXPECT_EQ(run("command edit.undo"), "");
    EXPECT_EQ(document().level().platforms.size(), 1U);
}

TEST_F(EditorProps, MistakesAreNamedAndChangeNothing) {
    EXPECT_NE(run("prop place parts/box.obj 1,2"), "");
    EXPECT_NE(run("prop choose crate").find("no prop \"crate\"; there are: none"), std::string::npos);
    EXPECT_EQ(run("prop place parts/box.obj 1,0,1 a\nprop place parts/box.obj 3,0,1 b"), "");
    EXPECT_NE(run("prop set a name b").find("Another prop has this name"), std::string::npos);
    EXPECT_NE(run("prop set a scale 0,1,1").find("scale"), std::string::npos);
    EXPECT_NE(run("prop set a colour red").find("no member \"colour\""), std::string::npos);
    EXPECT_NE(run("prop lift a").find("expected: prop place"), std::string::npos);
    // A mesh that is not there: the prop is listed and can be mended.
    EXPECT_EQ(run("prop set a mesh nowhere.obj"), "");
    EXPECT_NE(editor().status.find("there is no such file"), std::string::npos);
    EXPECT_EQ(document().face_count(), face_count + 6);
    EXPECT_EQ(run("only props\nprop choose a\nprop set a mesh parts/box.obj"), "");
    EXPECT_EQ(document().face_count(), face_count + 12);
}

}  // namespace
}  // namespace slipface

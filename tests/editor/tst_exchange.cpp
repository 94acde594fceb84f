// Presets and exports from the editor: by command, browser and script, and what goes wrong with them.
#include <gmock/gmock.h>

#include "app_fixture.h"
#include "slipface/level/preset.h"
#include "tools/session/exchange.h"

namespace slipface {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class Exchange : public AppFixture {
  protected:
    const MovementSettings& movement() { return document().level().movement; }
    // Types `path` into the browser that `command` opens, and presses `button`.
    std::string by_browser(const std::string& command, const std::filesystem::path& path,
                           const std::string& button) {
        return run("command " + command + "\nclick \"File dialog/Path\"\nkey Ctrl+A\ntype \"" +
                   path.string() + "\"\nclick \"File dialog/" + button + "\"");
    }
};

TEST_F(Exchange, APresetIsSavedAndOpenedAsOneStep) {
    ASSERT_EQ(run("set walk_speed=3.25\nset nudge=on"), "");
    const MovementSettings saved = movement();
    ASSERT_EQ(by_browser("movement.save_preset", folder / "slow-walk", "Save"), "");
    EXPECT_EQ(editor().status, "Saved preset Slow walk as slow-walk.json");
    const Result<Preset> file = load_preset(folder / "slow-walk.json");
    ASSERT_TRUE(file) << file.error().text();
    EXPECT_EQ(file->name, "Slow walk");
    EXPECT_EQ(file->settings, saved);

    ASSERT_EQ(run("command movement.reset"), "");
    const std::size_t steps = document().history().size();
    ASSERT_EQ(run("command movement.open_preset\nexpect no_widget \"File dialog/List/grid.obj\"\n"
                  "click \"File dialog/List/slow-walk.json\"\nclick \"File dialog/Open\""),
              "");
    EXPECT_EQ(movement(), saved);
    ASSERT_EQ(document().history().size(), steps + 1);
    EXPECT_EQ(document().history().back().name, "Preset Slow walk");
    ASSERT_EQ(run("key Ctrl+Z"), "");
    EXPECT_EQ(movement(), MovementSettings{});
}

TEST_F(Exchange, APresetThatIsReplacedHandsOnItsName) {
    ASSERT_TRUE(save_preset(folder / "own.json", Preset{"House rules", "As we like it.", {}}));
    ASSERT_EQ(run("set gravity=12\npreset save own.json\ncommand movement.reset\npreset open own.json"), "");
    EXPECT_EQ(movement().gravity, 12.0);
    EXPECT_EQ(editor().status, "Preset House rules");
    EXPECT_EQ(load_preset(folder / "own.json")->about, "As we like it.");
}

TEST_F(Exchange, AWrongPresetIsReportedWithItsLocationAndChangesNothing) {
    ASSERT_EQ(run("set walk_speed=3"), "");
    const MovementSettings before = movement();
    const std::size_t steps = document().history().size();
    write_text(folder / "bad.json",
               R"({"slipface_preset": 1, "name": "Bad", "movement": {"gravity": 5, "walk_sped": 2}})");
    ASSERT_EQ(by_browser("movement.open_preset", folder / "bad.json", "Open"), "");
    ASSERT_TRUE(editor().message);
    EXPECT_EQ(editor().message->title, "Cannot open bad.json");
    EXPECT_THAT(editor().message->text, HasSubstr("bad.json:/movement/walk_sped"));
    EXPECT_EQ(movement(), before);
    EXPECT_EQ(document().history().size(), steps);
    ASSERT_EQ(run("click \"Message/OK\"\npreset open nowhere.json\nexpect message \"*nowhere.json*\""), "");
    EXPECT_EQ(movement(), before);
}

TEST_F(Exchange, APresetIsNotSavedOverALevel) {
    ASSERT_TRUE(editor().document->save());
    const std::string level = read_text(level_file), geometry = read_text(obj);
    ASSERT_EQ(run("preset save grid.slipface.json\nexpect message \"Cannot save*file of a level*\"\n"
                  "click \"Message/OK\"\npreset save grid.obj\nexpect message \"Cannot save*\""),
              "");
    EXPECT_EQ(read_text(level_file), level);
    EXPECT_EQ(read_text(obj), geometry);
    EXPECT_THAT(run("preset burn a.json"), HasSubstr("open or save"));
}

TEST_F(Exchange, ExportsGoThroughTheBrowserAndSayWhatWasWritten) {
    ASSERT_EQ(run("select faces 0-4\nkey 2\nkey L"), "");  // ice, and not saved
    ASSERT_TRUE(document().dirty());
    ASSERT_EQ(run("command file.export_obj\nclick \"File dialog/Save\""), "");  // the name that is offered
    EXPECT_THAT(editor().status,
                StartsWith("Exported grid-typed.obj and grid-typed.mtl: 72 faces, 3 types, "));
    EXPECT_THAT(editor().status, EndsWith(" KB"));
    const Result<LoadedLevel> again = load_level(folder / "grid-typed.obj");
    ASSERT_TRUE(again) << again.error().text();
    EXPECT_EQ(resolve_surfaces(again->level).surface, document().resolved().surface);

    ASSERT_EQ(by_browser("file.export_gltf", folder / "out", "Save"), "");
    EXPECT_THAT(editor().status, StartsWith("Exported out.gltf and out.bin: "));
    EXPECT_THAT(read_text(folder / "out.gltf"), HasSubstr("\"slipface_type\""));
    ASSERT_EQ(by_browser("file.export_gltf", folder / "one.glb", "Save"), "");
    EXPECT_THAT(editor().status, StartsWith("Exported one.glb: "));
    EXPECT_THAT(read_text(folder / "one.glb"), StartsWith("glTF"));
    ASSERT_EQ(by_browser("file.export_game", folder / "level", "Save"), "");
    EXPECT_THAT(read_text(folder / "level.flat"), StartsWith("slipflat"));
    EXPECT_TRUE(document().dirty()) << "exporting is not saving";
}

TEST_F(Exchange, WhatAnExportWouldReplaceIsAskedAbout) {
    write_text(folder / "out.mtl", "newmtl precious\n");
    ASSERT_EQ(by_browser("file.export_obj", folder / "out.obj", "Save"), "");
    EXPECT_FALSE(std::filesystem::exists(folder / "out.obj"));
    ASSERT_EQ(run("expect widget \"File dialog/Replace\"\nclick \"File dialog/Keep it\"\nkey Escape"), "");
    EXPECT_EQ(read_text(folder / "out.mtl"), "newmtl precious\n");
}

TEST_F(Exchange, ExportsRefuseTheLevelsOwnFilesInTheDialog) {
    write_text(folder / "stone.mtl", "newmtl floor\n");
    write_text(obj, "mtllib stone.mtl\n" + floor_and_wall_obj(n));
    ASSERT_EQ(run("open grid.obj"), "");
    const std::string geometry = read_text(obj);
    ASSERT_EQ(
        run("export obj grid.obj\nexpect message \"Cannot export grid.obj:*of the level itself*\"\n"
            "click \"Message/OK\"\nexport obj stone.obj\nexpect message \"*stone.mtl*of the level itself*\"\n"
            "click \"Message/OK\"\nexport gltf nowhere/a.gltf\nexpect message \"Cannot export a.gltf*\"\n"
            "click \"Message/OK\"\nexport game grid.obj\nexpect message \"Cannot export*\""),
        "");
    EXPECT_EQ(read_text(obj), geometry);
    EXPECT_EQ(read_text(folder / "stone.mtl"), "newmtl floor\n");
    EXPECT_FALSE(std::filesystem::exists(folder / "stone.obj"));
    EXPECT_THAT(run("export fbx a.fbx"), HasSubstr("obj, gltf or game"));
}

TEST_F(Exchange, BakingSaysWhatItDidOrWhyNot) {
    ASSERT_EQ(run("select faces 0-4\nkey 2\nkey L\ncommand file.name_materials"), "");
    EXPECT_EQ(editor().status, "types of 5 faces written into grid.obj; the old file is grid.obj.bak");
    EXPECT_THAT(read_text(obj), HasSubstr("usemtl floor__ice"));
    ASSERT_EQ(run("select faces 9\nkey 2\nkey L"), "");
    const std::string other = floor_and_wall_obj(n + 1);
    write_text(obj, other);
    ASSERT_EQ(run("command file.name_materials\nexpect message \"Cannot write the types: *grid.obj*\""), "");
    EXPECT_EQ(read_text(obj), other);
    EXPECT_TRUE(document().dirty());
}

TEST_F(Exchange, BakingKeepsWhatIsHiddenAndSelected) {
    ASSERT_EQ(run("select faces 2,3\nselect save pair\nselect faces 7\ncommand select.hide\n"
                  "select faces 0-4\nkey 2\nkey L\ncommand file.name_materials"),
              "");
    EXPECT_THAT(document().hidden(), testing::ElementsAre(7));
    ASSERT_EQ(document().saved_selections().size(), 1u);
    EXPECT_THAT(document().saved_selections()[0].faces, testing::ElementsAre(2, 3));
}

}  // namespace
}  // namespace slipface

// Rules for materials: what each does, and that every change is one step.
#include "level_fixture.h"
#include "tools/selection/material_rules.h"

namespace slipface {
namespace {

class MaterialRules : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        open_level(editor, obj);
        ASSERT_TRUE(editor.document);
    }
    const Document& document() const { return *editor.document; }
    std::size_t steps() const { return document().history_cursor(); }
    Editor editor;
};

TEST_F(MaterialRules, TheLastRuleThatMatchesCountsAfterSuffixAndPaint) {
    add_rule(editor, {"*", "hazard"});
    add_rule(editor, {"FLOOR.001", "ice"});
    add_rule(editor, {"fl?or", "no such type"});
    editor.document->paint(std::vector<FaceId>{5}, SurfaceId{3});
    const RuleReport& report = rule_report(document());
    ASSERT_EQ(report.rules.size(), 3u);
    EXPECT_EQ(report.rules[0].materials, 2u);
    EXPECT_EQ(report.rules[0].faces, 72u);
    EXPECT_EQ(report.rules[0].deciding, 0u) << "the wall has a suffix, the floor a later rule";
    EXPECT_EQ(report.rules[1].faces, 64u);
    EXPECT_EQ(report.rules[1].deciding, 63u);
    EXPECT_FALSE(report.rules[2].knows_type);
    ASSERT_EQ(report.materials.size(), 2u);
    EXPECT_EQ(report.materials[0].faces, 64u) << "most faces first";
    EXPECT_EQ(report.materials[0].rule, 1u);
    EXPECT_TRUE(report.materials[1].suffix);
    // It says what the level says.
    for (const MaterialUse& use : report.materials)
        for (FaceId face = 0; face < document().face_count(); ++face)
            if (document().mesh().face_material[face] == use.material) {
                EXPECT_EQ(document().unpainted(face), use.type) << face;
            }
    EXPECT_EQ(faces_of_rule(document(), {"w*", ""}).size(), 8u);
}

TEST_F(MaterialRules, EachChangeIsOneStepAndUndoGoesBack) {
    const std::vector<MaterialRule> none = document().level().rules;
    add_rule(editor, {"floor", "ice"});
    add_rule(editor, {"*", "hazard"});
    EXPECT_EQ(editor.rule, 1u);
    EXPECT_EQ(document().resolved().surface[0], *find_surface(document().level(), "hazard"));
    move_rule(editor, 1, 0);
    EXPECT_EQ(editor.rule, 0u);
    EXPECT_EQ(document().resolved().surface[0], *find_surface(document().level(), "ice"));
    change_rule(editor, 1, {"floor", "sticky"});
    EXPECT_EQ(document().resolved().surface[0], *find_surface(document().level(), "sticky"));
    remove_rule(editor, 1);
    EXPECT_FALSE(editor.rule);
    EXPECT_EQ(document().resolved().surface[0], *find_surface(document().level(), "hazard"));
    EXPECT_EQ(steps(), 5u);
    // What does not exist is not changed.
    remove_rule(editor, 7);
    move_rule(editor, 0, 7);
    change_rule(editor, 7, {"a", "ice"});
    EXPECT_EQ(steps(), 5u);
    for (int i = 0; i < 5; ++i)
        editor.document->undo();
    EXPECT_EQ(document().level().rules, none);
}

TEST_F(MaterialRules, TheFacesUnderTheBrushGiveTheirMaterials) {
    editor.brush = find_surface(document().level(), "ice");
    editor.document->select({3, 4, 65});
    add_rules_for_faces(editor);
    ASSERT_EQ(document().level().rules.size(), 2u);
    EXPECT_EQ(document().level().rules[0], (MaterialRule{"floor", "ice"}));
    EXPECT_EQ(editor.status, "2 rules added: ice; a suffix of the material's name comes first");
    editor.document->undo();
    EXPECT_TRUE(document().level().rules.empty()) << "one step";
}

}  // namespace
}  // namespace slipface

// The level's rules: types for materials by their names, the first of the three layers.
#pragma once

#include "tools/editor.h"

namespace slipface {

// What one rule does in the open level.
struct RuleEffect {
    std::size_t materials = 0;  // whose names match
    std::size_t faces = 0;      // with these materials
    std::size_t deciding = 0;   // of them, the ones that have their type from this rule
    bool knows_type = true;     // false: the level has no type of that name, so the rule does nothing
};

// One material of the level, with faces.
struct MaterialUse {
    std::uint32_t material = 0;       // index into Mesh::materials
    std::size_t faces = 0;            // with it
    SurfaceId type = 0;               // of its unpainted faces
    std::optional<std::size_t> rule;  // that gives the type; nothing: a suffix does, or nothing does
    bool suffix = false;
};

struct RuleReport {
    std::vector<RuleEffect> rules;       // [rule]
    std::vector<MaterialUse> materials;  // most faces first
};
// Valid until the document changes.
const RuleReport& rule_report(const Document& document);

// Each is one step of history. A new rule counts before all others and is the one shown in the Rules panel.
void add_rule(Editor& editor, MaterialRule rule);
void change_rule(Editor& editor, std::size_t rule, MaterialRule changed);
void remove_rule(Editor& editor, std::size_t rule);
void move_rule(Editor& editor, std::size_t rule, std::size_t to);

// Adds a rule with the brush's type for each material of the selected faces, or of the face under the mouse.
void add_rules_for_faces(Editor& editor);

// The faces whose material's name matches.
std::vector<FaceId> faces_of_rule(const Document& document, const MaterialRule& rule);

}  // namespace slipface

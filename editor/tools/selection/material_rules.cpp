#include "tools/selection/material_rules.h"

#include <algorithm>

#include "slipface/base/counted.h"
#include "slipface/base/text.h"
#include "slipface/level/material_name.h"
#include "tools/selection/selecting.h"

namespace slipface {
namespace {

RuleReport make_report(const Document& document) {
    const Level& level = document.level();
    const Mesh& mesh = document.mesh();
    RuleReport report;
    report.rules.resize(level.rules.size());
    std::vector<std::size_t> faces(mesh.materials.size(), 0), painted(mesh.materials.size(), 0);
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        ++faces[mesh.face_material[face]];
        painted[mesh.face_material[face]] += document.source_of(face) == SurfaceSource::override_;
    }
    std::vector<std::string> patterns;
    for (std::size_t i = 0; i < level.rules.size(); ++i) {
        patterns.push_back(normal_pattern(level.rules[i].pattern));
        report.rules[i].knows_type = find_surface(level, level.rules[i].type).has_value();
    }
    for (std::uint32_t i = 0; i < mesh.materials.size(); ++i) {
        if (faces[i] == 0) continue;
        MaterialUse use{i, faces[i], default_surface, std::nullopt, false};
        const std::string name = normal_name(mesh.materials[i].name);
        for (std::size_t k = 0; k < patterns.size(); ++k) {
            if (!glob_match(patterns[k], name)) continue;
            ++report.rules[k].materials;
            report.rules[k].faces += faces[i];
            if (report.rules[k].knows_type) use.rule = k;
        }
        if (const auto suffix = suffix_surface(mesh.materials[i].name, level.surfaces)) {
            use.suffix = true;
            use.rule.reset();
            use.type = *suffix;
        } else if (use.rule) {
            use.type = *find_surface(level, level.rules[*use.rule].type);
            report.rules[*use.rule].deciding += faces[i] - painted[i];
        }
        report.materials.push_back(use);
    }
    std::stable_sort(report.materials.begin(), report.materials.end(),
                     [](const MaterialUse& a, const MaterialUse& b) { return a.faces > b.faces; });
    return report;
}

void set_rules(Editor& editor, std::vector<MaterialRule> rules, std::string step_name) {
    editor.document->set_rules(std::move(rules), std::move(step_name));
}

}  // namespace

const RuleReport& rule_report(const Document& document) {
    static std::uint64_t revision = 0;
    static RuleReport report;
    if (revision != document.face_revision()) {
        revision = document.face_revision();
        report = make_report(document);
    }
    return report;
}

void add_rule(Editor& editor, MaterialRule rule) {
    if (!editor.document) return;
    std::vector<MaterialRule> rules = editor.document->level().rules;
    if (rules.size() >= max_material_rules) return;
    const std::string step_name = "Add rule " + rule.pattern;
    rules.push_back(std::move(rule));
    editor.rule = rules.size() - 1;
    set_rules(editor, std::move(rules), step_name);
}

void change_rule(Editor& editor, std::size_t rule, MaterialRule changed) {
    if (!editor.document || rule >= editor.document->level().rules.size()) return;
    std::vector<MaterialRule> rules = editor.document->level().rules;
    const std::string step_name = "Change rule " + rules[rule].pattern;
    rules[rule] = std::move(changed);
    set_rules(editor, std::move(rules), step_name);
}

void remove_rule(Editor& editor, std::size_t rule) {
    if (!editor.document || rule >= editor.document->level().rules.size()) return;
    std::vector<MaterialRule> rules = editor.document->level().rules;
    const std::string step_name = "Remove rule " + rules[rule].pattern;
    rules.erase(rules.begin() + static_cast<std::ptrdiff_t>(rule));
    editor.rule.reset();
    set_rules(editor, std::move(rules), step_name);
}

void move_rule(Editor& editor, std::size_t rule, std::size_t to) {
    if (!editor.document) return;
    std::vector<MaterialRule> rules = editor.document->level().rules;
    if (rule >= rules.size() || to >= rules.size() || rule == to) return;
    MaterialRule moved = rules[rule];
    const std::string step_name = "Move rule " + moved.pattern;
    rules.erase(rules.begin() + static_cast<std::ptrdiff_t>(rule));
    rules.insert(rules.begin() + static_cast<std::ptrdiff_t>(to), std::move(moved));
    editor.rule = to;
    set_rules(editor, std::move(rules), step_name);
}

void add_rules_for_faces(Editor& editor) {
    if (!editor.document || !editor.brush) return;
    const Mesh& mesh = editor.document->mesh();
    const std::string type = editor.document->level().surfaces[*editor.brush].name;
    std::vector<std::uint32_t> materials;
    for (const FaceId face : seed_faces(editor))
        materials.push_back(mesh.face_material[face]);
    std::sort(materials.begin(), materials.end());
    materials.erase(std::unique(materials.begin(), materials.end()), materials.end());
    if (materials.empty()) return;
    editor.document->begin(materials.size() == 1 ? "Add rule" : "Add rules");
    std::size_t suffixed = 0;
    for (const std::uint32_t material : materials) {
        const std::string& name = mesh.materials[material].name;
        suffixed += suffix_surface(name, editor.document->level().surfaces) ? 1 : 0;
        add_rule(editor, {name, type});
    }
    editor.document->commit();
    editor.status = counted(materials.size(), "rule") + " added: " + type;
    if (suffixed > 0) editor.status += "; a suffix of the material's name comes first";
}

std::vector<FaceId> faces_of_rule(const Document& document, const MaterialRule& rule) {
    const Mesh& mesh = document.mesh();
    const std::string pattern = normal_pattern(rule.pattern);
    std::vector<bool> matches;
    for (const Material& material : mesh.materials)
        matches.push_back(glob_match(pattern, normal_name(material.name)));
    std::vector<FaceId> faces;
    for (FaceId face = 0; face < mesh.face_count(); ++face)
        if (matches[mesh.face_material[face]]) faces.push_back(face);
    return faces;
}

}  // namespace slipface

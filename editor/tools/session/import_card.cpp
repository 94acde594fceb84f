#include "tools/session/import_card.h"

#include <fmt/format.h>

#include "document/faces.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"
#include "slipface/mesh/open_edges.h"
#include "tools/editor.h"

namespace slipface {
namespace {

std::string preference_of(const Editor& editor) {
    const std::string path = editor.document->level().mesh_path.string();
    return "import_card.closed." + fmt::format("{:016x}", hash_blocks(path.data(), path.size()));
}

}  // namespace

void offer_import_card(Editor& editor) {
    editor.import_card = {};
    if (!editor.document) return;
    std::error_code error;
    const bool has_level_file = std::filesystem::exists(editor.document->level().file_path, error);
    editor.import_card.shown =
        !has_level_file && !editor.session.preferences.flag(preference_of(editor), false);
}

void toggle_import_card(Editor& editor) {
    if (!editor.document) return;
    if (editor.import_card.shown) return close_import_card(editor);
    editor.import_card = {};
    editor.import_card.shown = true;
}

void close_import_card(Editor& editor) {
    editor.import_card = {};
    if (editor.document) editor.session.preferences.set(preference_of(editor), true);
}

void refresh_import_card(Editor& editor) {
    ImportCard& card = editor.import_card;
    const Level& level = editor.document->level();
    if (card.mesh == level.mesh) return;
    card.mesh = level.mesh;
    card.open_edges = open_edge_count(*level.mesh);
    card.size_doubt = size_doubt(*level.mesh, level.import_summary);
    card.up_doubt = up_doubt(*level.mesh, level.import_summary);
    card.facing_doubt = facing_doubt(*level.mesh);
    card.scale_text = fmt::format("{:.9g}", level.import_summary.scale);
    card.problem.clear();
}

void change_import(Editor& editor, const ImportTransform& transform) {
    ImportCard& card = editor.import_card;
    card.problem.clear();
    if (editor.document->level().import_transform == transform) return;
    if (const Status status = editor.document->set_import_transform(transform); !status) {
        card.problem = status.error().message;
        return;
    }
    geometry_changed(editor);
    editor.view.frame(shown_bounds(*editor.document), editor.view_aspect);
    const ImportSummary& summary = editor.document->level().import_summary;
    editor.status = fmt::format("Level is now {:.4g} x {:.4g} x {:.4g} m", summary.size.x(), summary.size.y(),
                                summary.size.z());
}

void change_import_scale(Editor& editor, std::string_view text) {
    const std::optional<double> scale = parse_double(trim(text));
    if (!scale || !(*scale >= smallest_import_scale && *scale <= largest_import_scale)) {
        editor.import_card.problem = fmt::format("found \"{:.20}\", expected a scale of {:g} to {:g}", text,
                                                 smallest_import_scale, largest_import_scale);
        return;
    }
    ImportTransform transform = editor.document->level().import_transform;
    transform.scale = *scale;
    change_import(editor, transform);
}

}  // namespace slipface

#include "show_level.h"

#include "slipface/level/shown_mesh.h"

namespace slipface {

Warnings show_level(LevelRenderer& renderer, const Level& level) {
    Warnings warnings = renderer.set_mesh(shown_mesh(level), level.mesh_path.parent_path());
    for (Diagnostic& warning : renderer.set_light(level.light, level.mesh, level.file_path.parent_path()))
        warnings.push_back(std::move(warning));
    show_surfaces(renderer, level);
    if (has_animated_props(level))
        for (Diagnostic& warning : renderer.set_animated_props(level, resolve_parts(level).props))
            warnings.push_back(std::move(warning));
    return warnings;
}

void show_surfaces(LevelRenderer& renderer, const Level& level) {
    renderer.set_surface_types(level.surfaces);
    if (level.mesh) renderer.set_face_surfaces(resolve_surfaces(level).surface);
}

}  // namespace slipface

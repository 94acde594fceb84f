// How much memory the steps of a history hold.
#include <algorithm>

#include "document/document.h"

namespace slipface {
namespace {

template <class T>
std::size_t bytes_in(const std::vector<T>& list) {
    return list.size() * sizeof(T);
}

std::size_t bytes_of(const Mesh& mesh) {
    return bytes_in(mesh.positions) + bytes_in(mesh.corner_vertex) + bytes_in(mesh.corner_uv) +
           bytes_in(mesh.face_first_corner) + bytes_in(mesh.face_material) + bytes_in(mesh.face_group) +
           bytes_in(mesh.face_first_triangle) + bytes_in(mesh.triangles) + bytes_in(mesh.triangle_face) +
           bytes_in(mesh.vertex_number);
}

// What is only there for undo: the state before. That after is the next step's, or the document's own.
std::size_t bytes_of(const Edit& edit) {
    if (const auto* faces = std::get_if<FaceEdit>(&edit)) return bytes_in(faces->faces);
    if (const auto* selected = std::get_if<SelectionEdit>(&edit))
        return bytes_in(selected->before) + bytes_in(selected->after);
    if (const auto* hidden = std::get_if<HiddenEdit>(&edit))
        return bytes_in(hidden->before) + bytes_in(hidden->after);
    if (const auto* geometry = std::get_if<GeometryEdit>(&edit)) {
        const Geometry& before = geometry->before;
        std::size_t bytes = bytes_in(before.overrides) + bytes_in(before.selection) +
                            bytes_in(before.hidden) + bytes_in(before.orphans);
        if (before.mesh.own()) bytes += bytes_of(*before.mesh.own());
        for (const PropMesh& prop : before.placed.meshes)
            if (prop.mesh) bytes += bytes_of(*prop.mesh);
        return bytes;
    }
    if (const auto* props = std::get_if<PropsEdit>(&edit)) {
        std::size_t bytes = 0;
        for (const PropsState* state : {&props->before, &props->after})
            bytes += bytes_in(state->props) + bytes_in(state->platforms) + bytes_in(state->paint) +
                     bytes_in(state->selection) + bytes_in(state->hidden);
        return bytes;
    }
    if (const auto* level = std::get_if<LevelEdit>(&edit))
        return level->before ? bytes_in(level->before->overrides) + bytes_in(level->before->orphans) : 0;
    return sizeof(Edit);
}

}  // namespace

std::size_t HistoryStep::bytes() const {
    std::size_t sum = sizeof(HistoryStep);
    for (const Edit& edit : edits)
        sum += bytes_of(edit);
    return sum;
}

void Document::forget_oldest() {
    std::size_t first = history_.size(), bytes = 0;
    while (first > 0) {
        bytes += history_[first - 1].bytes();
        if (bytes > max_history_bytes && first < history_.size()) break;
        --first;
    }
    if (first == 0) return;
    const auto begin = history_.begin(), end = begin + static_cast<std::ptrdiff_t>(first);
    if (saved_cursor_ && *saved_cursor_ >= first)
        *saved_cursor_ -= first;
    else if (saved_cursor_ && std::any_of(begin + static_cast<std::ptrdiff_t>(*saved_cursor_), end,
                                          [](const HistoryStep& step) { return step.changes_file(); }))
        saved_cursor_.reset();
    else if (saved_cursor_)
        saved_cursor_ = 0;
    history_.erase(begin, end);
    cursor_ -= first;
    forgotten_ += first;
}

}  // namespace slipface

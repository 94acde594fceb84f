#include "tools/selection/selecting.h"

#include <algorithm>
#include <cmath>

#include "document/faces.h"
#include "slipface/base/counted.h"
#include "slipface/base/parallel.h"
#include "tools/target.h"

namespace slipface {
namespace {

std::vector<FaceId> combined(std::span<const FaceId> old, std::vector<FaceId> chosen, SelectBy by) {
    switch (by) {
        case SelectBy::replace: return chosen;
        case SelectBy::add: return united(old, chosen);
        case SelectBy::remove: return without(old, chosen);
        case SelectBy::toggle: {
            const std::vector<FaceId> both = united(old, chosen);
            return without(both, without(chosen, without(chosen, old)));
        }
    }
    return chosen;
}

bool on_face(const Editor& editor) {
    return editor.document && editor.hovered < editor.document->face_count();
}

std::string free_selection_name(const Document& document) {
    for (std::size_t number = document.saved_selections().size() + 1;; ++number) {
        std::string name = "Selection " + std::to_string(number);
        if (!find_selection(document, name)) return name;
    }
}

}  // namespace

void apply_selection(Editor& editor, std::vector<FaceId> faces, SelectBy by, const std::string& step_name) {
    if (!editor.document) return;
    Document& document = *editor.document;
    document.select(combined(document.selection(), std::move(faces), by), step_name);
    editor.status = step_name + ": " + counted(document.selection().size(), "face") + " selected";
}

std::vector<FaceId> seed_faces(const Editor& editor) {
    if (!editor.document) return {};
    const auto selected = editor.document->selection();
    if (!selected.empty()) return {selected.begin(), selected.end()};
    const std::optional<FacePoint> target = target_of(editor);
    return target ? std::vector<FaceId>{target->face} : std::vector<FaceId>{};
}

void click_select(Editor& editor, SelectBy by) {
    if (!editor.document) return;
    if (!on_face(editor)) {
        if (by == SelectBy::replace) editor.document->select({});
        return;
    }
    const auto old = editor.document->selection();
    editor.document->select(combined(old, {editor.hovered}, by));
}

void select_flat_hovered(Editor& editor, SelectBy by) {
    if (!on_face(editor)) return;
    apply_selection(editor, connected_flat(*editor.document, std::span(&editor.hovered, 1)), by,
                    "Select flat");
}

void brush_select(Editor& editor, SelectBy by) {
    if (!on_face(editor)) return;
    Document& document = *editor.document;
    document.select(
        combined(document.selection(),
                 brush_faces(document, editor.hovered, editor.hovered_point, editor.select_radius), by));
}

void drill_select(Editor& editor, const Ray& ray, int step) {
    if (!editor.document) return;
    Document& document = *editor.document;
    const std::vector<FaceId> along =
        document.pick_through(ray.origin, ray.direction, !sees_back_faces(editor));
    if (along.empty()) return;
    std::size_t chosen = 0;
    if (document.selection().size() == 1) {
        const auto found = std::find(along.begin(), along.end(), document.selection()[0]);
        if (found != along.end()) {
            const auto count = static_cast<std::ptrdiff_t>(along.size());
            chosen = static_cast<std::size_t>(((found - along.begin() + step) % count + count) % count);
        }
    }
    document.select({along[chosen]}, "Select face behind");
    editor.status = "Face " + std::to_string(along[chosen]) + ", " + std::to_string(chosen + 1) + " of " +
                    std::to_string(along.size()) + " under the mouse";
}

bool inside_outline(std::span<const Vec2> outline, const Vec2& pixel) {
    bool inside = false;
    for (std::size_t i = 0, before = outline.size() - 1; i < outline.size(); before = i++) {
        const Vec2 &a = outline[i], &b = outline[before];
        if ((a.y() > pixel.y()) != (b.y() > pixel.y()) &&
            pixel.x() < (b.x() - a.x()) * (pixel.y() - a.y()) / (b.y() - a.y()) + a.x())
            inside = !inside;
    }
    return inside;
}

namespace {

// Projects faces' centres with one matrix for all.
class Projector {
  public:
    Projector(const Camera& camera, const Vec2& size)
        : clip_from_world_(clip_from_view(camera, size.x() / size.y()) * view_from_world(camera)),
          size_(size) {}

    // Nothing behind the camera.
    std::optional<Vec2> operator()(const Vec3& point) const {
        const Eigen::Vector4d clip = clip_from_world_ * point.homogeneous();
        if (!(clip.w() > 0.0)) return std::nullopt;
        return Vec2(0.5 * (clip.x() / clip.w() + 1.0) * size_.x(),
                    0.5 * (1.0 - clip.y() / clip.w()) * size_.y());
    }

  private:
    Mat4 clip_from_world_;
    Vec2 size_;
};

struct PixelBox {
    Vec2 min, max;
    bool contains(const Vec2& p) const {
        return p.x() >= min.x() && p.x() <= max.x() && p.y() >= min.y() && p.y() <= max.y();
    }
};

PixelBox box_of(std::span<const Vec2> outline, const Vec2& size) {
    PixelBox box{size, Vec2::Zero()};
    for (const Vec2& point : outline) {
        box.min = box.min.cwiseMin(point);
        box.max = box.max.cwiseMax(point);
    }
    box.min = box.min.cwiseMax(0.0);
    box.max = box.max.cwiseMin(size);
    return box;
}

std::vector<FaceId> faces_with_centre_inside(const Document& document, const Projector& project,
                                             std::span<const Vec2> outline, const PixelBox& box) {
    const Mesh& mesh = document.mesh();
    std::vector<std::uint8_t> inside(mesh.face_count(), 0);
    constexpr std::size_t grain = 8192;
    parallel_for(mesh.face_count(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto face = static_cast<FaceId>(i);
            if (document.is_hidden(face)) continue;
            const std::optional<Vec2> at = project(face_centroid(mesh, face));
            inside[i] = at && box.contains(*at) && inside_outline(outline, *at) ? 1 : 0;
        }
    });
    std::vector<FaceId> faces;
    for (FaceId face = 0; face < mesh.face_count(); ++face)
        if (inside[face] != 0) faces.push_back(face);
    return faces;
}

bool crosses(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) {
        return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
    };
    return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

// True if no corner lies outside and no edge leaves the outline between two corners.
bool lies_inside(const Mesh& mesh, FaceId face, const Projector& project, std::span<const Vec2> outline) {
    std::vector<Vec2> corners;
    for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t)
        for (const std::uint32_t corner : mesh.triangles[t]) {
            const std::optional<Vec2> at = project(mesh.corner_position(corner).cast<double>());
            if (!at || !inside_outline(outline, *at)) return false;
            corners.push_back(*at);
        }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2& next = corners[i % 3 == 2 ? i - 2 : i + 1];
        for (std::size_t k = 0, before = outline.size() - 1; k < outline.size(); before = k++)
            if (crosses(corners[i], next, outline[before], outline[k])) return false;
    }
    return !corners.empty();
}

constexpr double finest_grid = 2.0;  // pixels between rays
constexpr double max_grid_rays = 60000.0;

}  // namespace

std::vector<FaceId> faces_in_outline(Editor& editor, const Camera& camera, const Vec2& size,
                                     std::span<const Vec2> outline) {
    if (!editor.document || outline.size() < 3 || !(size.minCoeff() > 0.0)) return {};
    Document& document = *editor.document;
    const PixelBox box = box_of(outline, size);
    const Projector project(camera, size);
    std::vector<FaceId> centred = faces_with_centre_inside(document, project, outline, box);
    const Mesh& mesh = document.mesh();
    const auto wanted = [&](std::vector<FaceId> faces) {
        if (editor.select_whole)
            std::erase_if(faces, [&](FaceId face) { return !lies_inside(mesh, face, project, outline); });
        return faces;
    };
    if (editor.select_through) return wanted(std::move(centred));

    // Visible faces: rays on a grid find those larger than its cells, one ray to the centre of each other
    // face finds the smaller ones.
    std::vector<PickRay> rays;
    const Vec2 extent = (box.max - box.min).cwiseMax(0.0);
    const double spacing = std::max(finest_grid, std::sqrt(extent.prod() / max_grid_rays));
    const auto add = [&](const Vec2& pixel) {
        const Ray ray = pixel_ray(camera, pixel, size);
        rays.push_back({ray.origin, ray.direction});
    };
    for (double y = box.min.y() + 0.5 * spacing; y < box.max.y(); y += spacing)
        for (double x = box.min.x() + 0.5 * spacing; x < box.max.x(); x += spacing)
            if (inside_outline(outline, {x, y})) add({x, y});
    const bool front_only = !draws_back_faces(editor, camera);
    std::vector<FaceId> seen = document.pick_faces(rays, front_only);
    rays.clear();
    for (const FaceId face : without(centred, seen))
        if (const std::optional<Vec2> at = project(face_centroid(mesh, face))) add(*at);
    return wanted(united(seen, document.pick_faces(rays, front_only)));
}

std::optional<std::size_t> find_selection(const Document& document, std::string_view name) {
    const auto saved = document.saved_selections();
    const auto found =
        std::find_if(saved.begin(), saved.end(), [&](const SavedSelection& one) { return one.name == name; });
    if (found == saved.end()) return std::nullopt;
    return static_cast<std::size_t>(found - saved.begin());
}

namespace {

std::vector<SavedSelection> saved_list(const Document& document) {
    return {document.saved_selections().begin(), document.saved_selections().end()};
}

}  // namespace

void save_selection(Editor& editor, std::string name) {
    if (!editor.document || editor.document->selection().empty()) return;
    Document& document = *editor.document;
    if (name.empty()) name = free_selection_name(document);
    if (const auto found = find_selection(document, name)) return replace_selection(editor, *found);
    std::vector<SavedSelection> saved = saved_list(document);
    if (saved.size() == max_saved_selections) {
        editor.status =
            "Not saved: a level can have at most " + std::to_string(max_saved_selections) + " selections";
        return;
    }
    saved.push_back({name, {document.selection().begin(), document.selection().end()}});
    document.set_saved_selections(std::move(saved), "Save selection " + name);
    editor.status = "Saved " + name + ", " + counted(document.selection().size(), "face");
}

void recall_selection(Editor& editor, std::size_t index, SelectBy by) {
    if (!editor.document || index >= editor.document->saved_selections().size()) return;
    const SavedSelection saved = editor.document->saved_selections()[index];
    apply_selection(editor, saved.faces, by, "Recall " + saved.name);
}

void rename_selection(Editor& editor, std::size_t index, const std::string& name) {
    if (!editor.document || index >= editor.document->saved_selections().size() || name.empty()) return;
    if (find_selection(*editor.document, name)) return;
    std::vector<SavedSelection> saved = saved_list(*editor.document);
    saved[index].name = name;
    editor.document->set_saved_selections(std::move(saved), "Rename selection");
}

void replace_selection(Editor& editor, std::size_t index) {
    if (!editor.document || index >= editor.document->saved_selections().size()) return;
    std::vector<SavedSelection> saved = saved_list(*editor.document);
    saved[index].faces.assign(editor.document->selection().begin(), editor.document->selection().end());
    editor.status = "Saved " + saved[index].name + " anew";
    editor.document->set_saved_selections(std::move(saved), "Replace selection");
}

void remove_selection(Editor& editor, std::size_t index) {
    if (!editor.document || index >= editor.document->saved_selections().size()) return;
    std::vector<SavedSelection> saved = saved_list(*editor.document);
    const std::string name = saved[index].name;
    saved.erase(saved.begin() + static_cast<std::ptrdiff_t>(index));
    editor.document->set_saved_selections(std::move(saved), "Delete selection " + name);
}

void replace_type(Editor& editor, SurfaceId from, std::optional<SurfaceId> to) {
    if (!editor.document || to == from) return;
    Document& document = *editor.document;
    const std::vector<SurfaceType>& surfaces = document.level().surfaces;
    if (from >= surfaces.size() || (to && *to >= surfaces.size())) return;
    std::vector<FaceId> faces = faces_of_type(document, from);
    if (!document.selection().empty()) {
        const auto selected = document.selection();
        std::erase_if(
            faces, [&](FaceId face) { return !std::binary_search(selected.begin(), selected.end(), face); });
    }
    Transaction transaction(document, "Replace " + surfaces[from].name + " by " +
                                          (to ? surfaces[*to].name : std::string("unset")));
    document.paint(faces, to);
    transaction.commit();
    editor.status = "Replaced " + surfaces[from].name + " on " + counted(faces.size(), "face");
}

}  // namespace slipface

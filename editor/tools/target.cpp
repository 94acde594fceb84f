#include "tools/target.h"

namespace slipface {
namespace {

// In the middle of the face's largest triangle, which lies on it whatever the face's shape.
FacePoint middle_of_face(const Document& document, FaceId face) {
    const FacePart& part = document.part_with(face);
    const Mesh& mesh = *part.mesh;
    FacePoint target{face, Vec3::Zero(), Vec3::UnitY(), "on the selected face"};
    double largest = -1.0;
    const FaceId own = face - part.first;
    for (std::uint32_t t = mesh.face_first_triangle[own]; t < mesh.face_first_triangle[own + 1]; ++t) {
        Vec3 corners[3];
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = mesh.corner_position(mesh.triangles[t][i]).cast<double>();
        const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        if (normal.norm() <= largest) continue;
        largest = normal.norm();
        target.point = (corners[0] + corners[1] + corners[2]) / 3.0;
        if (largest > 0.0) target.normal = normal / largest;
    }
    return target;
}

}  // namespace

std::optional<FacePoint> middle_of_view(const Editor& editor) {
    if (!editor.document) return std::nullopt;
    const Ray ray = pixel_ray(editor.view.camera(), {0.5, 0.5}, {1.0, 1.0});
    const auto hit = editor.document->pick(ray.origin, ray.direction, !sees_back_faces(editor));
    if (!hit) return std::nullopt;
    return FacePoint{hit->face, hit->point, hit->normal, "in the middle of the view"};
}

bool is_in_view(const Editor& editor, const Vec3& position) {
    const Camera camera = editor.view.camera();
    const Vec2 size{editor.view_aspect, 1.0};
    const Vec3 at = project(camera, position, size);
    if ((at.z() <= 0.0 && !camera.orthographic) || at.x() < 0.0 || at.x() > size.x() || at.y() < 0.0 ||
        at.y() > size.y())
        return false;
    const Ray ray = pixel_ray(camera, at.head<2>(), size);
    const auto hit = editor.document->pick(ray.origin, ray.direction, !sees_back_faces(editor));
    return !hit || (hit->point - ray.origin).norm() >= (position - ray.origin).norm();
}

std::optional<FacePoint> pointed_target(const Editor& editor) {
    if (!editor.document) return std::nullopt;
    const std::size_t faces = editor.document->face_count();
    if (editor.pointed && editor.pointed->face < faces) return editor.pointed;
    if (editor.hovered >= faces) return std::nullopt;
    return FacePoint{editor.hovered, editor.hovered_point, editor.hovered_normal, "under the mouse"};
}

std::optional<FacePoint> target_of(const Editor& editor) {
    if (const auto pointed = pointed_target(editor)) return pointed;
    if (editor.document && !editor.document->selection().empty())
        return middle_of_face(*editor.document, editor.document->selection().front());
    return middle_of_view(editor);
}

std::optional<FacePoint> target_or_say(Editor& editor) {
    const std::optional<FacePoint> target = target_of(editor);
    if (!target) editor.status = "No face is under the mouse, selected, or in the middle of the view";
    return target;
}

void zoom_to(Editor& editor, double wheel, const std::optional<FacePoint>& target) {
    const std::optional<FacePoint> towards = target ? target : middle_of_view(editor);
    if (towards)
        editor.view.zoom_towards(wheel, towards->point);
    else
        editor.view.zoom(wheel);
}

void remember_pointed(Editor& editor) {
    editor.pointed.reset();
    editor.pointed = pointed_target(editor);
}

}  // namespace slipface

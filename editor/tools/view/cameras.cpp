#include "tools/view/cameras.h"

#include <algorithm>

namespace slipface {
namespace {

std::string free_camera_name(const Document& document) {
    for (std::size_t number = document.level().cameras.size() + 1;; ++number) {
        std::string name = "Camera " + std::to_string(number);
        if (!find_camera(document, name)) return name;
    }
}

CameraBookmark bookmark(const Editor& editor, std::string name) {
    const Camera camera = editor.view.camera();
    return {std::move(name), camera.eye, camera.target, camera.fov_y};
}

bool exists(const Editor& editor, std::size_t index) {
    return editor.document && index < editor.document->level().cameras.size();
}

}  // namespace

std::optional<std::size_t> find_camera(const Document& document, std::string_view name) {
    const std::vector<CameraBookmark>& cameras = document.level().cameras;
    const auto found = std::find_if(cameras.begin(), cameras.end(),
                                    [&](const CameraBookmark& camera) { return camera.name == name; });
    if (found == cameras.end()) return std::nullopt;
    return static_cast<std::size_t>(found - cameras.begin());
}

void save_camera(Editor& editor, std::string name) {
    if (!editor.document) return;
    if (name.empty()) name = free_camera_name(*editor.document);
    if (const auto found = find_camera(*editor.document, name)) return replace_camera(editor, *found);
    std::vector<CameraBookmark> cameras = editor.document->level().cameras;
    cameras.push_back(bookmark(editor, name));
    editor.camera_shown = cameras.size() - 1;
    editor.document->set_cameras(std::move(cameras), "Add camera " + name);
    editor.status = "Added " + name;
}

void go_to_camera(Editor& editor, std::size_t index) {
    if (!exists(editor, index)) return;
    const CameraBookmark& camera = editor.document->level().cameras[index];
    editor.view.orthographic = false;
    editor.view.fov_y = camera.fov_y;
    editor.view.look_at(camera.eye, camera.target);
    editor.camera_shown = index;
    editor.status = "Camera: " + camera.name;
}

void go_to_next_camera(Editor& editor, int step) {
    if (!exists(editor, 0)) return;
    const auto count = static_cast<std::ptrdiff_t>(editor.document->level().cameras.size());
    std::ptrdiff_t next = step > 0 ? 0 : count - 1;
    if (editor.camera_shown)
        next = (static_cast<std::ptrdiff_t>(*editor.camera_shown) + step + count) % count;
    go_to_camera(editor, static_cast<std::size_t>(next));
}

void replace_camera(Editor& editor, std::size_t index) {
    if (!exists(editor, index)) return;
    std::vector<CameraBookmark> cameras = editor.document->level().cameras;
    const std::string name = cameras[index].name;
    cameras[index] = bookmark(editor, name);
    editor.camera_shown = index;
    editor.document->set_cameras(std::move(cameras), "Move camera " + name);
    editor.status = "Moved " + name + " here";
}

void remove_camera(Editor& editor, std::size_t index) {
    if (!exists(editor, index)) return;
    std::vector<CameraBookmark> cameras = editor.document->level().cameras;
    const std::string name = cameras[index].name;
    cameras.erase(cameras.begin() + static_cast<std::ptrdiff_t>(index));
    editor.camera_shown.reset();
    editor.document->set_cameras(std::move(cameras), "Delete camera " + name);
    editor.status = "Deleted " + name;
}

std::string camera_name_problem(const Document& document, std::size_t index, std::string_view name) {
    if (name.empty()) return "A camera needs a name";
    const auto found = find_camera(document, name);
    return found && *found != index ? "Another camera has this name" : "";
}

void rename_camera(Editor& editor, std::size_t index, const std::string& name) {
    if (!exists(editor, index) || !camera_name_problem(*editor.document, index, name).empty()) return;
    std::vector<CameraBookmark> cameras = editor.document->level().cameras;
    const std::string old = std::exchange(cameras[index].name, name);
    editor.document->set_cameras(std::move(cameras), "Rename camera " + old);
}

}  // namespace slipface

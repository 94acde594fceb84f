// Parses the names of cameras in suites.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slipface {

enum class CameraKind { named_view, map, iso_corner, turntable, tape, contact, bookmark };

struct CameraName {
    CameraKind kind = CameraKind::bookmark;
    std::string view;          // of named_view; the bookmark's name
    int index = 1, count = 1;  // 1-based: corner, direction, moment, contact
};

// The camera that `name` means; nothing for an "auto:", "tape:" or "contact:" that is no camera. Every other
// word is a bookmark.
std::optional<CameraName> read_camera_name(std::string_view name);

// Why `name` is no camera, or nothing.
std::optional<std::string> wrong_camera_name(std::string_view name);

// Whether `name` stands for several cameras, and the names of these, if known without the level.
bool several_cameras(std::string_view name);
std::vector<std::string> cameras_of(
    std::string_view name);  // {name} for one; none for "bookmarks", "contacts"

}  // namespace slipface

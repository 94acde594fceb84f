#include "goldens/camera_names.h"

#include <fmt/format.h>

#include "slipface/base/text.h"
#include "slipface/view/camera.h"

namespace slipface {

namespace {

constexpr int max_directions = 360;

std::optional<int> count_in(std::string_view text, int maximum) {
    const std::optional<std::int64_t> value = parse_int(text);
    if (!value || *value < 1 || *value > maximum) return std::nullopt;
    return static_cast<int>(*value);
}

// "3/8": the third of eight.
std::optional<CameraName> part_of(CameraKind kind, std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return std::nullopt;
    const auto index = count_in(text.substr(0, slash), max_directions),
               count = count_in(text.substr(slash + 1), max_directions);
    if (!index || !count || *index > *count) return std::nullopt;
    return CameraName{kind, "", *index, *count};
}

std::optional<CameraName> auto_camera(std::string_view name) {
    if (name == "map") return CameraName{CameraKind::map, "top"};
    if (name.starts_with("iso:")) {
        const auto corner = count_in(name.substr(4), 4);
        return corner ? std::optional(CameraName{CameraKind::iso_corner, "", *corner, 4}) : std::nullopt;
    }
    if (name.starts_with("turntable:")) return part_of(CameraKind::turntable, name.substr(10));
    if (!named_view(name, {}, 1.0)) return std::nullopt;
    return CameraName{CameraKind::named_view, std::string(name)};
}

// The number 8 of "auto:turntable:8", for prefixes that stand for several cameras.
std::optional<int> several_after(std::string_view name, std::string_view prefix) {
    if (!name.starts_with(prefix)) return std::nullopt;
    return count_in(name.substr(prefix.size()), max_directions);
}

}  // namespace

std::optional<CameraName> read_camera_name(std::string_view name) {
    if (name.starts_with("auto:")) return auto_camera(name.substr(5));
    if (name.starts_with("tape:")) return part_of(CameraKind::tape, name.substr(5));
    if (name.starts_with("contact:")) {
        const auto index = count_in(name.substr(8), max_directions);
        return index ? std::optional(CameraName{CameraKind::contact, "", *index}) : std::nullopt;
    }
    if (name.empty()) return std::nullopt;
    return CameraName{CameraKind::bookmark, std::string(name)};
}

std::optional<std::string> wrong_camera_name(std::string_view name) {
    if (read_camera_name(name)) return std::nullopt;
    return fmt::format(
        "found \"{}\", expected a bookmark's name, contact:K, tape:K/N or auto: and iso, iso-back, top, "
        "bottom, front, "
        "back, left, right, map, iso:K or turntable:K/N",
        name);
}

bool several_cameras(std::string_view name) {
    return name == "bookmarks" || name == "contacts" || name == "auto:iso4" ||
           several_after(name, "auto:turntable:") || several_after(name, "tape:");
}

std::vector<std::string> cameras_of(std::string_view name) {
    std::vector<std::string> names;
    if (name == "bookmarks" || name == "contacts") return names;
    const auto parts = [&](const char* prefix, int count) {
        for (int i = 1; i <= count; ++i)
            names.push_back(fmt::format("{}{}/{}", prefix, i, count));
    };
    if (name == "auto:iso4") {
        for (int i = 1; i <= 4; ++i)
            names.push_back(fmt::format("auto:iso:{}", i));
    } else if (const auto directions = several_after(name, "auto:turntable:")) {
        parts("auto:turntable:", *directions);
    } else if (const auto moments = several_after(name, "tape:")) {
        parts("tape:", *moments);
    } else {
        names.emplace_back(name);
    }
    return names;
}

}  // namespace slipface

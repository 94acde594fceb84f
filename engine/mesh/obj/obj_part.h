// An OBJ file is read in parts: ranges of whole lines.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obj/obj_text.h"
#include "slipface/base/result.h"
#include "slipface/base/types.h"
#include "warning_list.h"

namespace slipface {

// In a text whose continued lines were joined: a blank that counts as a line.
inline constexpr char obj_joint = '\v';

// The statements with a number of their own: of a part of the text, or of all text before it.
enum Counted : std::uint8_t { of_v, of_vt, of_vn };
inline constexpr const char* counted_names[] = {"v", "vt", "vn"};
struct ObjCounts {
    std::int64_t line = 0;
    std::array<std::int64_t, 3> of{};
    ObjCounts& operator+=(const ObjCounts& other) {
        line += other.line;
        for (std::size_t i = 0; i < of.size(); ++i)
            of[i] += other.of[i];
        return *this;
    }
};

struct ObjName {
    enum class Kind : std::uint8_t { material, group, library };
    Kind kind;
    std::size_t face;  // index of the next face in the part
    std::size_t line;
    std::string name;
};

// A range of whole lines.
struct ObjPart {
    std::string_view text;
    ObjCounts before{};
    std::vector<std::uint32_t> corner_v{}, corner_vt{};  // from 0; no_id: no texture coordinate
    std::vector<std::uint32_t> face_corners{};
    std::vector<ObjName> events{};
    WarningList warnings;
    std::optional<Error> error{};
};

// What all parts share.
struct ObjReading {
    const std::string& location;
    ObjCounts total{};
    bool continued = false;  // see join_continued_lines()
    std::vector<Vec3f> positions{};
    std::vector<Vec2f> uvs{};
};

// The number of statements in the part.
ObjCounts count_statements(const ObjPart& part, const ObjReading& reading);

// Reads the part; false if it has an error, which is then stored in it.
bool read_part(ObjReading& reading, ObjPart& part);

}  // namespace slipface

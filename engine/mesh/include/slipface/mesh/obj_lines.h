// Where the statements of an OBJ file stand, for changing some of them and leaving every other byte alone.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace slipface {

struct ObjStatement {
    enum class Kind : std::uint8_t { face, material, object, library };
    Kind kind;
    std::size_t begin = 0;                     // of its line, in bytes
    std::size_t name_begin = 0, name_end = 0;  // what stands behind the keyword, without blanks at its ends
    std::uint32_t corners = 0;                 // of a face
};

// The faces that import_mesh() keeps (`f`), and every `usemtl`, `o` and `mtllib`, in the file's order. Lines
// that go on after a `\` are one statement. Judges nothing: the text is one that import_mesh() reads.
std::vector<ObjStatement> obj_statements(std::string_view text);

// How the lines of `text` end at `position`: "\r\n", "\n" or "\r".
std::string_view line_ending_near(std::string_view text, std::size_t position);

}  // namespace slipface

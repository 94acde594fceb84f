// Finds the statements of an OBJ file, for changing some of them without touching any other byte.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace slipface {

struct ObjStatement {
    enum class Kind : std::uint8_t { face, material, object, library };
    Kind kind;
    std::size_t begin = 0;                     // of its line, bytes from the start of the text
    std::size_t name_begin = 0, name_end = 0;  // text after the keyword, without surrounding blanks
    std::uint32_t corners = 0;                 // of a face
};

// The faces that import_mesh() does not drop (`f`), and every `usemtl`, `o` and `mtllib`, in the order of the
// file. Lines continued with `\` are one statement. Nothing is checked: `text` must be one that import_mesh()
// reads.
std::vector<ObjStatement> obj_statements(std::string_view text);

// The line ending at or after `position`, else the first of `text`: "\r\n", "\n" or "\r"; "\n" if there is
// none.
std::string_view line_ending_near(std::string_view text, std::size_t position);

}  // namespace slipface

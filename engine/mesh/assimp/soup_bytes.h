// An imported scene as bytes, from a child process to its parent on the same machine.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "assimp/imported_soup.h"
#include "slipface/mesh/import.h"

namespace slipface {

struct SceneAnswer {
    std::optional<Error> error;  // else `scene` is valid
    ImportedSoup scene;
    Warnings warnings;
    FileStamp stamp;  // of the file that the child read
};

std::string answer_to_bytes(const SceneAnswer& answer);
// Nothing if the bytes are no complete answer. build_mesh() checks how the arrays fit together.
std::optional<SceneAnswer> answer_from_bytes(std::string_view bytes);

}  // namespace slipface

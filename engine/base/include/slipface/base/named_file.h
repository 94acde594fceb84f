// The one rule for the files that a level names: geometry, props' meshes, pictures, heights.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

struct NamedFile {
    enum class State : std::uint8_t { there, missing, outside };
    std::filesystem::path path;
    State state = State::missing;

    explicit operator bool() const { return state == State::there; }
    Error error() const;  // of one that is not there; its location is the path
};

// Returns where the file `name` lies that something in `folder` names, relative to it, and whether it may be
// opened. A level from elsewhere must not make the program open any file: the file has to lie in `folder` or
// below, after symbolic links, too; else it is `outside`, there or not. `\` in a name counts as `/`.
//
//     const NamedFile file = named_file("parts/wedge.obj", level.mesh_path.parent_path());
//     if (!file) return file.error();
NamedFile named_file(std::string_view name, const std::filesystem::path& folder);

}  // namespace slipface

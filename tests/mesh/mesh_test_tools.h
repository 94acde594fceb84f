// Scratch folders and OBJ texts for the tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "scratch_folder.h"
#include "slipface/base/files.h"
#include "slipface/mesh/import.h"

namespace slipface {

class ScratchFolder : public test::InScratchFolder {
  protected:
    void write(const std::string& name, std::string_view text) const {
        std::filesystem::create_directories((folder / name).parent_path());
        ASSERT_TRUE(write_file_atomic(folder / name, text));
    }

    // The text as level.obj, imported.
    Result<ImportedMesh> import(std::string_view text, std::size_t max_warnings = 100) const {
        if (const auto status = write_file_atomic(folder / "level.obj", text); !status) return status.error();
        return import_mesh(folder / "level.obj", max_warnings);
    }

    // The name of level.obj as messages begin with it.
    std::string location() const { return (folder / "level.obj").string(); }
};

// The unit square in the x-z plane, seen from above: four vertices.
inline const std::string square_vertices = "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\n";

}  // namespace slipface

// What the file dialog is asked for, a row per kind.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/editor.h"

namespace slipface {

struct FileKind {
    FileDialogKind kind;
    const char* title;
    const char* suffix;  // of what is listed, and added to a name that is saved without it; "": levels
    const char* hint;
    bool saves;
    void (*chosen)(Editor& editor, const std::filesystem::path& path);
    const char* proposed = "";        // what follows the level's name in the name that is offered
    const char* other_suffix = "";    // is listed and kept, too
    const char* foreign_suffix = "";  // ends like `suffix` and is another kind of file
};
const FileKind& file_kind(FileDialogKind kind);

bool has_suffix(const FileKind& kind, const std::string& name);
bool is_listed(const FileKind& kind, const std::string& name);
// Of what saving `target` would write, what is there already.
std::vector<std::filesystem::path> replaced_files(const FileKind& kind, const std::filesystem::path& target);

// What the list of an open dialog can be narrowed to: "All levels" first, then each format that can be read,
// then level files.
const std::vector<std::string>& level_formats();
bool is_of_format(std::size_t format, const std::string& name);

}  // namespace slipface

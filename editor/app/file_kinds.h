// The kinds of files that the file dialog opens and saves, one row per kind.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/editor.h"

namespace slipface {

struct FileKind {
    FileDialogKind kind;
    const char* title;
    const char* suffix;  // of the listed files; added to a name saved without it; "": levels
    const char* hint;
    bool saves;
    void (*chosen)(Editor& editor, const std::filesystem::path& path);
    const char* proposed = "";        // what follows the level's name in the proposed name
    const char* other_suffix = "";    // also listed, and not replaced by `suffix`
    const char* foreign_suffix = "";  // ends like `suffix` but is another kind of file
};
const FileKind& file_kind(FileDialogKind kind);

bool has_suffix(const FileKind& kind, const std::string& name);
bool is_listed(const FileKind& kind, const std::string& name);
// The files that exist and that saving `target` would overwrite.
std::vector<std::filesystem::path> replaced_files(const FileKind& kind, const std::filesystem::path& target);

// The filters of an open dialog: "All levels" first, then each readable format, then level files.
const std::vector<std::string>& level_formats();
bool is_of_format(std::size_t format, const std::string& name);

}  // namespace slipface

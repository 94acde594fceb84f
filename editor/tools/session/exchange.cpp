#include "tools/session/exchange.h"

#include <algorithm>

#include "slipface/base/counted.h"
#include "slipface/base/text.h"
#include "slipface/exchange/export.h"
#include "slipface/level/preset.h"
#include "tools/lab/lab_actions.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

void report(Editor& editor, const char* what, const fs::path& path, const Error& error, bool written = true) {
    editor.message = MessageDialog{.title = std::string("Cannot ") + what + " " + path.filename().string(),
                                   .text = error.text(),
                                   .details = {},
                                   .of_refused_write = written};
}

// "precise-platformer.json" is the preset "Precise platformer".
std::string name_of_file(const fs::path& path) {
    std::string name = path.stem().string();
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '-' || c == '_'; }, ' ');
    if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 'a' + 'A');
    return name;
}

bool is_level_of(const Editor& editor, const fs::path& path) {
    std::error_code error;
    const Level& level = editor.document->level();
    return to_lower(path.filename().string()).ends_with(".slipface.json") || path == level.mesh_path ||
           fs::equivalent(path, level.mesh_path, error) || path == level.file_path ||
           fs::equivalent(path, level.file_path, error);
}

// "72 faces, 2 types, 14 KB"
std::string export_summary(const Document& document, const std::vector<fs::path>& files) {
    std::size_t types = 0;
    for (SurfaceId type = 0; type < document.level().surfaces.size(); ++type)
        if (document.face_count_of(type) > 0) ++types;
    std::uintmax_t bytes = 0;
    for (const fs::path& file : files) {
        std::error_code error;
        if (const std::uintmax_t size = fs::file_size(file, error); !error) bytes += size;
    }
    return counted(document.face_count(), "face") + ", " + counted(types, "type") + ", " +
           std::to_string((bytes + 1023) / 1024) + " KB";
}

void export_as(Editor& editor, FileDialogKind kind, const fs::path& path, const ExportTargets& targets) {
    if (!editor.document) return;
    if (const Status status = export_level(editor.document->level(), targets); !status)
        return report(editor, "export", path, status.error());
    const std::vector<fs::path> files = files_of_export(kind, path);
    std::string names;
    for (const fs::path& file : files)
        names += (names.empty() ? "" : " and ") + file.filename().string();
    editor.status = "Exported " + names + ": " + export_summary(*editor.document, files);
}

}  // namespace

void open_preset(Editor& editor, const fs::path& path) {
    if (!editor.document) return;
    Result<Preset> preset = load_preset(path);
    if (!preset) return report(editor, "open", path, preset.error(), false);
    if (preset->name.empty()) preset->name = name_of_file(path);
    use_preset(editor, *preset);
}

void save_preset(Editor& editor, const fs::path& path) {
    if (!editor.document) return;
    if (is_level_of(editor, path))
        return report(editor, "save", path,
                      {path.string(), "is a file of a level; expected another name, such as settings.json"});
    Preset preset{name_of_file(path), {}, {}};
    if (const Result<Preset> before = load_preset(path)) preset = *before;
    preset.settings = editor.document->level().movement;
    if (const Status status = save_preset(path, preset); !status)
        return report(editor, "save", path, status.error());
    editor.status = "Saved preset " + preset.name + " as " + path.filename().string();
}

void export_level_obj(Editor& editor, const fs::path& path) {
    export_as(editor, FileDialogKind::export_obj, path, {.obj = path});
}
void export_level_gltf(Editor& editor, const fs::path& path) {
    export_as(editor, FileDialogKind::export_gltf, path, {.gltf = path});
}
void export_level_game(Editor& editor, const fs::path& path) {
    export_as(editor, FileDialogKind::export_game, path, {.flat = path});
}

std::vector<fs::path> files_of_export(FileDialogKind kind, const fs::path& path) {
    std::vector<fs::path> files{path};
    const bool one_file = to_lower(path.extension().string()) == ".glb";
    if (kind == FileDialogKind::export_obj) files.push_back(fs::path(path).replace_extension(".mtl"));
    if (kind == FileDialogKind::export_gltf && !one_file)
        files.push_back(fs::path(path).replace_extension(".bin"));
    return files;
}

}  // namespace slipface

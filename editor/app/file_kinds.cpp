#include "app/file_kinds.h"

#include <algorithm>
#include <system_error>

#include "document/folder_listing.h"
#include "slipface/base/text.h"
#include "slipface/mesh/formats.h"
#include "tools/lab/imported_run.h"
#include "tools/lab/lab_actions.h"
#include "tools/lab/run_file.h"
#include "tools/session/exchange.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// A tape is opened in the level that is open, even if it was recorded in another.
void open_run(Editor& editor, const fs::path& path) {
    const bool tape = to_lower(path.extension().string()) == ".tape";
    tape&& editor.document ? open_tape(editor, path) : open_run_file(editor, path);
}

constexpr FileKind kinds[] = {
    {FileDialogKind::open, "Open a level", "", "Path of a level; Tab completes it, ~ is the home folder",
     false, request_open},
    {FileDialogKind::save_as, "Save the level file as", ".slipface.json", "Path of a .slipface.json file",
     true, save_level_as},
    {FileDialogKind::open_tape, "Open a tape or a capsule", ".tape", "Path of a .tape or a .capsule file",
     false, open_run, "", ".capsule"},
    {FileDialogKind::open_recording, "Open a recording", ".tape", "Path of a .tape file", false, open_tape},
    {FileDialogKind::add_tape, "Add a tape", ".tape", "Path of a .tape file", false, add_tape},
    {FileDialogKind::import_run, "Import a run of another controller", ".csv",
     "Path of a .csv or a .jsonl file", false, import_run, "", ".jsonl"},
    {FileDialogKind::save_tape, "Save the tape as", ".tape", "Path of a .tape file", true, save_tape},
    {FileDialogKind::save_capsule, "Save the run with its level as", ".capsule", "Path of a .capsule file",
     true, save_capsule},
    {FileDialogKind::save_csv, "Export the run as CSV", ".csv", "Path of a .csv file", true, save_run_csv},
    {FileDialogKind::open_preset, "Open a preset", ".json", "Path of a preset's .json file", false,
     open_preset, "", "", ".slipface.json"},
    {FileDialogKind::save_preset, "Save the movement settings as a preset", ".json", "Path of a .json file",
     true, save_preset, "-movement", "", ".slipface.json"},
    {FileDialogKind::export_obj, "Export OBJ and MTL", ".obj", "Path of an .obj file", true, export_level_obj,
     "-typed"},
    {FileDialogKind::export_gltf, "Export glTF", ".gltf", "Path of a .gltf or a .glb file", true,
     export_level_gltf, "-typed", ".glb"},
    {FileDialogKind::export_game, "Export for a game", ".flat", "Path of a .flat file", true,
     export_level_game},
};

}  // namespace

const FileKind& file_kind(FileDialogKind kind) {
    for (const FileKind& row : kinds)
        if (row.kind == kind) return row;
    return kinds[0];
}

bool has_suffix(const FileKind& kind, const std::string& name) {
    const std::string lower = to_lower(name);
    return lower.ends_with(kind.suffix) || (*kind.other_suffix && lower.ends_with(kind.other_suffix));
}

bool is_listed(const FileKind& kind, const std::string& name) {
    if (!*kind.suffix) return is_level_name(name);
    const bool foreign = *kind.foreign_suffix && to_lower(name).ends_with(kind.foreign_suffix);
    return has_suffix(kind, name) && !foreign;
}

std::vector<fs::path> replaced_files(const FileKind& kind, const fs::path& target) {
    std::vector<fs::path> files = files_of_export(kind.kind, target);
    std::erase_if(files, [](const fs::path& file) {
        std::error_code error;
        return !fs::exists(file, error);
    });
    return files;
}

const std::vector<std::string>& level_formats() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list{"All levels"};
        for (const MeshFormat& format : mesh_formats())
            if (list.back() != format.name) list.emplace_back(format.name);
        list.emplace_back("Level file");
        return list;
    }();
    return names;
}

bool is_of_format(std::size_t format, const std::string& name) {
    if (format == 0) return true;
    const MeshFormat* const found = mesh_format_of(name);
    return level_formats()[format] == (found ? found->name : "Level file");
}

}  // namespace slipface

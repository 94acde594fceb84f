#include "cli/tape_on_level.h"

#include <fmt/format.h>

#include "cli/format.h"
#include "slipface/base/temporary_folder.h"
#include "slipface/base/text.h"
#include "slipface/level/find_start.h"
#include "slipface/level/preset.h"
#include "slipface/sim/capsule_file.h"

namespace slipface::cli {
namespace {

// Of a capsule with its tape. It is unpacked for as long as its level is read.
Result<LoadedLevel> load_with_tape(const std::filesystem::path& path, std::optional<Tape>& tape) {
    if (!brings_tape(path)) return load_level(path);
    Result<CapsuleFile> capsule = read_capsule_file(path);
    if (!capsule) return capsule.error();
    const Result<TemporaryFolder> folder = TemporaryFolder::make();
    if (!folder) return folder.error();
    const Result<std::filesystem::path> level = unpack_level(*capsule, folder->path());
    if (!level) return level.error();
    tape = std::move(capsule->tape);
    return load_level(*level);
}

}  // namespace

bool brings_tape(const std::filesystem::path& level) {
    return to_lower(level.extension().string()) == ".capsule";
}

Result<TapeOnLevel> load_tape_on_level(const TapeOptions& options) {
    std::optional<Tape> inside;
    Result<LoadedLevel> loaded = load_with_tape(options.level, inside);
    if (!loaded) return loaded.error();
    const std::string source = (options.tape.empty() ? options.level : options.tape).string();
    Result<Tape> tape = options.tape.empty() ? Result<Tape>(std::move(*inside)) : load_tape(options.tape);
    if (!tape) return tape.error();
    MovementSettings settings = loaded->level.movement;
    if (Status status = apply_tape_settings(settings, *tape, source); !status.ok()) return status.error();
    if (options.preset) {
        const Result<Preset> preset = find_preset(*options.preset);
        if (!preset) return Error{"--preset", preset.error().text()};
        settings = preset->settings;
    }
    for (const std::string& assignment : options.settings) {
        if (Status status = set_setting(settings, assignment); !status.ok())
            return Error{"--set " + assignment, status.error().message};
    }
    // The scene refers to the level, so the level moves to its final address before the scene is built.
    auto owned = std::make_unique<LoadedLevel>(std::move(*loaded));
    Result<LevelScene> scene = LevelScene::build(owned->level, settings);
    if (!scene) return scene.error();
    Warnings warnings = owned->warnings;
    const auto& recorded = tape->level_fingerprint;
    if (recorded && *recorded != owned->level.mesh.fingerprint()) {
        warnings.push_back(
            {source, fmt::format("was recorded on geometry {}, found {}; the run may differ",
                                 hash_text(*recorded), hash_text(owned->level.mesh.fingerprint()))});
    }
    if (!tape->own_buttons.empty()) {
        std::string names;
        for (const std::string& name : tape->own_buttons)
            names += (names.empty() ? "" : ", ") + name;
        warnings.push_back({source, "holds buttons that no ability reads: " + names});
    }
    const auto& surfaces = tape->surfaces_fingerprint;
    if (surfaces && *surfaces != scene_fingerprint(scene->at(0.0))) {
        warnings.push_back(
            {source,
             "was recorded with other surface types, or with other faces painted; the run may differ"});
    }
    Vec3 start = tape->start.value_or(Vec3::Zero());
    if (!tape->start || !options.spawn.empty()) {
        const Result<Start> found = find_start(owned->level, *scene, settings, options.spawn);
        if (!found) return Error{"--spawn", found.error().message};
        start = found->position;
        if (!found->note.empty()) warnings.push_back({owned->level.mesh_path.string(), found->note});
    }
    return TapeOnLevel{.loaded = std::move(owned),
                       .tape = std::move(*tape),
                       .settings = settings,
                       .start = start,
                       .scene = std::move(*scene),
                       .warnings = std::move(warnings),
                       .source = source};
}

}  // namespace slipface::cli

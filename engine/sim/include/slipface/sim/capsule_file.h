// A capsule file: a run with everything that it needs, in one file that repeats it bit for bit elsewhere.
//
// NAME.capsule is an archive (archive.h): the level's geometry, level file, props, pictures and heights, as
// they lie in the geometry's folder; `run.tape`; and `capsule.json`:
//
//     {"slipface-capsule": 1, "level": "yard.obj", "tick": 214, "note": "Snags here"}
//
// A link (capsule.h) is shorter, but only for levels that both sides have.
#pragma once

#include <filesystem>

#include "slipface/image/archive.h"
#include "slipface/sim/tape.h"

namespace slipface {

struct Level;

struct CapsuleFile {
    std::string level;  // name of the geometry among `files`
    Tape tape;
    std::size_t tick = 0;  // to look at, from 0
    std::string note;
    std::vector<ArchiveEntry> files;  // of the level
};

// With the level as it is now, saved or not; the geometry and what it refers to are read from their files.
// Pictures come along as long as all of them have at most 64 MiB; `left_out` counts the others. Errors: a
// file of the level's cannot be read, or the geometry on disk is another than the level's.
Result<CapsuleFile> make_capsule_file(const Level& level, Tape tape, std::size_t tick, std::string note,
                                      std::size_t* left_out = nullptr);
Status write_capsule_file(const CapsuleFile& capsule, const std::filesystem::path& path);
Result<CapsuleFile> read_capsule_file(const std::filesystem::path& path);
// Writes the level's files into `folder`, which is made. Returns the geometry's path.
Result<std::filesystem::path> unpack_level(const CapsuleFile& capsule, const std::filesystem::path& folder);

}  // namespace slipface

// Whole-file reading and writing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

// Returns the bytes of `path`. Errors: no such file, a directory or another non-regular file, more than
// `max_bytes` bytes, a file that cannot be read, too little memory.
Result<std::string> read_file(const std::filesystem::path& path,
                              std::uint64_t max_bytes = std::uint64_t{4} << 30);

// Replaces `path` by `bytes`: writes a temporary file beside it, flushes it to disk and renames it. A reader,
// and a machine after a power failure, see the old or the new file and never a mixture. Symbolic links are
// followed and permissions are preserved. Errors: a write-protected or non-regular target, a failed write.
Status write_file_atomic(const std::filesystem::path& path, std::string_view bytes);

// A hash of the names and the bytes of files, in the given order. One that cannot be read counts as such. Not
// for security.
std::uint64_t fingerprint_of_files(std::span<const std::filesystem::path> files);

// Replaces several files that belong together, all or none: writes and flushes all temporary files and a list
// of the renames in the first file's folder, renames one directly after the other, and removes the list. A
// process killed before the list is there leaves the old files; one killed after it leaves the rest to the
// next finish_interrupted_writes(). The list holds files of the first file's folder and below; others are
// only renamed. Errors as above, before any file is replaced.
struct FileToWrite {
    std::filesystem::path path;
    std::string_view bytes;
};
Status write_files_atomic(std::span<const FileToWrite> files);

// Finishes what write_files_atomic() of a process that is gone had begun in `folder`, and removes temporary
// files of such processes there. Writing does so itself; reading a level does so in the level's folder.
void finish_interrupted_writes(const std::filesystem::path& folder);

// True if `file` is `folder` or lies below it. Symbolic links are followed as far as they exist.
bool lies_within(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace slipface

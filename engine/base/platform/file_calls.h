// What whole-file reading and writing asks of the operating system: one declaration, and a file of
// definitions for each system. Handles are those of open(), errors are numbers of <cerrno>, and 0 means
// success.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace slipface::platform {

// A handle, or -1: errno says why. Neither waits for the writer of a pipe, nor follows a link unless asked
// to.
enum class Links : std::uint8_t { follow, refuse };
int open_to_read(const std::filesystem::path& file, Links links);
// A new file for writing; EEXIST if there is one of this name.
int make_file(const std::filesystem::path& file);

struct FileStatus {
    const char* other_kind = nullptr;  // "a directory"; null: a regular file
    std::uint64_t bytes = 0;
    unsigned permissions = 0;  // for set_permissions()
};
int status_of(int handle, FileStatus& status);
int status_of(const std::filesystem::path& file, FileStatus& status);

// At most `size` bytes into `bytes`, whose number `read` becomes; 0 at the end of the file.
int read_some(int handle, char* bytes, std::size_t size, std::size_t& read);
int write_all(int handle, std::string_view bytes);
int set_permissions(int handle, unsigned permissions);
int flush(int handle);
int close(int handle);

// False if another handle has it. The system frees the lock however the process ends.
bool take_lock(int handle);

int may_write(const std::filesystem::path& file);
// Puts `from` into the place of `to`, whether or not a file is there.
int replace(const std::filesystem::path& from, const std::filesystem::path& to);
int remove(const std::filesystem::path& file);
// Until the folder's renames would survive a power failure.
int flush_folder(const std::filesystem::path& folder);

int process_number();
bool process_is_gone(int number);

}  // namespace slipface::platform

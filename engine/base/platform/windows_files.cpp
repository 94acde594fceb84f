#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <algorithm>
#include <array>

#include "platform/file_calls.h"

namespace slipface::platform {
namespace {

namespace fs = std::filesystem;

int errno_of(DWORD error) {
    struct Row {
        DWORD windows;
        int number;
    };
    constexpr std::array<Row, 19> rows{{
        {ERROR_FILE_NOT_FOUND, ENOENT},
        {ERROR_PATH_NOT_FOUND, ENOENT},
        {ERROR_INVALID_NAME, ENOENT},
        {ERROR_BAD_PATHNAME, ENOENT},
        {ERROR_INVALID_DRIVE, ENOENT},
        {ERROR_BAD_NETPATH, ENOENT},
        {ERROR_DIRECTORY, ENOTDIR},
        {ERROR_ACCESS_DENIED, EACCES},
        {ERROR_SHARING_VIOLATION, EACCES},
        {ERROR_LOCK_VIOLATION, EACCES},
        {ERROR_WRITE_PROTECT, EROFS},
        {ERROR_FILE_EXISTS, EEXIST},
        {ERROR_ALREADY_EXISTS, EEXIST},
        {ERROR_DISK_FULL, ENOSPC},
        {ERROR_HANDLE_DISK_FULL, ENOSPC},
        {ERROR_TOO_MANY_OPEN_FILES, EMFILE},
        {ERROR_FILENAME_EXCED_RANGE, ENAMETOOLONG},
        {ERROR_NOT_ENOUGH_MEMORY, ENOMEM},
        {ERROR_FILE_TOO_LARGE, EFBIG},
    }};
    for (const Row& row : rows)
        if (row.windows == error) return row.number;
    return EIO;
}

int last_error() {
    return errno_of(::GetLastError());
}

int result_of(BOOL succeeded) {
    return succeeded != 0 ? 0 : last_error();
}

// As the calls want it that open files: beyond 247 characters only a whole path with this prefix is taken.
std::wstring name_of(const fs::path& file) {
    constexpr std::size_t longest_plain = 247;
    const std::wstring& plain = file.native();
    std::error_code error;
    const fs::path whole = fs::absolute(file, error).make_preferred();
    if (error || whole.native().size() <= longest_plain || plain.starts_with(L"\\\\")) return plain;
    return L"\\\\?\\" + whole.lexically_normal().native();
}

HANDLE system_handle(int handle) {
    return reinterpret_cast<HANDLE>(::_get_osfhandle(handle));
}

// Other processes may read, rename and remove the file meanwhile, as they may on other systems.
constexpr DWORD share_all = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

int open_file(const fs::path& file, DWORD access, DWORD disposition, DWORD flags, int crt_flags) {
    constexpr std::size_t longest_name = 255;  // in its file systems
    if (file.filename().native().size() > longest_name) {
        errno = ENAMETOOLONG;
        return -1;
    }
    const HANDLE handle =
        ::CreateFileW(name_of(file).c_str(), access, share_all, nullptr, disposition, flags, nullptr);
    if (handle == INVALID_HANDLE_VALUE) {
        errno = last_error();
        return -1;
    }
    const int descriptor =
        ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), crt_flags | _O_BINARY | _O_NOINHERIT);
    if (descriptor < 0) ::CloseHandle(handle);
    return descriptor;
}

const char* other_kind(DWORD attributes) {
    return (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0 ? "a directory" : nullptr;
}

}  // namespace

int open_to_read(const fs::path& file, Links links) {
    // Without FILE_FLAG_BACKUP_SEMANTICS a directory would look like a file that may not be read.
    const DWORD flags =
        FILE_FLAG_BACKUP_SEMANTICS | (links == Links::refuse ? FILE_FLAG_OPEN_REPARSE_POINT : 0);
    return open_file(file, GENERIC_READ, OPEN_EXISTING, flags, _O_RDONLY);
}

int make_file(const fs::path& file) {
    return open_file(file, GENERIC_READ | GENERIC_WRITE | DELETE, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, _O_RDWR);
}

int status_of(int handle, FileStatus& status) {
    const DWORD type = ::GetFileType(system_handle(handle));
    if (type != FILE_TYPE_DISK) {
        status.other_kind = type == FILE_TYPE_PIPE ? "a pipe" : "a device";
        return 0;
    }
    BY_HANDLE_FILE_INFORMATION found{};
    if (::GetFileInformationByHandle(system_handle(handle), &found) == 0) return last_error();
    status.other_kind = other_kind(found.dwFileAttributes);
    status.bytes = static_cast<std::uint64_t>(found.nFileSizeHigh) << 32 | found.nFileSizeLow;
    return 0;
}

int status_of(const fs::path& file, FileStatus& status) {
    const int handle =
        open_file(file, FILE_READ_ATTRIBUTES, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, _O_RDONLY);
    if (handle < 0) return errno;
    const int error = status_of(handle, status);
    ::_close(handle);
    return error;
}

constexpr std::size_t largest_transfer = std::size_t{1} << 30;  // a call counts with 32 bits

int read_some(int handle, char* bytes, std::size_t size, std::size_t& read) {
    DWORD count = 0;
    if (::ReadFile(system_handle(handle), bytes, static_cast<DWORD>(std::min(size, largest_transfer)), &count,
                   nullptr) == 0 &&
        ::GetLastError() != ERROR_HANDLE_EOF)
        return last_error();
    read = count;
    return 0;
}

int write_all(int handle, std::string_view bytes) {
    while (!bytes.empty()) {
        DWORD count = 0;
        if (::WriteFile(system_handle(handle), bytes.data(),
                        static_cast<DWORD>(std::min(bytes.size(), largest_transfer)), &count, nullptr) == 0)
            return last_error();
        bytes.remove_prefix(count);
    }
    return 0;
}

// A new file inherits the access list of its folder, and has nothing else to take over.
int set_permissions(int, unsigned) {
    return 0;
}

int flush(int handle) {
    return result_of(::FlushFileBuffers(system_handle(handle)));
}

int close(int handle) {
    return ::_close(handle) != 0 ? errno : 0;
}

// Other handles cannot read what is locked here, so that is a byte beyond every file's end.
bool take_lock(int handle) {
    OVERLAPPED place{};
    place.OffsetHigh = 0x7fffffff;
    return ::LockFileEx(system_handle(handle), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0,
                        &place) != 0;
}

int may_write(const fs::path& file) {
    const DWORD attributes = ::GetFileAttributesW(name_of(file).c_str());
    if (attributes == INVALID_FILE_ATTRIBUTES) return last_error();
    return (attributes & FILE_ATTRIBUTE_READONLY) != 0 ? EACCES : 0;
}

// While another process reads the old file, without leave to replace it, a moment's patience mostly helps:
// indexers and virus scanners open every new file.
int replace(const fs::path& from, const fs::path& to) {
    constexpr int max_tries = 100;
    constexpr DWORD pause_ms = 10;
    const std::wstring old_name = name_of(from), new_name = name_of(to);
    for (int tries = 1;; ++tries) {
        if (::MoveFileExW(old_name.c_str(), new_name.c_str(),
                          MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0)
            return 0;
        const DWORD error = ::GetLastError();
        const bool in_use = error == ERROR_ACCESS_DENIED || error == ERROR_SHARING_VIOLATION;
        const DWORD attributes = ::GetFileAttributesW(new_name.c_str());
        const bool is_file =
            attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) == 0;
        if (!in_use || !is_file || tries == max_tries) return errno_of(error);
        ::Sleep(pause_ms);
    }
}

int remove(const fs::path& file) {
    return result_of(::DeleteFileW(name_of(file).c_str()));
}

// MOVEFILE_WRITE_THROUGH waits for it.
int flush_folder(const fs::path&) {
    return 0;
}

int process_number() {
    return static_cast<int>(::GetCurrentProcessId());
}

bool process_is_gone(int number) {
    const HANDLE process = ::OpenProcess(SYNCHRONIZE, FALSE, static_cast<DWORD>(number));
    if (process == nullptr) return ::GetLastError() == ERROR_INVALID_PARAMETER;
    const bool ended = ::WaitForSingleObject(process, 0) == WAIT_OBJECT_0;
    ::CloseHandle(process);
    return ended;
}

}  // namespace slipface::platform

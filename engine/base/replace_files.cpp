#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "descriptor.h"
#include "interrupted_writes.h"
#include "slipface/base/files.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// The end of a chain of symbolic links, whether or not a file is there.
Result<fs::path> link_target(const fs::path& path) {
    constexpr int longest_chain = 40;  // the limit in Linux
    fs::path target = path;
    for (int hop = 0; hop < longest_chain; ++hop) {
        std::error_code error;
        if (!fs::is_symlink(fs::symlink_status(target, error))) return target;
        const fs::path next = fs::read_symlink(target, error);
        if (error) return Error{path.string(), "cannot follow the symbolic link: " + error.message()};
        target = next.is_absolute() ? next : target.parent_path() / next;
    }
    return Error{path.string(), "too many symbolic links, one after the other"};
}

fs::path folder_of(const fs::path& file) {
    return file.parent_path().empty() ? fs::path(".") : file.parent_path();
}

Error unwritable(const fs::path& path, int error) {
    return {path.string(), "cannot be written: " + reason_of_errno(error)};
}

// A written and flushed file under a temporary name. It is removed unless it was renamed. Its lock is held
// until then (interrupted_writes.h).
class Staged {
  public:
    // Returns 0, or the errno that stopped it.
    int write(std::string_view bytes, const unsigned* permissions) {
        // In containers process numbers begin anew, so that a killed process may have left a file of this
        // name.
        constexpr int max_tries = 100;
        for (int tries = 0; tries < max_tries; ++tries) {
            file_.emplace(platform::make_file(temporary_));
            if (file_->open() || errno != EEXIST) break;
            temporary_ = temporary_name(target_);
        }
        if (!file_->open()) return errno;
        made_ = true;
        (void)platform::take_lock(file_->get());  // there are file systems without
        if (permissions != nullptr)
            if (const int error = platform::set_permissions(file_->get(), *permissions); error != 0)
                return error;
        if (const int error = platform::write_all(file_->get(), bytes); error != 0) return error;
        return platform::flush(file_->get());
    }
    int rename_to(const fs::path& name) {
        const int error = platform::replace(temporary_, name);
        if (error == 0) made_ = false;
        return error;
    }

    explicit Staged(fs::path target) : target_(std::move(target)), temporary_(temporary_name(target_)) {}
    Staged(Staged&& other) noexcept
        : target_(std::move(other.target_)),
          temporary_(std::move(other.temporary_)),
          file_(std::move(other.file_)),
          made_(std::exchange(other.made_, false)) {}
    Staged& operator=(Staged&&) = delete;
    ~Staged() {
        if (made_) platform::remove(temporary_);
    }

    const fs::path& target() const { return target_; }
    const fs::path& temporary() const { return temporary_; }

  private:
    fs::path target_, temporary_;
    std::optional<Descriptor> file_;
    bool made_ = false;
};

// The place that `path` stands for, if it may be written.
Result<fs::path> writable_target(const fs::path& path) {
    if (path.filename().empty() || path.string().find('\0') != std::string::npos)
        return Error{path.string(), "names no file to write"};
    Result<fs::path> target = link_target(path);
    if (!target) return target;
    platform::FileStatus status;
    if (const int error = platform::status_of(*target, status); error != 0) {
        if (error != ENOENT) return unwritable(path, error);
        return target;
    }
    if (status.other_kind != nullptr)
        return Error{path.string(), fmt::format("is {}; expected a file", status.other_kind)};
    // A rename would replace a write-protected file, against the wish of its owner.
    if (const int error = platform::may_write(*target); error != 0) return unwritable(path, error);
    return target;
}

Result<Staged> stage(const fs::path& path, const fs::path& target, std::string_view bytes) {
    platform::FileStatus status;
    const bool exists = platform::status_of(target, status) == 0;
    Staged staged(target);
    if (const int error = staged.write(bytes, exists ? &status.permissions : nullptr); error != 0)
        return unwritable(path, error);
    return staged;
}

// The list of the renames, in place; nothing if no two files lie in the first one's folder or below.
Result<std::optional<Staged>> write_rename_list(const std::vector<Staged>& files) {
    const fs::path folder = folder_of(files.front().target());
    Renames renames;
    for (const Staged& file : files) {
        const fs::path to = file.target().lexically_normal().lexically_relative(folder.lexically_normal());
        if (to.empty() || *to.begin() == "..") continue;
        renames.emplace_back(to.parent_path() / file.temporary().filename(), to);
    }
    if (renames.size() < 2) return std::optional<Staged>();
    Staged list(rename_list_name(folder));
    int error = list.write(rename_list_text(renames), nullptr);
    if (error == 0) error = list.rename_to(list.target());
    if (error == 0) error = platform::flush_folder(folder);
    if (error != 0) return unwritable(list.target(), error);
    return std::optional<Staged>(std::move(list));
}

Status rename_all(std::span<const FileToWrite> files, std::vector<Staged>& staged,
                  const std::set<fs::path>& folders) {
    for (std::size_t i = 0; i < staged.size(); ++i)
        if (const int error = staged[i].rename_to(staged[i].target()); error != 0)
            return unwritable(files[i].path, error);
    for (const fs::path& folder : folders)
        if (const int error = platform::flush_folder(folder); error != 0)
            return Error{files.front().path.string(),
                         "is written, but its folder cannot be flushed to disk: " + reason_of_errno(error)};
    return {};
}

Status replace(std::span<const FileToWrite> files, std::vector<Staged>& staged) {
    std::set<fs::path> folders;
    std::vector<fs::path> targets;
    for (const FileToWrite& file : files) {
        const Result<fs::path> target = writable_target(file.path);
        if (!target) return target.error();
        targets.push_back(*target);
        folders.insert(folder_of(*target));
    }
    for (const fs::path& folder : folders)
        finish_interrupted_writes(folder);
    for (std::size_t i = 0; i < files.size(); ++i) {
        Result<Staged> one = stage(files[i].path, targets[i], files[i].bytes);
        if (!one) return one.error();
        staged.push_back(std::move(*one));
    }
    const Result<std::optional<Staged>> list = write_rename_list(staged);
    if (!list) return list.error();
    Status status = rename_all(files, staged, folders);
    if (*list) platform::remove((*list)->target());
    return status;
}

}  // namespace

Status write_files_atomic(std::span<const FileToWrite> files) {
    if (files.empty()) return {};
    std::vector<Staged> staged;
    staged.reserve(files.size());
    return replace(files, staged);
}

Status write_file_atomic(const fs::path& path, std::string_view bytes) {
    const FileToWrite file{path, bytes};
    return write_files_atomic({&file, 1});
}

}  // namespace slipface

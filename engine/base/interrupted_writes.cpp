#include "interrupted_writes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>

#include <atomic>
#include <chrono>
#include <optional>

#include "slipface/base/files.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view list_head = "slipface renames 1";
constexpr std::uint64_t max_list_bytes = std::uint64_t{1} << 20;

std::string process_mark() {
    static std::atomic<unsigned> counter{0};
    return fmt::format("{}-{}", ::getpid(), counter++);
}

// The process in "PID-N" at the end of `text`.
std::optional<pid_t> process_of(std::string_view text) {
    const std::size_t begin = text.find_last_not_of("0123456789-") + 1;
    const std::string_view mark = text.substr(begin);
    const std::size_t dash = mark.find('-');
    if (dash == std::string_view::npos || dash + 1 == mark.size()) return std::nullopt;
    const auto pid = parse_int(mark.substr(0, dash));
    if (!pid || *pid <= 0 || *pid > 0x7fffffff) return std::nullopt;
    return static_cast<pid_t>(*pid);
}

bool has_form(std::string_view name, std::string_view head, std::string_view tail) {
    return name.size() > head.size() + tail.size() && name.starts_with(head) && name.ends_with(tail) &&
           process_of(name.substr(0, name.size() - tail.size()));
}

bool is_temporary(std::string_view name) {
    return has_form(name, ".", ".tmp");
}

// A writer takes the lock of a temporary file directly after making it. That process is gone, or the file is
// older than any such moment (a number that another process has meanwhile).
bool is_left_over(const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    const pid_t pid = process_of(name.substr(0, name.size() - 4)).value_or(0);
    if (::kill(pid, 0) != 0 && errno == ESRCH) return true;
    std::error_code error;
    const auto age = fs::file_time_type::clock::now() - entry.last_write_time(error);
    return !error && age > std::chrono::minutes(1);
}

bool inside(const fs::path& name) {
    return !name.empty() && name.is_relative() && name.lexically_normal() == name && *name.begin() != "..";
}

// A list from elsewhere can do no more than rename such temporary files of its own folder.
std::optional<Renames> parse_rename_list(std::string_view text) {
    std::vector<std::string_view> words = split(text, '\0');
    if (words.size() < 2 || words.front() != list_head || !words.back().empty() || words.size() % 2 != 0)
        return std::nullopt;
    Renames renames;
    for (std::size_t i = 1; i + 1 < words.size(); i += 2) {
        const fs::path from(words[i]), to(words[i + 1]);
        if (!inside(from) || !inside(to) || from.parent_path() != to.parent_path() ||
            !is_temporary(from.filename().string()))
            return std::nullopt;
        renames.emplace_back(from, to);
    }
    return renames;
}

// A rename that fails because its file is gone was done before.
void finish_list(const fs::path& list) {
    const Descriptor file(::open(list.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (!file.open() || !take_lock(file)) return;
    const Result<std::string> text = read_file(list, max_list_bytes);
    const std::optional<Renames> renames = text ? parse_rename_list(*text) : std::nullopt;
    if (!renames) return;
    const fs::path folder = list.parent_path();
    for (const auto& [from, to] : *renames)
        if (::rename((folder / from).c_str(), (folder / to).c_str()) != 0 && errno != ENOENT) return;
    ::unlink(list.c_str());
}

void remove_left_over(const fs::directory_entry& entry) {
    if (!entry.is_regular_file() || entry.is_symlink() || !is_left_over(entry)) return;
    const Descriptor file(::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (file.open() && take_lock(file)) ::unlink(entry.path().c_str());
}

}  // namespace

fs::path temporary_name(const fs::path& target) {
    constexpr std::size_t longest_stem = 200;
    const std::string stem = target.filename().string().substr(0, longest_stem);
    return target.parent_path() / fmt::format(".{}.{}.tmp", stem, process_mark());
}

fs::path rename_list_name(const fs::path& folder) {
    return folder / fmt::format(".slipface.{}.renames", process_mark());
}

bool take_lock(const Descriptor& file) {
    return ::flock(file.get(), LOCK_EX | LOCK_NB) == 0;
}

std::string rename_list_text(const Renames& renames) {
    std::string text(list_head);
    text += '\0';
    for (const auto& [from, to] : renames) {
        text += from.string() + '\0';
        text += to.string() + '\0';
    }
    return text;
}

void finish_interrupted_writes(const fs::path& folder) {
    try {
        std::vector<fs::directory_entry> temporary;
        std::error_code error;
        for (fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, error), end;
             !error && at != end; at.increment(error)) {
            const std::string name = at->path().filename().string();
            if (has_form(name, ".slipface.", ".renames")) finish_list(at->path());
            if (is_temporary(name)) temporary.push_back(*at);
        }
        // After the lists, because these rename some of them.
        for (const fs::directory_entry& entry : temporary)
            remove_left_over(entry);
    } catch (const std::exception&) {
        // A folder that changes meanwhile, or too little memory: the next writer tries again.
    }
}

}  // namespace slipface

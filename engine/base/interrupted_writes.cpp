#include "interrupted_writes.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <optional>

#include "descriptor.h"
#include "slipface/base/files.h"
#include "slipface/base/system.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view list_head = "slipface renames 1";
constexpr std::string_view own_mark = ".slipface.", own_ending = ".tmp";  // of temporary files
constexpr std::uint64_t max_list_bytes = std::uint64_t{1} << 20;

std::string process_mark() {
    static std::atomic<unsigned> counter{0};
    return fmt::format("{}-{}", platform::process_number(), counter++);
}

// The process in "PID-N" at the end of `text`.
std::optional<int> process_of(std::string_view text) {
    const std::size_t begin = text.find_last_not_of("0123456789-") + 1;
    const std::string_view mark = text.substr(begin);
    const std::size_t dash = mark.find('-');
    if (dash == std::string_view::npos || dash + 1 == mark.size()) return std::nullopt;
    const auto pid = parse_int(mark.substr(0, dash));
    if (!pid || *pid <= 0 || *pid > 0x7fffffff) return std::nullopt;
    return static_cast<int>(*pid);
}

bool has_form(std::string_view name, std::string_view head, std::string_view tail) {
    return name.size() > head.size() + tail.size() && name.starts_with(head) && name.ends_with(tail) &&
           process_of(name.substr(0, name.size() - tail.size()));
}

// Other programs have temporary files, too, and some end in numbers.
bool is_temporary(std::string_view name) {
    if (!has_form(name, ".", own_ending)) return false;
    const std::size_t mark = name.find_last_not_of("0123456789-", name.size() - own_ending.size() - 1) + 1;
    return name.substr(0, mark).ends_with(own_mark);
}

// A writer takes the lock of a temporary file directly after making it, and holds it until it is done with
// the file. That process is gone, or the file is older than any such moment (a number that another process
// has meanwhile).
bool is_left_over(const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    const int pid = process_of(name.substr(0, name.size() - 4)).value_or(0);
    if (platform::process_is_gone(pid)) return true;
    std::error_code error;
    const auto age = fs::file_time_type::clock::now() - entry.last_write_time(error);
    return !error && age > std::chrono::minutes(1);
}

bool inside(const fs::path& name) {
    return !name.empty() && !name.has_root_path() && name.lexically_normal() == name && *name.begin() != "..";
}

// A list from elsewhere can do no more than rename such temporary files of its own folder.
std::optional<Renames> parse_rename_list(std::string_view text) {
    std::vector<std::string_view> words = split(text, '\0');
    if (words.size() < 2 || words.front() != list_head || !words.back().empty() || words.size() % 2 != 0)
        return std::nullopt;
    Renames renames;
    for (std::size_t i = 1; i + 1 < words.size(); i += 2) {
        const fs::path from = path_of(words[i]), to = path_of(words[i + 1]);
        if (!inside(from) || !inside(to) || from.parent_path() != to.parent_path() ||
            !is_temporary(from.filename().string()))
            return std::nullopt;
        renames.emplace_back(from, to);
    }
    return renames;
}

// A rename that fails because its file is gone was done before.
void finish_list(const fs::path& list) {
    const Descriptor file(platform::open_to_read(list, platform::Links::refuse));
    if (!file.open() || !platform::take_lock(file.get())) return;
    const Result<std::string> text = read_file(list, max_list_bytes);
    const std::optional<Renames> renames = text ? parse_rename_list(*text) : std::nullopt;
    if (!renames) return;
    const fs::path folder = list.parent_path();
    for (const auto& [from, to] : *renames)
        if (const int error = platform::replace(folder / from, folder / to); error != 0 && error != ENOENT)
            return;
    platform::remove(list);
}

void remove_left_over(const fs::directory_entry& entry) {
    if (!entry.is_regular_file() || entry.is_symlink() || !is_left_over(entry)) return;
    const Descriptor file(platform::open_to_read(entry.path(), platform::Links::refuse));
    if (file.open() && platform::take_lock(file.get())) platform::remove(entry.path());
}

}  // namespace

fs::path temporary_name(const fs::path& target) {
    constexpr std::size_t longest_stem = 200;
    const std::string stem = target.filename().string().substr(0, longest_stem);
    return target.parent_path() /
           path_of(fmt::format(".{}{}{}{}", stem, own_mark, process_mark(), own_ending));
}

fs::path rename_list_name(const fs::path& folder) {
    return folder / fmt::format(".slipface.{}.renames", process_mark());
}

std::string rename_list_text(const Renames& renames) {
    std::string text(list_head);
    text += '\0';
    for (const auto& [from, to] : renames) {
        text += from.generic_string() + '\0';
        text += to.generic_string() + '\0';
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

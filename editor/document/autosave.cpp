#include "document/autosave.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <random>
#include <system_error>
#include <utility>

#include "document/merge_levels.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view first_line = "slipface-autosave 3";
constexpr std::string_view first_line_2 = "slipface-autosave 2";  // without the contents of level files
constexpr std::string_view first_line_1 = "slipface-autosave 1";  // and nothing in it was escaped
constexpr std::string_view extension = ".autosave";
constexpr std::uint64_t max_bytes = std::uint64_t{1} << 30;
constexpr std::size_t max_steps = 50;

std::uint64_t hash_of(std::string_view text) {
    Hasher hasher;
    hasher.text(text);
    return hasher.value();
}

std::vector<std::string> unsaved_steps(const Document& document) {
    std::vector<std::string> names;
    const std::size_t first = std::min(document.saved_cursor().value_or(0), document.history_cursor());
    for (std::size_t i = first; i < document.history_cursor(); ++i)
        if (document.history()[i].changes_file()) names.push_back(document.history()[i].name);
    if (names.size() > max_steps)
        names.erase(names.begin(), names.end() - static_cast<std::ptrdiff_t>(max_steps));
    return names;
}

// 0 for what is no number.
std::uint64_t parse_content(std::string_view text) {
    std::uint64_t content = 0;
    std::from_chars(text.data(), text.data() + text.size(), content);
    return content;
}

// SESSION-LEVELHASH-NUMBER.autosave
struct NameParts {
    std::string session, level;
    std::uint64_t number = 0;
};
std::optional<NameParts> parts_of(const fs::path& file) {
    if (file.extension() != extension) return std::nullopt;
    const std::string stem = file.stem().string();
    const auto words = split(stem, '-');
    if (words.size() != 3) return std::nullopt;
    const std::optional<std::int64_t> number = parse_int(words[2]);
    if (!number || *number < 0) return std::nullopt;
    return NameParts{std::string(words[0]), std::string(words[1]), static_cast<std::uint64_t>(*number)};
}

// The autosaves of the folder by session and level, oldest first. Other files are ignored.
std::map<std::pair<std::string, std::string>, std::map<std::uint64_t, fs::path>> autosaves_in(
    const fs::path& folder) {
    std::map<std::pair<std::string, std::string>, std::map<std::uint64_t, fs::path>> found;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code unreadable;
        if (!it->is_regular_file(unreadable) || unreadable) continue;
        if (const auto parts = parts_of(it->path()))
            found[{parts->session, parts->level}][parts->number] = it->path();
    }
    return found;
}

// A handle that holds the lock, or -1 if another process has it.
int take_lock(const fs::path& file, bool create) {
    const int handle = ::open(file.c_str(), O_RDWR | O_CLOEXEC | (create ? O_CREAT : 0), 0600);
    if (handle < 0) return -1;
    if (::flock(handle, LOCK_EX | LOCK_NB) == 0) return handle;
    ::close(handle);
    return -1;
}

Status write_verified(const fs::path& file, const std::string& text) {
    if (const Status status = write_file_atomic(file, text); !status) return status;
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (error || size != text.size()) return Error{file.string(), "was written with a wrong length"};
    return {};
}

}  // namespace

std::string autosave_text(const Autosave& autosave) {
    const AutosaveInfo& info = autosave.info;
    std::string text =
        fmt::format("{}\nmesh {}\nlevel {}\nwritten {}\n", first_line, on_one_line(info.mesh_path.string()),
                    on_one_line(info.level_path.string()), info.written_s);
    for (const std::string& step : info.steps)
        text += "step " + on_one_line(step) + "\n";
    for (const std::uint64_t content : info.goes_on_from)
        text += fmt::format("goes_on_from {}\n", content);
    if (info.seen) text += fmt::format("seen {}\n", *info.seen);
    if (autosave.base) text += fmt::format("base {}\n", autosave.base->size());
    const std::string rest = autosave.json + autosave.base.value_or("");
    return text + fmt::format("bytes {} {:016x}\n", rest.size(), hash_of(rest)) + rest;
}

Result<Autosave> parse_autosave(std::string_view text, const std::string& location) {
    const auto bad = [&](int line, const std::string& what) {
        return Error{fmt::format("{}:{}", location, line), what};
    };
    Autosave autosave;
    bool escapes = true, knows_base = true;
    std::optional<std::size_t> base;
    for (int number = 1;; ++number) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return bad(number, "the header is truncated");
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end + 1);
        if (number == 1) {
            escapes = line != first_line_1;
            knows_base = line == first_line;
            if (!knows_base && escapes && line != first_line_2)
                return bad(1, "this is no autosave; expected " + std::string(first_line));
            continue;
        }
        const std::size_t space = line.find(' ');
        const std::string_view key = line.substr(0, space);
        const std::string_view rest = space == std::string_view::npos ? "" : line.substr(space + 1);
        const std::string value = escapes ? from_one_line(rest) : std::string(rest);
        if (key == "mesh") autosave.info.mesh_path = value;
        if (key == "level") autosave.info.level_path = value;
        if (key == "step") autosave.info.steps.push_back(value);
        if (key == "written") autosave.info.written_s = parse_int(value).value_or(0);
        if (key == "goes_on_from") autosave.info.goes_on_from.push_back(parse_content(value));
        if (key == "seen") autosave.info.seen = parse_content(value);
        if (key == "base") base = static_cast<std::size_t>(parse_int(value).value_or(-1));
        if (key != "bytes") continue;
        if (value != fmt::format("{} {:016x}", text.size(), hash_of(text)))
            return bad(number, "the content is truncated or altered");
        break;
    }
    if (autosave.info.mesh_path.empty()) return bad(2, "the mesh line is missing");
    if (base && *base > text.size()) return bad(2, "the base is longer than the whole");
    autosave.json = text.substr(0, text.size() - base.value_or(0));
    if (base) autosave.base = text.substr(autosave.json.size());
    autosave.info.content = content_of(autosave.json);
    if (knows_base) autosave.info.base = autosave.base ? content_of(*autosave.base) : 0;
    return autosave;
}

Result<Autosave> read_autosave(const fs::path& file) {
    const Result<std::string> text = read_file(file, max_bytes);
    if (!text) return text.error();
    Result<Autosave> autosave = parse_autosave(*text, file.string());
    if (autosave) autosave->info.file = file;
    return autosave;
}

AutosaveSession::AutosaveSession(fs::path folder, Timing timing)
    : folder_(std::move(folder)), timing_(timing) {
    take_name();
}

void AutosaveSession::take_name() {
    std::error_code error;
    fs::create_directories(folder_, error);
    std::random_device random;
    int reason = 0;
    for (int attempt = 0; attempt < 8 && lock_ < 0; ++attempt) {
        name_ = fmt::format("{:08x}{:08x}", random(), random());
        lock_ = take_lock(folder_ / (name_ + ".lock"), true);
        reason = errno;
    }
    if (lock_ >= 0)
        last_ = {};
    else
        last_ = Error{folder_.string(), "cannot be written: " + std::generic_category().message(reason)};
}

AutosaveSession::AutosaveSession(AutosaveSession&& other) noexcept {
    *this = std::move(other);
}

AutosaveSession& AutosaveSession::operator=(AutosaveSession&& other) noexcept {
    std::swap(folder_, other.folder_);
    std::swap(timing_, other.timing_);
    std::swap(name_, other.name_);
    std::swap(lock_, other.lock_);
    std::swap(held_, other.held_);
    std::swap(number_, other.number_);
    std::swap(written_, other.written_);
    std::swap(writing_, other.writing_);
    std::swap(last_, other.last_);
    std::swap(goes_on_from_, other.goes_on_from_);
    std::swap(seen_content_, other.seen_content_);
    std::swap(failed_, other.failed_);
    std::swap(retry_at_s_, other.retry_at_s_);
    std::swap(pause_s_, other.pause_s_);
    std::swap(seen_revision_, other.seen_revision_);
    std::swap(saved_revision_, other.saved_revision_);
    std::swap(first_change_s_, other.first_change_s_);
    std::swap(last_change_s_, other.last_change_s_);
    return *this;
}

AutosaveSession::~AutosaveSession() {
    static_cast<void>(finish());
    for (const auto& [session, held] : held_)
        ::close(held.lock);
    if (lock_ < 0) return;
    // The program ends normally: nobody needs the remaining autosaves.
    for (const auto& [key, files] : autosaves_in(folder_)) {
        std::error_code ignored;
        if (key.first != name_) continue;
        for (const auto& [number, file] : files)
            fs::remove(file, ignored);
    }
    std::error_code ignored;
    fs::remove(folder_ / (name_ + ".lock"), ignored);
    ::close(lock_);
}

void AutosaveSession::abandon() {
    static_cast<void>(finish());
    if (lock_ >= 0) ::close(std::exchange(lock_, -1));
    for (const auto& [session, held] : std::exchange(held_, {}))
        ::close(held.lock);
}

std::string AutosaveSession::file_name(const fs::path& mesh_path, std::uint64_t number) const {
    return fmt::format("{}-{:016x}-{}{}", name_, hash_of(mesh_path.string()), number, extension);
}

std::optional<double> AutosaveSession::due_in(const Document& document, double now_s) const {
    if (folder_.empty() || !document.dirty()) return std::nullopt;
    if (writing_.valid()) return 0.1;
    if (document.revision() != seen_revision_) return 0.0;
    if (!first_change_s_) return std::nullopt;
    double due = std::min(*last_change_s_ + timing_.quiet_s, *first_change_s_ + timing_.longest_s);
    if (retry_at_s_) due = *retry_at_s_;
    return std::max(document.in_transaction() ? 0.1 : 0.0, due - now_s);
}

void AutosaveSession::tick(const Document& document, double now_s, std::optional<std::uint64_t> seen) {
    if (folder_.empty()) return;
    if (writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        static_cast<void>(finish());
    if (std::exchange(failed_, false)) retry_later(now_s);
    const std::uint64_t content = seen.value_or(document.base().content);
    if (document.revision() != seen_revision_ || content != seen_content_) {
        seen_revision_ = document.revision();
        if (document.dirty() && (seen_revision_ != saved_revision_ || content != seen_content_)) {
            last_change_s_ = now_s;
            if (!first_change_s_) first_change_s_ = now_s;
        }
        seen_content_ = content;
    }
    if (!document.dirty()) first_change_s_.reset();
    if (!first_change_s_ || writing_.valid() || document.in_transaction()) return;
    const double due = std::min(*last_change_s_ + timing_.quiet_s, *first_change_s_ + timing_.longest_s);
    if (now_s < retry_at_s_.value_or(due)) return;
    if (!active()) take_name();
    if (!active()) return retry_later(now_s);
    start_writing(document, document.level().file_path, content);
}

void AutosaveSession::retry_later(double now_s) {
    saved_revision_ = 0;
    if (!first_change_s_) first_change_s_ = last_change_s_ = now_s;
    retry_at_s_ = now_s + pause_s_;
    pause_s_ = std::min(2.0 * pause_s_, longest_retry_s);
}

void AutosaveSession::start_writing(const Document& document, const fs::path& level_file,
                                    std::uint64_t seen) {
    first_change_s_.reset();
    saved_revision_ = document.revision();
    Level level = document.snapshot();
    level.file_path = level_file;
    AutosaveInfo info;
    std::error_code ignored;
    info.mesh_path = fs::absolute(level.mesh_path, ignored);
    info.level_path = fs::absolute(level.file_path, ignored);
    info.written_s =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
            .count();
    info.steps = unsaved_steps(document);
    info.seen = seen;
    info.goes_on_from = goes_on_from_;
    // Skips a name that is already used.
    do {
        info.file = folder_ / file_name(info.mesh_path, number_++);
    } while (fs::exists(info.file, ignored));
    const fs::path mesh_path = info.mesh_path;
    writing_ = std::async(std::launch::async, [level = std::move(level), info = std::move(info),
                                               base = document.base().text] {
        std::optional<std::string> base_text;
        if (base) base_text = *base;
        return write_verified(info.file, autosave_text({info, level_to_json(level), std::move(base_text)}));
    });
    ++written_;
    rotate(mesh_path);
}

void AutosaveSession::write_now(const Document& document, const fs::path& level_file) {
    if (!active() || !document.dirty() || document.in_transaction()) return;
    static_cast<void>(finish());
    start_writing(document, level_file, document.base().content);
    static_cast<void>(finish());
}

void AutosaveSession::go_on_from(const AutosaveInfo& recovered) {
    goes_on_from_ = recovered.goes_on_from;
    goes_on_from_.push_back(recovered.content);
}

// Only this session's own files. The newest does not exist yet: it is being written.
void AutosaveSession::rotate(const fs::path& mesh_path) {
    const std::string level = fmt::format("{:016x}", hash_of(mesh_path.string()));
    const auto all = autosaves_in(folder_);
    const auto found = all.find({name_, level});
    if (found == all.end()) return;
    std::size_t surplus =
        found->second.size() >= max_for_each_level ? found->second.size() - max_for_each_level + 1 : 0;
    for (const auto& [number, file] : found->second) {
        if (surplus-- == 0) break;
        std::error_code ignored;
        fs::remove(file, ignored);
    }
}

Status AutosaveSession::finish() {
    if (!writing_.valid()) return last_;
    try {
        last_ = writing_.get();
    } catch (const std::exception& error) {
        last_ = Error{folder_.string(), std::string("cannot be written: ") + error.what()};
    }
    failed_ = !last_;
    if (last_) {
        retry_at_s_.reset();
        pause_s_ = retry_s;
    }
    return last_;
}

void AutosaveSession::forget(const Document& document) {
    if (!active()) return;
    static_cast<void>(finish());
    last_ = {};
    failed_ = false;
    first_change_s_.reset();
    retry_at_s_.reset();
    goes_on_from_.clear();
    seen_revision_ = saved_revision_ = document.revision();
    seen_content_ = document.base().content;
    std::error_code ignored;
    const std::string level =
        fmt::format("{:016x}", hash_of(fs::absolute(document.level().mesh_path, ignored).string()));
    for (const auto& [key, files] : autosaves_in(folder_)) {
        if (key.first != name_ || key.second != level) continue;
        for (const auto& [number, file] : files)
            fs::remove(file, ignored);
    }
}

std::vector<AutosaveInfo> AutosaveSession::recoverable() {
    std::vector<AutosaveInfo> found;
    if (folder_.empty()) return found;
    using Content = std::pair<fs::path, std::uint64_t>;  // of a level
    std::set<Content> gone_on_from;
    for (const auto& [key, files] : autosaves_in(folder_)) {
        // The newest that can be read: a power failure may have truncated the last one.
        std::size_t older = files.size();
        std::optional<AutosaveInfo> newest;
        for (auto file = files.rbegin(); file != files.rend() && !newest; ++file) {
            --older;
            if (Result<Autosave> autosave = read_autosave(file->second)) newest = std::move(autosave->info);
        }
        if (!newest) continue;
        newest->older = older;
        for (const std::uint64_t content : newest->goes_on_from)
            if (content != newest->content) gone_on_from.emplace(newest->level_path, content);
        const auto held = held_.find(key.first);
        if (key.first == name_ || (held != held_.end() && held->second.levels.contains(key.second))) continue;
        const fs::path lock = folder_ / (key.first + ".lock");
        std::error_code error;
        if (held == held_.end() && fs::exists(lock, error)) {
            const int handle = take_lock(lock, false);
            if (handle < 0) continue;  // that session is running
            ::close(handle);
        }
        found.push_back(std::move(*newest));
    }
    std::map<fs::path, std::uint64_t> contents;  // of the level files
    std::set<Content> known;                     // a recovery that nobody went on from has the same content
    std::erase_if(found, [&](AutosaveInfo& info) {
        const auto [content, added] = contents.try_emplace(info.level_path);
        if (added) {
            const Result<LevelBase> now = read_level_base(info.level_path);
            if (now) content->second = now->content;
        }
        info.saved_since = info.seen && content->second != *info.seen;
        const Content own(info.level_path, info.content);
        const bool over =
            content->second == info.content || gone_on_from.contains(own) || !known.insert(own).second;
        if (over && hold(info)) discard(info);
        return over;
    });
    std::stable_sort(found.begin(), found.end(),
                     [](const AutosaveInfo& a, const AutosaveInfo& b) { return a.written_s > b.written_s; });
    return found;
}

bool AutosaveSession::hold(const AutosaveInfo& info) {
    const auto parts = parts_of(info.file);
    std::error_code error;
    if (!parts || !active() || !fs::exists(info.file, error)) return false;
    Held& held = held_[parts->session];
    if (held.lock < 0) held.lock = take_lock(folder_ / (parts->session + ".lock"), true);
    if (held.lock < 0) {
        held_.erase(parts->session);
        return false;
    }
    // Its owner may have removed it between the check and the lock.
    if (!fs::exists(info.file, error)) {
        let_go(info);
        return false;
    }
    held.levels.insert(parts->level);
    return true;
}

void AutosaveSession::let_go(const AutosaveInfo& info) {
    const auto parts = parts_of(info.file);
    const auto held = parts ? held_.find(parts->session) : held_.end();
    if (held == held_.end()) return;
    held->second.levels.erase(parts->level);
    if (!held->second.levels.empty()) return;
    ::close(held->second.lock);
    held_.erase(held);
}

void AutosaveSession::discard(const AutosaveInfo& info) {
    const auto parts = parts_of(info.file);
    if (!parts || info.file.parent_path() != folder_) return;
    std::error_code ignored;
    bool others = false;
    for (const auto& [key, files] : autosaves_in(folder_)) {
        if (key.first != parts->session) continue;
        if (key.second != parts->level) {
            others = true;
            continue;
        }
        for (const auto& [number, file] : files)
            fs::remove(file, ignored);
    }
    if (!others) fs::remove(folder_ / (parts->session + ".lock"), ignored);
    let_go(info);
}

Result<Recovered> open_recovered(const Autosave& autosave, Progress* progress) {
    const AutosaveInfo& info = autosave.info;
    const std::string location = info.level_path.string();
    Result<std::unique_ptr<Document>> opened = Document::open(info.mesh_path, progress);
    if (!opened) return opened.error();
    Recovered recovered{std::move(*opened), {}, {}};
    Document& document = *recovered.document;
    Result<LoadedLevel> level = level_from_json(autosave.json, location, document.level());
    if (!level) return level.error();
    const Level untouched = document.snapshot();
    Level mine = std::move(level->level);
    std::optional<std::vector<FaceId>> selected;
    if (info.base && document.base().content != *info.base) {
        const Result<Level> base = annotated(autosave.base ? &*autosave.base : nullptr, location, untouched);
        if (!base) return base.error();
        Result<MergedLevels> merged = merge_levels(*base, mine, untouched, MergeSide::theirs);
        if (!merged) return merged.error();
        mine = std::move(merged->level);
        recovered.conflicts = std::move(merged->conflicts);
        if (!recovered.conflicts.empty()) selected = recovered.conflicts;
        recovered.other_conflicts = std::move(merged->other_conflicts);
    }
    document.restore(std::move(mine), "Recover " + info.mesh_path.filename().string(), std::move(selected));
    return recovered;
}

}  // namespace slipface

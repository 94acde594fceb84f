// Autosaves: what was done since the last save, kept where a crash cannot take it.
//
// A folder holds the autosaves of all running programs. Each session has a name and a lock that the system
// gives back when the process ends, however it ends; a session that nobody holds left its autosaves behind,
// and these are what is recovered. Files in the folder that are no autosaves are passed over.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <future>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "document/document.h"

namespace slipface {

// What an autosave says of itself.
struct AutosaveInfo {
    std::filesystem::path file;        // the autosave
    std::filesystem::path mesh_path;   // of the level it belongs to
    std::filesystem::path level_path;  // where the level is saved
    std::int64_t written_s = 0;        // since 1970, UTC
    std::vector<std::string> steps;    // names of the steps that were not saved, oldest first
    std::size_t older = 0;             // earlier autosaves of the same level in the same session
};

struct Autosave {
    AutosaveInfo info;
    std::string json;  // the text of a level file
};

// The file's text; what parse_autosave reads back.
std::string autosave_text(const Autosave& autosave);
// Refuses what is cut short or changed: the header holds the length and a hash of what follows.
Result<Autosave> parse_autosave(std::string_view text, const std::string& location);
Result<Autosave> read_autosave(const std::filesystem::path& file);

class AutosaveSession {
  public:
    static constexpr std::size_t kept_for_each_level = 5;

    // Times in seconds; autosaves are due `quiet_s` after the last change, or `longest_s` after the first.
    struct Timing {
        double quiet_s = 3.0;
        double longest_s = 20.0;
    };

    AutosaveSession() = default;  // writes nothing
    explicit AutosaveSession(std::filesystem::path folder) : AutosaveSession(std::move(folder), Timing()) {}
    AutosaveSession(std::filesystem::path folder, Timing timing);
    ~AutosaveSession();
    AutosaveSession(AutosaveSession&& other) noexcept;
    AutosaveSession& operator=(AutosaveSession&& other) noexcept;

    bool active() const { return lock_ >= 0; }

    // Looks whether an autosave is due at `now_s` (any steadily growing clock) and starts to write it beside
    // the caller. Never in the middle of a transaction, and only when something changed since the last.
    void tick(const Document& document, double now_s);
    // Seconds from `now_s` until tick() has something to do; nothing: not before the next change.
    std::optional<double> due_in(const Document& document, double now_s) const;
    // Waits for the file that is being written. The reason why the last one failed, or success.
    Status finish();
    // The document was saved, or its changes were thrown away on purpose: its autosaves go.
    void forget(const Document& document);
    // As after a crash: the files stay, the lock goes. For tests.
    void abandon();

    // The newest autosave of each level that an ended session left, newest first.
    std::vector<AutosaveInfo> recoverable() const;
    // Takes it for this program, which recovers it, until it is discarded or let go, or this one ends: no
    // other finds it recoverable meanwhile. False: another has taken it, or it is no more.
    bool hold(const AutosaveInfo& info);
    void let_go(const AutosaveInfo& info);
    // Deletes it and the older ones of the same level and session.
    void discard(const AutosaveInfo& info);

    std::size_t written() const { return written_; }

  private:
    std::string file_name(const std::filesystem::path& mesh_path, std::uint64_t number) const;
    void rotate(const std::filesystem::path& mesh_path);

    std::filesystem::path folder_;
    Timing timing_;
    std::string name_;  // of this session
    int lock_ = -1;
    struct Held {
        int lock = -1;
        std::set<std::string> levels;  // hashes of their names
    };
    std::map<std::string, Held> held_;  // of other sessions, which ended
    std::uint64_t number_ = 0;          // of the next autosave
    std::size_t written_ = 0;
    std::future<Status> writing_;
    Status last_;

    // What was seen of the document last.
    std::uint64_t seen_revision_ = 0, saved_revision_ = 0;
    std::optional<double> first_change_s_, last_change_s_;
};

// The document as it is on disk with the autosave's state as one step on top; where the level file cannot be
// read, on the bare geometry.
Result<std::unique_ptr<Document>> open_recovered(const Autosave& autosave, Progress* progress = nullptr);

}  // namespace slipface

// Autosaves: the changes since the last save, stored in files that survive a crash.
//
// One folder holds the autosaves of all running programs. Each session has a name and a lock file. The system
// releases the lock when the process ends, however it ends. A session whose lock is free has ended, and its
// autosaves can be recovered. Other files in the folder are ignored.
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

// The header of an autosave.
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
// Reads the text of an autosave. Fails if it is truncated or altered: the header holds the length and a hash
// of the rest. `location` names the text in the error.
Result<Autosave> parse_autosave(std::string_view text, const std::string& location);
Result<Autosave> read_autosave(const std::filesystem::path& file);

class AutosaveSession {
  public:
    static constexpr std::size_t max_for_each_level = 5;

    // Times in seconds; autosaves are due `quiet_s` after the last change, or `longest_s` after the first.
    struct Timing {
        double quiet_s = 3.0;
        double longest_s = 20.0;
    };

    AutosaveSession() = default;  // inactive: writes nothing
    explicit AutosaveSession(std::filesystem::path folder) : AutosaveSession(std::move(folder), Timing()) {}
    AutosaveSession(std::filesystem::path folder, Timing timing);
    ~AutosaveSession();
    AutosaveSession(AutosaveSession&& other) noexcept;
    AutosaveSession& operator=(AutosaveSession&& other) noexcept;

    bool active() const { return lock_ >= 0; }

    // Starts to write an autosave in a thread if one is due at `now_s` (any steadily growing clock). Writes
    // nothing during a transaction, or if nothing changed since the last autosave.
    void tick(const Document& document, double now_s);
    // Seconds from `now_s` until tick() has something to do. Nothing: only after the next change.
    std::optional<double> due_in(const Document& document, double now_s) const;
    // Waits for the file that is being written. Returns the error of the last autosave, or success.
    Status finish();
    // Deletes the document's autosaves: it was saved, or the user discarded its changes.
    void forget(const Document& document);
    // Ends the session as a crash would: the files stay, the lock is released. For tests.
    void abandon();

    // The newest autosave of each level that an ended session left, sorted newest first.
    std::vector<AutosaveInfo> recoverable() const;
    // Reserves the autosave for this program until discard(), let_go() or the end of the program. Meanwhile
    // no other program finds it recoverable. False: another program has reserved it, or it does not exist.
    bool hold(const AutosaveInfo& info);
    void let_go(const AutosaveInfo& info);
    // Deletes the autosave and the older ones of the same level and session.
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
    std::map<std::string, Held> held_;  // of other sessions, which have ended
    std::uint64_t number_ = 0;          // of the next autosave
    std::size_t written_ = 0;
    std::future<Status> writing_;
    Status last_;

    // The document's state at the last tick().
    std::uint64_t seen_revision_ = 0, saved_revision_ = 0;
    std::optional<double> first_change_s_, last_change_s_;
};

// Opens the saved document and applies the autosave's state on top as one step. If the level file cannot be
// read, it starts from the geometry alone.
Result<std::unique_ptr<Document>> open_recovered(const Autosave& autosave, Progress* progress = nullptr);

}  // namespace slipface

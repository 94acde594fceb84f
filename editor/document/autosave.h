// Autosaves: the changes since the last save, stored in files that survive a crash.
//
// One folder holds the autosaves of all running programs. Each session has a name and a lock file. The system
// releases the lock when the process ends, however it ends. A session whose lock is free has ended, and its
// autosaves can be recovered. Other files in the folder are ignored.
//
// What an autosave is for is known by content, never by clocks: it names the content of the level file that
// it adds to, of the one that its session saw last, and of the autosaves that it goes on from. So one whose
// content is in the level file, or from which another goes on, is over and is deleted; and one whose session
// did not see the level file as it is now is never offered unasked.
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
    // Contents (content_of; 0: no file). Of the autosave itself; of the level file that it adds to, and of
    // the one that its session saw last (nothing: not known); of the recovered autosaves that it goes on
    // from.
    std::uint64_t content = 0;
    std::optional<std::uint64_t> base, seen;
    std::vector<std::uint64_t> goes_on_from;
    // The level file has other content than `seen`: it was saved since. Not stored.
    bool saved_since = false;
};

struct Autosave {
    AutosaveInfo info;
    std::string json;                 // the text of a level file
    std::optional<std::string> base;  // that of the level file that it adds to; nothing: there was none
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

    bool active() const { return lock_ >= 0; }  // false: without a folder, or without access to it

    // Starts to write an autosave in a thread if one is due at `now_s` (any steadily growing clock). Writes
    // nothing during a transaction, or if nothing changed since the last autosave. One that failed is tried
    // again, after pauses of retry_s that double up to longest_retry_s. `seen`: the content of the level file
    // as it is now, if it is not document.base().
    static constexpr double retry_s = 5.0, longest_retry_s = 300.0;
    void tick(const Document& document, double now_s, std::optional<std::uint64_t> seen = {});
    // Why unsaved changes are not stored at present; success: they are, or will be in a moment.
    const Status& problem() const { return last_; }
    // Seconds from `now_s` until tick() has something to do. Nothing: only after the next change.
    std::optional<double> due_in(const Document& document, double now_s) const;
    // Waits for the file that is being written. Returns the error of the last autosave, or success.
    Status finish();
    // Writes an autosave of the unsaved changes now, as they would be saved to `level_file`. Before a save: a
    // session that ends between the save and forget() then leaves one whose content is in the level file.
    void write_now(const Document& document, const std::filesystem::path& level_file);
    // Deletes the document's autosaves: it was saved, or the user discarded its changes.
    void forget(const Document& document);
    // The next autosaves hold what `recovered` holds, until forget().
    void go_on_from(const AutosaveInfo& recovered);
    // Ends the session as a crash would: the files stay, the lock is released. For tests.
    void abandon();

    // The newest autosave of each level that an ended session left, sorted newest first. Deletes those that
    // are over.
    std::vector<AutosaveInfo> recoverable();
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
    void take_name();
    void start_writing(const Document& document, const std::filesystem::path& level_file, std::uint64_t seen);
    void retry_later(double now_s);

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

    std::vector<std::uint64_t> goes_on_from_;

    // The document's state at the last tick().
    std::uint64_t seen_revision_ = 0, saved_revision_ = 0, seen_content_ = 0;
    std::optional<double> first_change_s_, last_change_s_;
    // After a failure: when it is tried again, and the pause after the next one.
    bool failed_ = false;  // since the last tick
    std::optional<double> retry_at_s_;
    double pause_s_ = retry_s;
};

struct Recovered {
    std::unique_ptr<Document> document;
    // What the autosave and the level file both changed, each in another way: as the level file has it.
    std::vector<FaceId> conflicts;
    std::vector<std::string> other_conflicts;
};
// Opens the saved document and applies the autosave's state on top as one step. If the level file was saved
// since, the changes of both are merged (merge_levels), and where they contradict each other it stays as
// saved.
Result<Recovered> open_recovered(const Autosave& autosave, Progress* progress = nullptr);

}  // namespace slipface

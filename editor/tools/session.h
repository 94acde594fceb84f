// What goes on beside the editing: opening in a thread, autosaves, files that change on disk, the mesh
// doctor, and what is remembered from run to run.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "document/autosave.h"
#include "document/background.h"
#include "document/file_watch.h"
#include "document/preferences.h"
#include "document/recordings.h"
#include "slipface/doctor/doctor.h"
#include "tools/keymap.h"

namespace slipface {

struct Editor;

// A level on its way into the editor. Nothing is edited meanwhile.
struct Loading {
    enum class Kind { open, reload, recover } kind = Kind::open;
    std::filesystem::path path;
    AutosaveInfo autosave{};  // of a recovery
    bool unasked = false;     // a reload because the file changed, not because the user wants one
    // One of the two: a document of its own, or new geometry for the one that is open (nothing: the file's
    // bytes are those that were read before).
    std::unique_ptr<Background<Result<std::unique_ptr<Document>>>> opening{};
    std::unique_ptr<Background<Result<std::optional<LoadedLevel>>>> rereading{};

    const Progress& progress() const { return opening ? opening->progress() : rereading->progress(); }
    bool ready() const { return opening ? opening->ready() : rereading->ready(); }
    void cancel() { opening ? opening->cancel() : rereading->cancel(); }
};

// A file of the open level that another program wrote and that cannot be read as it is now: perhaps it is
// still being written, so it is tried again at every change, and only said after a while.
struct BrokenFile {
    std::filesystem::path file;
    std::string text;  // why
    double since_s = 0.0;
    bool reported = false;
};
inline constexpr double broken_patience_s = 4.0;

enum class Theme { dark, light };

struct Session {
    // Opening, reloading and examining happen in threads; without, the caller waits. A window sets it.
    bool beside = false;
    std::function<void()> wake;  // from any thread: the window has something to look at

    Preferences preferences;
    Keymap keymap;
    Theme theme = Theme::dark;
    double zoom = 1.0;                // of the user interface, on top of the screen's own scale
    const char* rebinding = nullptr;  // id of the command that waits for its new key
    bool help = false;                // the overlay of keys
    int tour = -1;                    // the step that is shown; -1: none

    std::optional<Loading> loading;
    Recordings recordings;
    AutosaveSession autosave;
    std::vector<AutosaveInfo> left_behind;  // by sessions that ended; the welcome screen lists them
    std::vector<AutosaveInfo> recoverable;  // of these, what is asked about while there are any
    std::optional<AutosaveInfo> recovered;  // deleted when what it held is safe again
    std::size_t written_before = 0;         // autosaves written when it was recovered
    FileWatch watch;
    double now_s = 0.0;        // of the last tick
    double next_look_s = 0.0;  // when the files are looked at again
    std::optional<BrokenFile> broken;

    std::unique_ptr<Background<DoctorReport>> doctor;
    std::optional<DoctorReport> report;
    std::uint64_t report_revision = 0;           // the document's face revision that was examined
    unsigned hidden_kinds = 0;                   // bit k: problems of kind k are not listed
    std::optional<std::size_t> problem, orphan;  // the row that was clicked last
};

inline constexpr double smallest_zoom = 0.7, largest_zoom = 2.5;

// Reads preferences and finds what a crash left. Empty folders: nothing is remembered, nothing autosaved.
void begin_session(Editor& editor, const std::filesystem::path& config, const std::filesystem::path& state);
// Everything that is due: results of threads, autosaves, changed files. `now_s` is any steadily growing
// clock. Returns in how many seconds to call again at the latest; `shown_changed` is set if something that is
// shown changed.
double tick_session(Editor& editor, double now_s, bool& shown_changed);
void store_preferences(Editor& editor);  // and writes them if they changed

void start_loading(Editor& editor, const std::filesystem::path& path);  // asks nothing; beside if wanted
void start_opening(Editor& editor, Loading loading,
                   std::function<Result<std::unique_ptr<Document>>(Progress&)> work);
void cancel_loading(Editor& editor);

// Reading the open level's files again (reload.cpp).
void reload_geometry(Editor& editor);  // beside if wanted, as one step; painted faces are found again
void watch_files(Editor& editor);      // from now on, as they are now: after opening and saving
bool look_at_files(Editor& editor);    // reads again what changed, unasked; true if something is shown
void finish_reload(Editor& editor, Loading loading);
void await_loading(Editor& editor);               // for a moment: small levels need no progress bar
void step_guessed(Editor& editor, bool forward);  // selects and frames the next face whose paint was guessed

// What sessions that ended left behind (recovery.cpp).
void request_recovery(Editor& editor, const AutosaveInfo& autosave);  // asks first about unsaved changes
void recover(Editor& editor, const AutosaveInfo& autosave);
void discard_autosave(Editor& editor, const AutosaveInfo& autosave);
void look_for_autosaves(Editor& editor);  // asks about all there are, or says that there are none
void offer_recovery(Editor& editor);      // asks about those of the open level
void document_is_safe(Editor& editor);    // after saving or throwing away: its autosaves are not needed

// The doctor.
void examine_level(Editor& editor);  // beside if wanted
bool report_is_current(const Editor& editor);
void go_to_problem(Editor& editor, std::size_t row);  // frames it and selects its faces
void go_to_position(Editor& editor, const Vec3& position);
// What can be done about it here, as a button's text; empty: nothing. All of it is paint, never geometry.
std::string fix_label(const Editor& editor, const Problem& problem);
void fix_problem(Editor& editor, const Problem& problem);

// The user interface.
void set_zoom(Editor& editor, double zoom);
void set_theme(Editor& editor, Theme theme);

}  // namespace slipface

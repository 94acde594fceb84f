// Background work of the editor: opening in a thread, autosaves, files that change on disk, the mesh doctor,
// and preferences.
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
#include "tools/commands/keymap.h"

namespace slipface {

struct Editor;

// Files of the open level were changed by another program while it has unsaved changes. Nothing is replaced
// until the user has answered; the question stays in view, and is dropped when the files are as before.
struct ChangedFiles {
    std::optional<LevelBase> level_file{};  // as it is on disk; nothing: the same as document.base()
    bool geometry = false;                  // in which not all paint is found exactly
    std::string question;
};
// keep_mine: the unsaved changes stay, and the next save replaces the file. take_theirs: the level becomes
// what the files are. merge: paint and named things that only one side changed are as that side made them;
// where both did, the unsaved changes win. The last two can be undone.
enum class ChangedAnswer { keep_mine, take_theirs, merge };

// A level that is being loaded. The document cannot be edited meanwhile.
struct Loading {
    enum class Kind { open, reload, recover } kind = Kind::open;
    std::filesystem::path path;
    AutosaveInfo autosave{};              // of a recovery
    bool unasked = false;                 // a reload because the file changed, not on the user's command
    std::optional<ChangedAnswer> then{};  // of a reload: the answer about the level file
    // One of the two: `opening` gives a new document, `rereading` new geometry for the open one (nothing: the
    // file's bytes have not changed).
    std::unique_ptr<Background<Result<Recovered>>> opening{};
    std::unique_ptr<Background<Result<std::optional<LoadedLevel>>>> rereading{};

    const Progress& progress() const { return opening ? opening->progress() : rereading->progress(); }
    bool ready() const { return opening ? opening->ready() : rereading->ready(); }
    void cancel() { opening ? opening->cancel() : rereading->cancel(); }
};

// A file of the open level that another program wrote and that cannot be read. It may still be incomplete, so
// it is tried again at every change, and reported only after broken_patience_s.
struct BrokenFile {
    std::filesystem::path file;
    std::string text;  // why
    double since_s = 0.0;
    bool reported = false;
};
inline constexpr double broken_patience_s = 4.0;

enum class Theme { dark, light };

struct Session {
    // True: opening, reloading and examining run in threads; a window sets it. False: the caller waits.
    bool beside = false;
    std::function<void()> wake;  // called from any thread: the window must run tick_session()
    // Where the levels that come with the program lie as they came; empty: where sample_levels() are.
    std::filesystem::path shipped_levels{};

    Preferences preferences;
    Keymap keymap;
    Theme theme = Theme::dark;
    double zoom = 1.0;                // of the user interface; multiplies the screen's own scale
    const char* rebinding = nullptr;  // id of the command whose new key is awaited
    bool help = false;                // the overlay of keys is shown
    int tour = -1;                    // the step in view; -1: no tour

    std::optional<Loading> loading;
    std::optional<ChangedFiles> changed;
    Recordings recordings;
    AutosaveSession autosave;
    std::vector<AutosaveInfo> left_behind;  // by sessions that ended; the welcome screen lists them
    // Those of left_behind that the recovery dialog is about; empty: no dialog.
    std::vector<AutosaveInfo> recoverable;
    std::optional<AutosaveInfo> recovered;  // the recovered autosave; deleted once its changes are saved
    std::size_t written_before = 0;         // the session's count of autosaves at the recovery
    FileWatch watch;
    double now_s = 0.0;        // of the last tick
    double next_look_s = 0.0;  // when the files are checked again
    std::optional<BrokenFile> broken;

    std::unique_ptr<Background<Result<DoctorReport>>> doctor;
    std::optional<DoctorReport> report;
    std::uint64_t report_revision = 0;           // the document's face revision that was examined
    unsigned hidden_kinds = 0;                   // bit k: problems of kind k are not listed
    std::optional<std::size_t> problem, orphan;  // the row that was clicked last
};

inline constexpr double smallest_zoom = 0.7, largest_zoom = 2.5;

// Reads preferences and finds autosaves that a crash left. With empty folders nothing is stored.
void begin_session(Editor& editor, const std::filesystem::path& config, const std::filesystem::path& state);
// Does everything that is due: results of threads, autosaves, changed files. `now_s` is any steadily growing
// clock. Returns after how many seconds to call again at the latest. Sets `shown_changed` if something
// visible changed.
double tick_session(Editor& editor, double now_s, bool& shown_changed);
void store_preferences(Editor& editor);  // writes the file if they changed

// Asks nothing; in a thread if session.beside.
void start_loading(Editor& editor, const std::filesystem::path& path);
void start_opening(Editor& editor, Loading loading, std::function<Result<Recovered>(Progress&)> work);
void cancel_loading(Editor& editor);

// Reading the open level's files again (reload.cpp).

// As one step, in a thread if session.beside; painted faces are found again.
void reload_geometry(Editor& editor);
void watch_files(Editor& editor);    // from their present state on: after opening and saving
bool look_at_files(Editor& editor);  // reads changed files again, unasked; true if something visible changed
void finish_reload(Editor& editor, Loading loading);
// Whether saving to the level file would replace what another program wrote there since it was read. Then the
// question is asked, unless there is nothing unsaved: then the file is taken over.
bool saving_must_wait(Editor& editor);
void answer_changed(Editor& editor, ChangedAnswer answer);  // does nothing without a question
void await_loading(Editor& editor);                   // waits for a moment: small levels need no progress bar
void go_to_guess(Editor& editor, std::size_t index);  // selects and frames that face of Document::guessed()
std::vector<FaceId> selected_guesses(const Document& document);  // ascending
// The guesses on all faces that are connected with a selected guess, ascending.
std::vector<FaceId> guesses_of_part(const Document& document);
// Accepts the guessed paint of `faces` (ascending), or removes it, and goes on to the next guess.
void settle_guesses(Editor& editor, const std::vector<FaceId>& faces, bool accept);
void step_guessed(Editor& editor, bool forward);  // selects and frames the next face whose paint was guessed

// What sessions that ended left behind (recovery.cpp).
void request_recovery(Editor& editor, const AutosaveInfo& autosave);  // asks first about unsaved changes
void recover(Editor& editor, const AutosaveInfo& autosave);
void discard_autosave(Editor& editor, const AutosaveInfo& autosave);
// Asks about all autosaves there are, or reports that there are none.
void look_for_autosaves(Editor& editor);
void offer_recovery(Editor& editor);    // asks about those of the open level that were not saved since
void list_left_behind(Editor& editor);  // for the welcome screen
// Lists what a merge had to decide, and which side it took: "yours", "as saved".
void report_conflicts(Editor& editor, const std::vector<FaceId>& faces,
                      const std::vector<std::string>& others, const std::string& taken);
void document_is_safe(Editor& editor);  // after saving or discarding: deletes its autosaves

// The doctor.
void examine_level(Editor& editor);  // in a thread if session.beside
void finish_examination(Editor& editor);
bool report_is_current(const Editor& editor);
void go_to_problem(Editor& editor, std::size_t row);  // frames it and selects its faces
void go_to_position(Editor& editor, const Vec3& position);
// The fix offered for a problem, as a button's text; empty: none. Fixes change paint, never geometry.
std::string fix_label(const Editor& editor, const Problem& problem);
void fix_problem(Editor& editor, const Problem& problem);

// The user interface.
void set_zoom(Editor& editor, double zoom);
void set_theme(Editor& editor, Theme theme);

}  // namespace slipface

// A search for all that the player can reach, beside the editor, and what it found.
#pragma once

#include <memory>
#include <optional>

#include "document/background.h"
#include "document/document.h"
#include "slipface/reach/report.h"

namespace slipface {

struct Editor;

enum class ReachView { time, unreached, traps, gained, lost };
inline constexpr std::array<const char*, 5> reach_view_names{"Time to reach", "Never reached", "No way back",
                                                             "Gained", "Lost"};
const char* meaning_of(ReachView view);

struct ReachSettings {
    double duration_s = 5.0;
    int seed = 1;
    bool follow = false;          // search again whenever what is walked on, or how, changes
    bool paths_by_click = false;  // a face that is selected shows its path
};

class ReachJob {
  public:
    // Copies what it needs of the document and begins at once. `wake` is called when it ends; `before` is
    // what is compared with, and may be null.
    static std::shared_ptr<ReachJob> start(const Document& document, const ReachSettings& settings,
                                           std::function<void()> wake, const ReachJob* before);

    // Searches on for the settings' duration, from where the search stood.
    bool can_go_on(const Document& document) const;
    void go_on(std::function<void()> wake);

    bool running() const { return work_ && !work_->ready(); }
    double progress() const { return work_->progress().fraction(); }
    void cancel();
    void settle();  // takes the result over once it is there; each frame
    // When it has ended: the report, or why there is none.
    const ReachReport* report() const { return report_ ? &*report_ : nullptr; }
    const std::string& problem() const { return problem_; }
    const std::optional<ReachDifference>& difference() const { return difference_; }
    // The level it ran in is the one that is open, unchanged in what decides where the player gets.
    bool fits(const Document& document) const;
    bool fits_goals(const Document& document) const { return level_->goals == document.level().goals; }

    const std::vector<FaceId>& faces_of(ReachView view) const;  // those that are listed; none for `time`
    // What a face is coloured by, 0..1; 0: not at all. The colours follow the root of the time. [face]
    const std::vector<float>& heat() const;
    double slowest_s() const { return slowest_s_; }
    // The way to a face: its time and tape; else how near the player came, in metres.
    struct Way {
        std::optional<double> time_s;
        double short_m = 0.0;
        Tape tape;
    };
    std::optional<Way> way_to(FaceId face) const;
    Tape exit_motion(std::size_t exit) const;  // of report()->exits

    ReachSettings settings;
    ReachView view = ReachView::time;
    bool show = true;
    std::optional<FaceId> opened;  // face whose way was opened last

  private:
    ReachJob() = default;

    std::shared_ptr<Level> level_;  // the work makes it begin where a player fits
    std::uint64_t face_revision_ = 0;
    std::vector<Spawn> spawns_;  // as they were; `level_` begins where a player fits
    std::optional<ReachReport> before_, report_;
    bool cancelled_ = false;
    std::optional<ReachDifference> difference_;
    std::optional<ReachSearch> search_;
    double slowest_s_ = 0.0;
    std::string problem_;
    mutable std::optional<ReachView> heat_view_;
    mutable std::vector<float> heat_;
    std::unique_ptr<Background<Result<ReachSearch>>> work_;
};

// The commands' and the panel's actions.
bool reach_can_start(const Editor& editor);
bool reach_runs(const Editor& editor);
bool has_reach(const Editor& editor);
bool can_show_path(const Editor& editor);
void run_reach(Editor& editor);  // goes on with the last search where nothing has changed since
void cancel_reach(Editor& editor);
void clear_reach(Editor& editor);
void show_path(Editor& editor);  // to the first of the selected faces
void open_way(Editor& editor, FaceId face);
void open_exit(Editor& editor, std::size_t exit);
void tick_reach(Editor& editor);  // takes results over, and begins anew where it follows the document

// Goals of the level; each change is one step of history.
void add_goal(Editor& editor);                      // on the face in the middle of the view
void move_goal(Editor& editor, std::size_t index);  // likewise
void change_goal(Editor& editor, std::size_t index, const Goal& goal);
void remove_goal(Editor& editor, std::size_t index);
std::string goal_name_problem(const Document& document, std::size_t index, const std::string& name);
// "dash=off glide=off", as for --set: a list, or the error of the first that is none.
Result<std::vector<std::string>> goal_settings(const std::string& text);
// "reached after 3.20 s", "not reached", "never, and reached after 2.10 s"; empty: not known.
std::string goal_state(const Editor& editor, std::size_t index);

}  // namespace slipface

// The review of a snapshot check: look at each result, go to its viewpoint, approve or reject it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "goldens/report.h"
#include "slipface/view/camera.h"

namespace slipface {

struct Editor;

enum class ReviewMode { side_by_side, swipe, blink, heat };
inline constexpr std::size_t review_mode_count = 4;
enum class ReviewMark { none, approved, rejected, skipped };

struct Review {
    std::filesystem::path report_file;
    Report report;
    std::vector<ActRow> acts;         // what was done, what changed most entries first
    std::vector<std::size_t> shown;   // entries that differ, below the first act that changed them
    std::vector<std::size_t> act_of;  // [shown] index into acts
    std::vector<ReviewMark> marks;    // [shown]
    std::size_t current = 0;          // index into shown
    ReviewMode mode = ReviewMode::side_by_side;
    double swipe = 0.5;    // fraction of the width that shows the expected image
    bool images = true;    // the view shows the images; false: the level
    double blink_s = 0.0;  // since blinking last swapped the images
    bool blink_actual = true;

    // Of the current entry; empty if the check wrote none.
    Image expected, actual, heat;
    std::uint64_t images_revision = 0;  // grows when they change
    std::optional<Camera> camera;       // the camera of the current entry

    const GoldenResult* entry() const {
        return current < shown.size() ? &report.entries[shown[current]] : nullptr;
    }
};

// Reads the report and shows its worst entry. On an error it shows a message and leaves an open review as it
// was.
void open_review(Editor& editor, const std::filesystem::path& report_file);
void close_review(Editor& editor);
void review_show(Editor& editor, std::size_t index);  // `index` into shown
void review_step(Editor& editor, int by);
// Approving makes the image the golden at once. Then shows the next entry.
void review_mark(Editor& editor, ReviewMark mark);
bool review_can_approve(const Editor& editor);
// Approves all that the act of the current entry changed.
void review_approve_act(Editor& editor);
// Opens the level of the current entry with the camera of the snapshot.
void review_go_to_camera(Editor& editor);
bool review_has_camera(const Editor& editor);

const char* review_mark_name(ReviewMark mark);  // "", "approved", ...

}  // namespace slipface

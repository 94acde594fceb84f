// Commands of reviewing snapshots.
#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"
#include "tools/review/review.h"

namespace slipface {
namespace {

constexpr const char* usual_report = "out/snapshots/report.json";

bool is_open(const Editor& editor) {
    return editor.review != nullptr;
}
bool shows_images(const Editor& editor) {
    return editor.review && editor.review->images;
}

}  // namespace

std::vector<Command> review_commands() {
    return {
        {"review.open", icons::eye, "Review snapshots", "View/Snapshots",
         "Review the findings of the last `slipface snapshot check`",
         "golden image picture difference (search words)", no_key(), command_actions::always, nullptr,
         [](Editor& editor) { open_review(editor, usual_report); }},
        {"review.next", "", "Next snapshot", "View/Snapshots", "Next difference", "forward", alt("PageDown"),
         is_open, nullptr, [](Editor& editor) { review_step(editor, 1); }},
        {"review.previous", "", "Previous snapshot", "View/Snapshots", "Previous difference", "back",
         alt("PageUp"), is_open, nullptr, [](Editor& editor) { review_step(editor, -1); }},
        {"review.approve", "", "Approve snapshot", "View/Snapshots",
         "Make this image the golden and go to the next", "accept golden", alt("A"), review_can_approve,
         nullptr, [](Editor& editor) { review_mark(editor, ReviewMark::approved); }},
        {"review.reject", "", "Reject snapshot", "View/Snapshots", "Reject it and go to the next",
         "wrong refuse", alt("R"), is_open, nullptr,
         [](Editor& editor) { review_mark(editor, ReviewMark::rejected); }},
        {"review.skip", "", "Skip snapshot", "View/Snapshots", "Decide later and go on", "later", alt("S"),
         is_open, nullptr, [](Editor& editor) { review_mark(editor, ReviewMark::skipped); }},
        {"review.camera", "", "Go to the snapshot's camera", "View/Snapshots",
         "Open its level with the snapshot's camera", "view place", alt("G"), review_has_camera, nullptr,
         review_go_to_camera},
        {"review.pictures", "", "Show pictures", "View/Snapshots",
         "Show the snapshot's images instead of the level", "compare", alt("P"), is_open, shows_images,
         [](Editor& editor) { editor.review->images ^= true; }},
        {"review.close", "", "Close review", "View/Snapshots", "Back to the level", "end", no_key(), is_open,
         nullptr, close_review},
    };
}

}  // namespace slipface

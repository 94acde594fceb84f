// What stopped the player, in a sentence.
#include <algorithm>
#include <array>

#include "stop_parts.h"
#include "story_words.h"

namespace slipface {

namespace {

struct CauseInfo {
    const char* name;
    const char* symptom;  // where no sentence below names another
};
// In the order of the enum.
constexpr std::array<CauseInfo, 17> causes{{
    {"wall", "Player sticks to walls"},
    {"back", "An invisible wall blocks the player"},
    {"step", "Player cannot climb stairs"},
    {"slope", "Player cannot walk up a slope"},
    {"overhead", "Player does not fit through a door"},
    {"gap", "Player is wedged between two walls"},
    {"corner", "Player gets stuck in a corner"},
    {"sticky", "Player hangs on a wall or ceiling and does not let go"},
    {"carried", "Belt, ice or trampoline carries the player off"},
    {"slippery", "Slope is too slippery to walk up"},
    {"platform", "Player is stopped or pushed off by a moving platform"},
    {"ladder end", "Player gets stuck at the top of a ladder"},
    {"inside", "Player spawns inside a wall and cannot move"},
    {"terrain", "Player cannot walk up a slope"},
    {"hazard", "Player is suddenly back at the start"},
    {"crushed", "Player is crushed by a platform"},
    {"fall", "Player falls out of the level"},
}};

}  // namespace

const char* stop_cause_name(StopCause cause) {
    return causes[static_cast<std::size_t>(cause)].name;
}

// A wall that took less of the motion was slid along.
constexpr double face_on = 0.97;
// Up to here an edge is a bump and no step, in metres.
constexpr double bump = 0.1;

void write_headline(Stop& stop, const MovementSettings& settings, const StoryNames& names) {
    const Loss& loss = stop.loss;
    stop.symptom = causes[static_cast<std::size_t>(loss.cause)].symptom;
    Words words(stop.headline, stop.numbers);
    const std::string what = thing_text(names, loss.face);
    // The feet stand a skin above the floor.
    const double height = loss.in_air ? loss.height_m : loss.height_m + settings.skin;
    const bool lifted = settings.step_up && settings.step_form == StepForm::every_move;
    const double lift = lifted ? settings.step_height : 0.0;
    const auto because = [&] {
        if (!loss.because) return;
        words.say(". ").decision(*loss.because);
    };
    switch (loss.cause) {
        case StopCause::wall:
            if (stop.lost_m < face_on * stop.wished_m) {
                words.say("You slid along ").say(what).say(": it took ");
                words.percent(stop.lost_m / stop.wished_m).say(" of the motion");
                break;
            }
            words.say("A wall of ").say(what).say(" stopped you");
            if (!loss.in_air && loss.top_m > 0.0 && loss.top_m < 2.0 * 2.0 * settings.radii.y()) {
                words.say(": ").size(loss.top_m).say(" high, ");
                if (settings.step_up)
                    words.say("Step height is ").size(settings.step_height);
                else
                    words.say("and Step up is off");
            }
            break;
        case StopCause::back:
            words.say("The back of ").say(what).say(" stopped you: it collides from both sides");
            break;
        case StopCause::step:
            if (loss.in_air) {
                words.say("The edge of ").say(what).say(" stopped you in the air, ");
                words.size(height).say(" above your feet");
                stop.symptom = "Jump is not high enough";
                break;
            }
            words.say("The ").size(loss.top_m > 0.0 ? loss.top_m : height).say(" edge of ").say(what);
            words.say(" stopped you");
            if (!settings.step_up) {
                words.say(": Step up is off");
                if (height < bump) stop.symptom = "Player stops at a tiny bump on the floor";
            } else if (std::max(height, loss.top_m) > settings.step_height) {
                words.say(": higher than Step height, ").size(settings.step_height);
                stop.symptom = "One step of the stairs is too high";
            } else {
                because();
            }
            break;
        case StopCause::slope:
            words.say("The slope of ").say(what).say(" stopped you");
            because();
            break;
        case StopCause::overhead:
            if (loss.because && loss.because->kind == Decision::step_up_no_room &&
                !(loss.clearance_m < 2.0 * settings.radii.y())) {
                words.say(what).say(" leaves no room to step up below it; you are ");
                words.size(2.0 * settings.radii.y()).say(" tall");
                stop.symptom = "Stairs under a low ceiling stop the player";
                break;
            }
            // A ceiling that slopes, or that is met on a ladder, leaves enough where it is touched first.
            if (loss.clearance_m > 0.0 && loss.clearance_m < 2.0 * settings.radii.y() + lift)
                words.say(what).say(" leaves ").size(loss.clearance_m).say(" of height");
            else
                words.say(what).say(" is too low: you touched it ").size(height).say(" above your feet");
            words.say("; you are ").size(2.0 * settings.radii.y()).say(" tall");
            if (lift > 0.0) words.say(", and each move is lifted by Step height, ").size(lift);
            break;
        case StopCause::gap:
            if (loss.top_m > 0.0 && loss.hole) {
                words.say("A hole before ").say(what).say(" stopped you: no ground between it and ");
                words.say(thing_text(names, loss.other)).say(", and it is ").size(loss.top_m).say(" higher");
                stop.symptom = "Gap is too wide to jump";
                break;
            }
            words.say("You are held between ").say(what).say(" and ").say(thing_text(names, loss.other));
            words.say(": you are ").size(2.0 * std::max(settings.radii.x(), settings.radii.z())).say(" wide");
            break;
        case StopCause::corner:
            words.say("The corner of ").say(what).say(" and ").say(thing_text(names, loss.other));
            words.say(" stopped you: the stick points into both");
            break;
        case StopCause::sticky: words.say("The sticky ").say(what).say(" holds you until you jump"); break;
        case StopCause::carried:
            words.say("The moving surface of ").say(what).say(" carried you against the stick");
            break;
        case StopCause::slippery:
            words.say("The slope of ").say(what).say(" is too slippery to walk up");
            if (loss.surface < names.surfaces.size())
                words.say(": friction ").ratio(names.surfaces[loss.surface].friction);
            break;
        case StopCause::platform: words.say("The moving platform ").say(what).say(" stopped you"); break;
        case StopCause::ladder_end:
            words.say("The ladder ends: the wall above it, ").say(what).say(", cannot be climbed");
            break;
        case StopCause::inside:
            if (loss.because) {
                words.decision(*loss.because);
            } else {
                words.say("You are inside geometry");
            }
            break;
        case StopCause::terrain:
            words.say("The terrain stopped you");
            because();
            break;
        case StopCause::hazard: words.say("The hazard ").say(what).say(" sent you back to the start"); break;
        case StopCause::crushed:
            words.say("Crushed between ").say(what).say(" and ").say(thing_text(names, loss.other));
            words.say(", back to the start");
            break;
        case StopCause::fall:
            if (stop.fall == FallCause::not_solid) {
                words.say("You fell through ").say(what).say(": its type is not solid");
                stop.symptom = "Player falls through the floor";
                break;
            }
            if (stop.fall == FallCause::one_sided) {
                words.say("You fell through ").say(what).say(": it holds from its front only");
                stop.symptom = "Player falls through the floor";
                break;
            }
            if (stop.fall == FallCause::cut_short) {
                words.say(what).say(" cut the jump short: without it you would have landed on ");
                words.say(thing_text(names, loss.other));
                stop.symptom = "Jump stops at something above";
                break;
            }
            if (stop.fall == FallCause::by_type) {
                words.say("You fell because of the type `");
                words.say(loss.surface < names.surfaces.size() ? names.surfaces[loss.surface].name : "");
                words.say("` of ").say(what).say(": on plain ground you would have stayed");
                stop.symptom = "Belt, ice or trampoline carries the player off";
                break;
            }
            if (stop.fall == FallCause::pushed) {
                words.say(what).say(" pushed you off ");
                words.say(thing_text(names, loss.other));
                stop.symptom = "Player is stopped or pushed off by a moving platform";
                break;
            }
            if (stop.fall == FallCause::too_short) {
                words.say("The jump from ").say(what);
                stop.symptom = stop.low_m > 0.0 ? "Jump is not high enough" : "Gap is too wide to jump";
                if (stop.low_m > 0.0)
                    words.say(" was ").size(stop.low_m).say(" too low for ");
                else
                    words.say(" fell ").size(stop.short_m).say(" short of ");
                words.say(thing_text(names, loss.other));
                break;
            }
            words.say("You fell out of the level");
            if (loss.face != no_id) words.say(", last from ").say(what);
            words.say(", back to the start");
            break;
    }
}

}  // namespace slipface

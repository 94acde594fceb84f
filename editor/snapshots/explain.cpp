#include "snapshots/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace slipface {

namespace {

constexpr std::size_t max_rays = 40'000;  // of more changed pixels only a fraction is examined
constexpr double same_position = 1e-6;    // metres

int delta(const std::uint8_t* a, const std::uint8_t* b) {
    int largest = 0;
    for (int c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(int{a[c]} - int{b[c]}));
    return largest;
}

std::vector<std::size_t> changed_pixels(const Image& a, const Image& b, int tolerance) {
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < a.pixel_count(); ++i)
        if (delta(a.rgba.data() + 4 * i, b.rgba.data() + 4 * i) > tolerance) pixels.push_back(i);
    return pixels;
}

// The face that the pixel shows, behind back faces if those are not drawn.
FaceId face_at(const SceneSide& side, const Scene& scene, std::size_t pixel) {
    const auto width = static_cast<std::size_t>(scene.width);
    const Vec2 pixel_center(static_cast<double>(pixel % width) + 0.5,
                            static_cast<double>(pixel / width) + 0.5);
    const Ray ray = pixel_ray(side.camera, pixel_center, {scene.width, scene.height});
    double from = 0.0;
    for (int layer = 0; layer < 64; ++layer) {
        const auto hit = cast_ray(side.staged->visible(), ray.origin + from * ray.direction, ray.direction);
        if (!hit) return no_id;
        if (scene.style.back_faces || !hit->back_face) return hit->face;
        from += hit->t + 1e-4;
    }
    return no_id;
}

// Pixels on which something is drawn over the level.
std::vector<bool> overlay_mask(const SceneComparison& comparison, const SceneSide& side) {
    if (side.story == nullptr || side.story->numbers.is_null()) return {};
    const Image with = comparison.draw(side, true), without = comparison.draw(side, false);
    std::vector<bool> mask(with.pixel_count(), false);
    if (with.rgba.size() != without.rgba.size()) return {};
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask[i] = delta(with.rgba.data() + 4 * i, without.rgba.data() + 4 * i) > 0;
    return mask;
}

// Numbers of changed pixels by the geometry that they show.
struct Tally {
    std::map<const FaceChange*, std::size_t> faces;
    std::size_t overlay = 0, rest = 0;
};

// What a changed pixel shows: an index into LevelChanges::list, or one of these.
constexpr std::int32_t unknown = -1, shows_overlay = -2, not_asked = -3;

std::int32_t shown_by(const SceneComparison& comparison, const LevelChanges& changes, std::size_t pixel) {
    if (changes.list.empty()) return unknown;
    const FaceChange* change = changes.after(face_at(comparison.after, comparison.scene, pixel));
    if (change == nullptr) change = changes.before(face_at(comparison.before, comparison.scene, pixel));
    return change == nullptr ? unknown : static_cast<std::int32_t>(change - changes.list.data());
}

// A pixel on an edge mixes the faces on both sides, but a ray through its centre hits only one of them.
std::int32_t shown_nearby(const std::vector<std::int32_t>& shown, const Scene& scene, std::size_t pixel) {
    constexpr int reach = 2;
    const int x = static_cast<int>(pixel) % scene.width, y = static_cast<int>(pixel) / scene.width;
    for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
            if (x + dx < 0 || y + dy < 0 || x + dx >= scene.width || y + dy >= scene.height) continue;
            const std::int32_t there = shown[static_cast<std::size_t>((y + dy) * scene.width + x + dx)];
            if (there != unknown && there != not_asked) return there;
        }
    }
    return unknown;
}

Tally count_pixels(const SceneComparison& comparison, const LevelChanges& changes,
                   const std::vector<std::size_t>& pixels) {
    const std::vector<bool> over_before = overlay_mask(comparison, comparison.before),
                            over_after = overlay_mask(comparison, comparison.after);
    const auto over = [](const std::vector<bool>& mask, std::size_t i) { return i < mask.size() && mask[i]; };
    const std::size_t stride = 1 + pixels.size() / max_rays;
    std::vector<std::int32_t> shown(comparison.request.expected.pixel_count(), not_asked);
    for (std::size_t k = 0; k < pixels.size(); k += stride) {
        std::int32_t& what = shown[pixels[k]];
        what = shown_by(comparison, changes, pixels[k]);
        if (what == unknown && (over(over_before, pixels[k]) || over(over_after, pixels[k])))
            what = shows_overlay;
    }
    Tally tally;
    for (std::size_t k = 0; k < pixels.size(); k += stride) {
        std::int32_t what = shown[pixels[k]];
        if (what == unknown) what = shown_nearby(shown, comparison.scene, pixels[k]);
        if (what >= 0)
            tally.faces[&changes.list[static_cast<std::size_t>(what)]] += stride;
        else
            (what == shows_overlay ? tally.overlay : tally.rest) += stride;
    }
    return tally;
}

// One sentence for all changes of one kind in one group.
void describe_faces(const SceneComparison& comparison, const LevelChanges& changes, const Tally& tally,
                    std::vector<Finding>& findings) {
    struct Group {
        std::size_t faces = 0, pixels = 0;
        double moved = 0.0;
        const FaceChange* first = nullptr;
    };
    std::map<std::pair<std::string, std::string>, Group> groups;
    for (const FaceChange& change : changes.list) {
        const auto seen = tally.faces.find(&change);
        const bool gone = change.after == no_id;
        const Mesh& mesh = *(gone ? comparison.before : comparison.after).staged->level.mesh;
        const std::string kind = change.kind == FaceChange::Kind::moved ? "moved" : change.text;
        Group& group = groups[{group_label(mesh, gone ? change.before : change.after), kind}];
        ++group.faces;
        group.moved = std::max(group.moved, change.moved);
        if (seen != tally.faces.end()) group.pixels += seen->second;
        if (group.first == nullptr || (seen != tally.faces.end() && !tally.faces.contains(group.first)))
            group.first = &change;
    }
    for (const auto& [key, group] : groups) {
        const FaceChange& change = *group.first;
        const FaceId face = change.after == no_id ? change.before : change.after;
        std::string what = change.kind == FaceChange::Kind::moved
                               ? fmt::format("a vertex moved {:.3g} m", group.moved)
                               : change.text;
        std::string text = group.faces == 1 ? fmt::format("face {} of {} {}", face, key.first, what)
                                            : fmt::format("{} faces of {} {} (face {} and others)",
                                                          group.faces, key.first, what, face);
        if (change.kind == FaceChange::Kind::moved)
            text = fmt::format("{} of {}: {}",
                               group.faces == 1
                                   ? fmt::format("face {}", face)
                                   : fmt::format("{} faces (face {} and others)", group.faces, face),
                               key.first, what);
        if (group.pixels == 0) text += ", out of sight";
        findings.push_back({Cause::level, group.pixels, text});
    }
}

// The faces that a tick touched: its ground, and those that redirected its remainder.
std::set<FaceId> faces_touched(const SceneSide& side, std::size_t tick) {
    const SceneMovement& story = *side.story;
    PlayerState state;
    state.position = story.start;
    if (tick > 0) state = story.states[tick - 1];
    std::set<FaceId> faces{state.ground_face};
    TraceRecorder trace;
    const StepResult end = step({side.staged->collision, side.staged->level.surfaces}, story.settings, state,
                                input_at(story.tape, tick), story.tape.dt, &trace);
    faces.insert(end.state.ground_face);
    for (const TraceRecord& record : trace.records)
        if (const auto* sweep = std::get_if<SweepRecord>(&record); sweep != nullptr && sweep->contact)
            faces.insert(sweep->contact->face);
    faces.erase(no_id);
    return faces;
}

std::string why_diverged(const SceneComparison& comparison, const LevelChanges& changes, std::size_t tick) {
    for (const FaceId face : faces_touched(comparison.before, tick)) {
        const FaceChange* change = changes.before(face);
        if (change == nullptr) continue;
        const Level& level = comparison.before.staged->level;
        const std::string label = face_label(*level.mesh, face);
        const SurfaceId was = resolve_surfaces(level).surface[face];
        if (change->kind == FaceChange::Kind::surface && !change->text.starts_with("are of type"))
            return fmt::format("because {} is no longer {}", label,
                               was < level.surfaces.size() ? level.surfaces[was].name : "default");
        return fmt::format("because {} {}", label, change->text);
    }
    for (const FaceId face : faces_touched(comparison.after, tick))
        if (const FaceChange* change = changes.after(face))
            return fmt::format("because {} {}", face_label(*comparison.after.staged->level.mesh, face),
                               change->text);
    std::string settings;
    for (const NumberDifference& number : comparison.request.numbers)
        if (number.path.starts_with("/movement/settings/") && number.decides)
            settings += fmt::format("{}{} is {} instead of {}", settings.empty() ? "because " : " and ",
                                    number.path.substr(19), number.actual, number.expected);
    if (!settings.empty()) return settings;
    for (const NumberDifference& number : comparison.request.numbers)
        if (number.path == "/movement/tape/inputs") return "because the tape's inputs changed";
    return changes.list.empty() ? "" : "although no face touched at that tick has changed";
}

// The text if the golden's level, settings and tape, simulated today, give today's path.
std::string same_path_text(const ExplainRequest& request, const LevelChanges& changes) {
    const auto differs = [&](std::string_view prefix) {
        return std::any_of(request.numbers.begin(), request.numbers.end(),
                           [&](const NumberDifference& number) {
                               return number.decides && number.path.starts_with(prefix);
                           });
    };
    if (differs("/movement/tape/samples") || differs("/movement/tape/end"))
        return changes.list.empty()
                   ? "trajectory differs though level, settings and tape are the same: the "
                     "movement code has changed"
                   : "trajectory differs, and not because of the level: the movement code has "
                     "changed";
    return "the path is the same, but the events on it differ";
}

// The golden's tape is simulated again in the golden's level. If the result differs from the golden's
// numbers, the movement code has changed.
void describe_movement(const SceneComparison& comparison, const LevelChanges& changes, std::size_t pixels,
                       std::vector<Finding>& findings) {
    const auto differs = [&](const char* path) {
        return std::any_of(comparison.request.numbers.begin(), comparison.request.numbers.end(),
                           [&](const NumberDifference& n) { return n.path.starts_with(path); });
    };
    const bool tape_differs = differs("/movement/tape"), probe_differs = differs("/movement/probe");
    if (!tape_differs && !probe_differs && pixels == 0) return;
    const SceneSide &before = comparison.before, &after = comparison.after;
    std::string text;
    if (tape_differs && before.story != nullptr && !before.story->states.empty() &&
        !after.story->states.empty()) {
        const auto& a = before.story->states;
        const auto& b = after.story->states;
        std::size_t tick = 0;
        while (tick < std::min(a.size(), b.size()) &&
               (a[tick].position - b[tick].position).norm() <= same_position)
            ++tick;
        if (tick < std::min(a.size(), b.size())) {
            const double apart = (a.back().position - b.back().position).norm();
            const std::string why = why_diverged(comparison, changes, tick);
            text = fmt::format("trajectory diverges at tick {} ({:.2f} s){}, and ends {:.3g} m away", tick,
                               static_cast<double>(tick) * after.story->tape.dt, why.empty() ? "" : " " + why,
                               apart);
        } else if (a.size() != b.size()) {
            text = fmt::format("the tape has {} ticks instead of {}", b.size(), a.size());
        } else {
            text = same_path_text(comparison.request, changes);
        }
    } else if (tape_differs) {
        text = "trajectory differs";
    }
    if (probe_differs) {
        const auto number =
            std::find_if(comparison.request.numbers.begin(), comparison.request.numbers.end(),
                         [](const NumberDifference& n) { return n.path.starts_with("/movement/probe"); });
        text += fmt::format("{}probe: {} was {}, is {}", text.empty() ? "" : "; ", number->path.substr(16),
                            number->expected, number->actual);
    }
    if (text.empty()) text = "what is drawn over the level";
    findings.push_back({Cause::movement, pixels, text});
}

const NumberDifference* first_number(const ExplainRequest& request, std::string_view prefix) {
    for (const NumberDifference& number : request.numbers)
        if (number.path.starts_with(prefix)) return &number;
    return nullptr;
}

std::string renderer_text(const ExplainRequest& request) {
    const NumberDifference* number = first_number(request, "/renderer");
    if (number == nullptr)
        return "drawing: the same renderer, so the drawing code or a texture's use has changed";
    return fmt::format("drawing: {} was {}, is {}", number->path.substr(10), number->expected,
                       number->actual);
}

// Explains the pixels that no face and no overlay explains.
void describe_rest(const ExplainRequest& request, std::size_t pixels, std::vector<Finding>& findings) {
    if (const NumberDifference* number = first_number(request, "/camera"))
        return findings.push_back({Cause::view, pixels,
                                   fmt::format("another view: {} was {}, is {}", number->path.substr(8),
                                               number->expected, number->actual)});
    if (const NumberDifference* number = first_number(request, "/image"))
        return findings.push_back({Cause::view, pixels,
                                   fmt::format("drawing style changed: {} was {}, is {}",
                                               number->path.substr(9), number->expected, number->actual)});
    if (const NumberDifference* number = first_number(request, "/level/textures"))
        return findings.push_back(
            {Cause::level, pixels, fmt::format("the texture {} has changed", number->path.substr(16))});
    if (pixels > 0) findings.push_back({Cause::renderer, pixels, renderer_text(request)});
}

}  // namespace

std::vector<Finding> explain_numbers(const ExplainRequest& request, std::size_t changed) {
    std::vector<Finding> findings;
    for (const Cause cause : {Cause::level, Cause::movement}) {
        const NumberDifference* first = nullptr;
        std::size_t count = 0;
        for (const NumberDifference& number : request.numbers) {
            if (number.cause != cause || !number.decides) continue;
            if (first == nullptr) first = &number;
            ++count;
        }
        if (first == nullptr) continue;
        std::string text =
            fmt::format("{} was {}, is {}", first->path.substr(1), first->expected, first->actual);
        if (count > 1) text += fmt::format(" ({} more numbers differ)", count - 1);
        findings.push_back({cause, 0, text});
    }
    describe_rest(request, findings.empty() ? changed : 0, findings);
    return findings;
}

std::vector<Finding> explain_scene(const SceneComparison& comparison) {
    const ExplainRequest& request = comparison.request;
    const std::vector<std::size_t> pixels =
        changed_pixels(request.expected, request.actual.image, request.tolerance.pixel_delta);
    if (comparison.before.staged == nullptr) return explain_numbers(request, pixels.size());
    const LevelChanges changes =
        compare_levels(comparison.before.staged->level, comparison.after.staged->level);
    const Tally tally = count_pixels(comparison, changes, pixels);
    std::vector<Finding> findings;
    describe_faces(comparison, changes, tally, findings);
    describe_movement(comparison, changes, tally.overlay, findings);
    describe_rest(request, tally.rest, findings);
    return findings;
}

}  // namespace slipface

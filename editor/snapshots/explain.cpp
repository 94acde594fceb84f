#include "snapshots/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "slipface/base/counted.h"
#include "slipface/base/text.h"

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
    const Image with = comparison.draw(side, true, true), without = comparison.draw(side, false, true);
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
        if (change.kind == FaceChange::Kind::parameters) continue;  // the type says it
        const auto seen = tally.faces.find(&change);
        const bool gone = change.after == no_id;
        const Mesh& mesh = *(gone ? comparison.before : comparison.after).staged->level.mesh;
        const std::string kind = change.kind == FaceChange::Kind::moved ? "moved" : change.text;
        const bool by_material = change.kind == FaceChange::Kind::material;  // of all groups in one sentence
        Group& group = groups[{
            by_material ? "the level" : group_label(mesh, gone ? change.before : change.after), kind}];
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
        const bool geometry =
            change.kind != FaceChange::Kind::material && change.kind != FaceChange::Kind::texture;
        if (group.pixels == 0 && geometry) text += ", out of sight";
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

const NumberDifference* first_number(const ExplainRequest& request, std::string_view prefix) {
    for (const NumberDifference& number : request.numbers)
        if (number.path.starts_with(prefix)) return &number;
    return nullptr;
}

bool differs(const ExplainRequest& request, std::string_view prefix) {
    return std::any_of(request.numbers.begin(), request.numbers.end(), [&](const NumberDifference& number) {
        return number.decides && number.path.starts_with(prefix);
    });
}

// "sun_color was 1, is 2; ..." of the differences below `prefix`, at most four.
std::string list_numbers(const ExplainRequest& request, std::string_view prefix) {
    constexpr std::size_t maximum = 4;
    std::string text;
    std::size_t count = 0;
    for (const NumberDifference& number : request.numbers) {
        if (!number.decides || !number.path.starts_with(prefix)) continue;
        if (++count <= maximum)
            text += fmt::format("{}{} was {}, is {}", text.empty() ? "" : "; ",
                                number.path.substr(prefix.size()), number.expected, number.actual);
    }
    if (count > maximum) text += fmt::format("; {} more", count - maximum);
    return text;
}

std::string why_diverged(const SceneComparison& comparison, const LevelChanges& changes, std::size_t tick) {
    for (const FaceId face : faces_touched(comparison.before, tick)) {
        const FaceChange* change = changes.before(face);
        if (change == nullptr || !change->affects_movement()) continue;
        const Level& level = comparison.before.staged->level;
        const std::string label = face_label(*level.mesh, face);
        const SurfaceId was = resolve_surfaces(level).surface[face];
        if (change->kind == FaceChange::Kind::surface)
            return fmt::format(" because {} is no longer {}", label,
                               was < level.surfaces.size() ? level.surfaces[was].name : "default");
        const bool is = change->kind == FaceChange::Kind::parameters;
        return fmt::format(" because {} {}{}", label, is ? "is " : "", change->text);
    }
    for (const FaceId face : faces_touched(comparison.after, tick))
        if (const FaceChange* change = changes.after(face); change != nullptr && change->affects_movement())
            return fmt::format(" because {} {}", face_label(*comparison.after.staged->level.mesh, face),
                               change->text);
    std::string settings;
    for (const NumberDifference& number : comparison.request.numbers)
        if (number.path.starts_with("/movement/settings/") && number.decides)
            settings += fmt::format("{}{} is {} instead of {}", settings.empty() ? " because " : " and ",
                                    number.path.substr(19), number.actual, number.expected);
    if (!settings.empty()) return settings;
    if (comparison.before.story->start != comparison.after.story->start)
        return " because the player starts elsewhere";
    return "";
}

// The first tick whose input differs, or nothing.
std::optional<std::size_t> first_other_input(const Tape& a, const Tape& b) {
    const std::size_t ticks = std::max(a.tick_count(), b.tick_count());
    for (std::size_t tick = 0; tick < ticks; ++tick) {
        const PlayerInput was = input_at(a, tick), is = input_at(b, tick);
        const bool there = (tick < a.tick_count()) == (tick < b.tick_count());
        if (!there || was.wish != is.wish || was.buttons != is.buttons) return tick;
    }
    return std::nullopt;
}

// What is different about the tape; empty: nothing that the numbers know.
std::string tape_text(const SceneComparison& comparison) {
    const ExplainRequest& request = comparison.request;
    const auto recorded = recorded_tape(Numbers::parse(request.expected_numbers, nullptr, false));
    if (!recorded || comparison.after.story == nullptr)
        return first_number(request, "/movement/tape/inputs") != nullptr ? "the tape has changed" : "";
    const Tape& tape = comparison.after.story->tape;
    const std::optional<std::size_t> tick = first_other_input(*recorded, tape);
    std::string text;
    if (tick) text = fmt::format(" from tick {}", *tick);
    if (recorded->tick_count() != tape.tick_count())
        text += fmt::format("{} it has {} ticks instead of {}", text.empty() ? ":" : ",", tape.tick_count(),
                            recorded->tick_count());
    if (recorded->start != tape.start) text += text.empty() ? ": another start" : ", and its start";
    if (recorded->dt != tape.dt) text += text.empty() ? ": another time step" : ", and its time step";
    if (recorded->settings != tape.settings || recorded->changes != tape.changes)
        text += text.empty() ? ": other settings" : ", and its settings";
    return text.empty() ? "" : "the tape has changed" + text;
}

// True if the golden's level, settings and tape give another path today than when it was approved.
bool movement_code_changed(const SceneComparison& comparison) {
    const SceneMovement* const story = comparison.before.story;
    const Numbers golden = Numbers::parse(comparison.request.expected_numbers, nullptr, false);
    if (story == nullptr || !golden.contains("movement")) return false;
    // The old level's probe ran with today's move, which says nothing if the golden's was another.
    if (first_number(comparison.request, "/movement/probe/from") != nullptr ||
        first_number(comparison.request, "/movement/probe/move") != nullptr)
        return false;
    const auto path_of = [](const Numbers& movement) {
        Numbers path = {{"version", 1}};
        for (const auto& [part, members] :
             {std::pair{"tape", std::vector{"samples", "end", "distance"}}, {"probe", {"end", "remainder"}}})
            for (const char* member : members)
                if (movement.contains(part) && movement[part].contains(member))
                    path["movement"][part][member] = movement[part][member];
        return path.dump();
    };
    const bool tape_known = !golden["movement"].contains("tape") || recorded_tape(golden) ||
                            first_number(comparison.request, "/movement/tape/inputs") == nullptr;
    const auto differences =
        compare_numbers(path_of(golden["movement"]), path_of(story->numbers), "the golden's path");
    return tape_known && differences && any_decides(*differences);
}

// Where the golden's tape, simulated again in the golden's level, and today's part.
std::string divergence_text(const SceneComparison& comparison, const LevelChanges& changes) {
    const SceneSide &before = comparison.before, &after = comparison.after;
    if (before.story == nullptr || before.story->states.empty() || after.story->states.empty())
        return "trajectory differs";
    const auto& a = before.story->states;
    const auto& b = after.story->states;
    std::size_t tick = 0;
    while (tick < std::min(a.size(), b.size()) &&
           (a[tick].position - b[tick].position).norm() <= same_position)
        ++tick;
    if (tick == std::min(a.size(), b.size()))
        return a.size() == b.size()
                   ? ""
                   : fmt::format("trajectory has {} ticks instead of {}", b.size(), a.size());
    const double apart = (a.back().position - b.back().position).norm();
    return fmt::format("trajectory diverges at tick {} ({:.2f} s){}, and ends {}", tick,
                       static_cast<double>(tick) * after.story->tape.dt,
                       why_diverged(comparison, changes, tick),
                       apart < 5e-4 ? "at the same position" : fmt::format("{:.3g} m away", apart));
}

// A difference in a face's number only, where that face is still the same one.
bool renumbered(const LevelChanges& changes, const NumberDifference& number) {
    if (!number.path.ends_with("/face")) return false;
    const std::optional<std::int64_t> was = parse_int(number.expected), is = parse_int(number.actual);
    return was && is && *was >= 0 && static_cast<std::size_t>(*was) < changes.partner.size() &&
           changes.partner[static_cast<std::size_t>(*was)] == static_cast<FaceId>(*is);
}

std::string probe_text(const ExplainRequest& request, const LevelChanges& changes) {
    for (const NumberDifference& number : request.numbers)
        if (number.decides && number.path.starts_with("/movement/probe") && !renumbered(changes, number))
            return fmt::format("probe: {} was {}, is {}", number.path.substr(16), number.expected,
                               number.actual);
    return "";
}

std::string spawn_text(const ExplainRequest& request) {
    const NumberDifference* const number = first_number(request, "/level/file/spawn/position");
    if (number == nullptr) return "";
    const auto point = [](const std::string& json) -> std::optional<Vec3> {
        const Numbers list = Numbers::parse(json, nullptr, false);
        if (!list.is_array() || list.size() != 3) return std::nullopt;
        return Vec3(list[0].get<double>(), list[1].get<double>(), list[2].get<double>());
    };
    const auto was = point(number->expected), is = point(number->actual);
    if (!was || !is) return "the spawn has changed";
    return fmt::format("the spawn moved {:.3g} m: it was at {}, is at {}", (*is - *was).norm(),
                       number->expected, number->actual);
}

// What differs in the level beside its faces.
void describe_level(const SceneComparison& comparison, const LevelChanges& changes, const Tally& tally,
                    std::vector<Finding>& findings) {
    const ExplainRequest& request = comparison.request;
    for (const TypeChange& type :
         type_changes(comparison.before.staged->level, comparison.after.staged->level)) {
        std::size_t faces = 0, pixels = 0;
        for (const FaceChange& change : changes.list) {
            if (change.kind != FaceChange::Kind::parameters ||
                change.text != fmt::format("of type {}, whose parameters changed", type.name))
                continue;
            ++faces;
            if (const auto seen = tally.faces.find(&change); seen != tally.faces.end())
                pixels += seen->second;
        }
        findings.push_back(
            {Cause::level, pixels,
             fmt::format("type `{}`, of {}: {}", type.name, counted(faces, "face"), type.text)});
    }
    if (const std::string spawn = spawn_text(request); !spawn.empty())
        findings.push_back({Cause::level, 0, spawn});
    std::set<std::string> keys;
    for (const NumberDifference& number : request.numbers) {
        constexpr std::string_view file = "/level/file/";
        if (!number.path.starts_with(file) || number.path.starts_with("/level/file/spawn/position")) continue;
        const std::string key =
            number.path.substr(file.size(), number.path.find('/', file.size()) - file.size());
        if (keys.insert(key).second)
            findings.push_back(
                {Cause::level, 0, "the level's " + list_numbers(request, std::string(file) + key)});
    }
    for (const NumberDifference& number : request.numbers)
        if (number.path.starts_with("/level/textures/"))
            findings.push_back(
                {Cause::level, 0, fmt::format("the texture {} has changed", number.path.substr(16))});
}

std::string renderer_text(const ExplainRequest& request) {
    const NumberDifference* number = first_number(request, "/renderer");
    if (number == nullptr)
        return "drawing: the same level, movement, view and renderer, so the drawing code has changed";
    return fmt::format("drawing: {} was {}, is {}", number->path.substr(10), number->expected,
                       number->actual);
}

// Empty: the camera and the style are the same.
std::string view_text(const ExplainRequest& request) {
    if (const NumberDifference* number = first_number(request, "/camera"))
        return fmt::format("another view: {} was {}, is {}", number->path.substr(8), number->expected,
                           number->actual);
    if (const NumberDifference* number = first_number(request, "/image"))
        return fmt::format("drawing style changed: {} was {}, is {}", number->path.substr(7),
                           number->expected, number->actual);
    return "";
}

// What the camera's position follows from, of what differs; empty: the view is a cause of its own.
std::string view_follows(const SceneComparison& comparison, bool movement_differs) {
    const auto* const name = std::get_if<std::string>(&comparison.scene.camera);
    if (name == nullptr) return "";
    if (movement_differs && (name->starts_with("tape:") || name->starts_with("contact:")))
        return "the movement";
    return name->starts_with("auto:") && differs(comparison.request, "/level/bounds") ? "the level's bounds"
                                                                                      : "";
}

// Pixels that no face explains: the first cause's, or the drawing code's if there is no other.
void describe_rest(const ExplainRequest& request, std::size_t pixels, std::vector<Finding>& findings) {
    if (!findings.empty()) {
        findings.front().pixels += pixels;
    } else if (pixels > 0) {
        findings.push_back({Cause::renderer, pixels, renderer_text(request)});
    }
}

// Pixels that differ only in baked light, which one side does not have because its geometry is another's.
std::size_t pixels_of_light(const SceneComparison& comparison, std::vector<std::size_t>& pixels) {
    const Image was = comparison.draw(comparison.before, true, false),
                is = comparison.draw(comparison.after, true, false);
    if (was.rgba.size() != comparison.request.expected.rgba.size() || is.rgba.size() != was.rgba.size())
        return 0;
    const std::size_t all = pixels.size();
    std::erase_if(pixels, [&](std::size_t i) {
        return delta(was.rgba.data() + 4 * i, is.rgba.data() + 4 * i) <=
               comparison.request.tolerance.pixel_delta;
    });
    return all - pixels.size();
}

}  // namespace

std::optional<Tape> recorded_tape(const Numbers& numbers) {
    const Numbers::json_pointer pointer("/movement/tape/lines");
    if (!numbers.is_object() || !numbers.contains(pointer)) return std::nullopt;
    std::string text;
    for (const Numbers& line : numbers[pointer])
        if (line.is_string()) text += line.get<std::string>() + "\n";
    Result<Tape> tape = parse_tape(text, "the golden's tape");
    return tape ? std::optional(*std::move(tape)) : std::nullopt;
}

std::vector<Finding> explain_numbers(const ExplainRequest& request, std::size_t changed) {
    std::vector<Finding> findings;
    for (const Cause cause : {Cause::level, Cause::movement}) {
        const std::string prefix = fmt::format("/{}/", cause_name(cause));
        if (differs(request, prefix))
            findings.push_back(
                {cause, 0, fmt::format("{}: {}", cause_name(cause), list_numbers(request, prefix))});
    }
    if (const std::string view = view_text(request); !view.empty())
        findings.push_back({Cause::view, 0, view});
    describe_rest(request, changed, findings);
    return findings;
}

std::vector<Finding> explain_scene(const SceneComparison& comparison) {
    const ExplainRequest& request = comparison.request;
    std::vector<std::size_t> pixels =
        changed_pixels(request.expected, request.actual.image, request.tolerance.pixel_delta);
    if (comparison.before.staged == nullptr) return explain_numbers(request, pixels.size());
    const bool light_dropped = first_number(request, "/level/light_drawn") != nullptr;
    const std::size_t light_pixels = light_dropped ? pixels_of_light(comparison, pixels) : 0;
    const LevelChanges changes =
        compare_levels(comparison.before.staged->level, comparison.after.staged->level);
    const Tally tally = count_pixels(comparison, changes, pixels);

    std::vector<Finding> findings;
    describe_faces(comparison, changes, tally, findings);
    describe_level(comparison, changes, tally, findings);
    std::stable_sort(findings.begin(), findings.end(),
                     [](const Finding& a, const Finding& b) { return a.pixels > b.pixels; });
    if (light_dropped)
        findings.push_back(
            {Cause::level, light_pixels,
             "the baked light is not drawn on both sides, because it was baked for other geometry; "
             "bake it again with \"slipface bake-light\""});
    if (const std::string settings = list_numbers(request, "/movement/settings/"); !settings.empty())
        findings.push_back({Cause::movement, 0, "settings: " + settings});
    if (const std::string tape = tape_text(comparison); !tape.empty())
        findings.push_back({Cause::movement, 0, tape});
    if (movement_code_changed(comparison))
        findings.push_back(
            {Cause::movement, 0,
             "the movement code has changed: the golden's level, settings and tape give another "
             "path today"});

    std::string moved;
    if (differs(request, "/movement/tape/samples") || differs(request, "/movement/tape/end") ||
        differs(request, "/movement/tape/ticks"))
        moved = divergence_text(comparison, changes);
    if (const std::string probe = probe_text(request, changes); !probe.empty())
        moved += (moved.empty() ? "" : "; ") + probe;
    if (moved.empty() && differs(request, "/movement/tape/events"))
        moved = "the path is the same, but the events on it differ";
    const std::string view = view_text(request);
    const std::string followed = view_follows(comparison, !moved.empty());
    if (!view.empty() && followed.empty()) findings.push_back({Cause::view, tally.rest, view});
    if (!moved.empty()) {
        findings.push_back({Cause::movement, tally.overlay, moved});
    } else if (tally.overlay > 0) {
        describe_rest(request, tally.overlay, findings);
    }
    if (!view.empty() && !followed.empty())
        findings.push_back({Cause::view, tally.rest, fmt::format("{}: it follows {}", view, followed)});
    if (view.empty()) describe_rest(request, tally.rest, findings);
    return findings;
}

}  // namespace slipface

#include "snapshots/scene_movement.h"

#include <fmt/format.h>

#include <algorithm>

#include "slipface/level/find_start.h"
#include "slipface/level/level_scene.h"
#include "slipface/render/trace_overlay.h"

namespace slipface {

namespace {

constexpr Color path_color{1.0f, 0.80f, 0.30f, 1.0f};
constexpr Color end_color{1.0f, 0.66f, 0.22f, 0.9f};
constexpr std::size_t max_samples = 33, max_events = 64, max_contacts = 12;

Error at_scene(const Scene& scene, const std::string& key, const Error& error) {
    return {scene.location + key, error.text()};
}

Status apply_all(MovementSettings& settings, const std::vector<std::string>& assignments, const Scene& scene,
                 const char* key) {
    for (std::size_t i = 0; i < assignments.size(); ++i) {
        if (Status status = set_setting(settings, assignments[i]); !status)
            return at_scene(scene, fmt::format("{}/{}", key, i), status.error());
    }
    return {};
}

std::string surface_name(const Level& level, SurfaceId surface) {
    return surface < level.surfaces.size() ? level.surfaces[surface].name : "default";
}

Numbers contact_json(const SweepRecord& sweep, const Level& level) {
    Numbers json;
    json["t"] = sweep.contact->t;
    json["surface"] = surface_name(level, sweep.contact->surface);
    json["feature"] = feature_name(sweep.contact->feature);
    json["point"] = json_of(sweep.contact->point);
    json["normal"] = json_of(sweep.contact->normal);
    return json;
}

// Keeps which decisions and types there were, and no record.
class Watcher final : public TraceSink {
  public:
    explicit Watcher(SceneMovement& story) : story_(story) {}
    void add(const TraceRecord& record) override {
        if (const auto* const decision = std::get_if<DecisionRecord>(&record))
            story_.acted.insert(decision->kind);
        if (const auto* const sweep = std::get_if<SweepRecord>(&record); sweep && sweep->contact)
            story_.touched.insert(sweep->contact->surface);
    }

  private:
    SceneMovement& story_;
};

Status run_probe(const Scene& scene, const StagedLevel& staged, SceneMovement& story) {
    MovementSettings& settings = story.settings;
    if (Status status = apply_all(settings, scene.probe->settings, scene, "/probe/settings"); !status)
        return status;
    if (scene.probe->radii) settings.radii = *scene.probe->radii;
    const Vec3 from = scene.probe->from.value_or(staged.level.spawn);
    TraceRecorder trace;
    const SlideResult end =
        slide_move({staged.collision, staged.level.surfaces}, settings, from, scene.probe->move, &trace);
    draw_trace(story.overlay, trace.records, settings.radii);
    Numbers contacts = Numbers::array();
    Watcher watcher(story);
    for (const TraceRecord& record : trace.records) {
        watcher.add(record);
        const auto* sweep = std::get_if<SweepRecord>(&record);
        if (sweep != nullptr && sweep->contact) contacts.push_back(contact_json(*sweep, staged.level));
    }
    story.numbers["probe"] = {{"from", json_of(from)},
                              {"move", json_of(scene.probe->move)},
                              {"end", json_of(end.position)},
                              {"remainder", json_of(end.remainder)},
                              {"contacts", contacts}};
    story.probe = std::move(trace.records);
    return {};
}

void draw_path(SceneMovement& story) {
    Vec3 previous = story.start;
    for (const PlayerState& state : story.states) {
        if (state.position != previous) story.overlay.line(previous, state.position, path_color, 2.5f);
        previous = state.position;
    }
    Color start_fill = trace_colors::start, end_fill = end_color;
    start_fill.alpha = 0.06f;
    end_fill.alpha = 0.20f;
    story.overlay.ellipsoid(story.start, story.settings.radii, start_fill, trace_colors::start);
    story.overlay.ellipsoid(
        previous, body_radii(story.settings, story.states.empty() ? PlayerState{} : story.states.back()),
        end_fill, end_color);
}

Numbers tape_json(const SceneMovement& story, const SimulationReport& report) {
    Numbers samples = Numbers::array();
    const std::size_t ticks = story.states.size();
    const std::size_t stride = std::max<std::size_t>(1, (ticks + max_samples - 2) / (max_samples - 1));
    for (std::size_t tick = 0; tick < ticks; tick += stride) {
        const Vec3& p = story.states[tick].position;
        samples.push_back(Numbers::array({tick, p.x(), p.y(), p.z()}));
    }
    Numbers events = Numbers::array();
    for (std::size_t i = 0; i < std::min(report.events.size(), max_events); ++i)
        events.push_back(
            Numbers::array({report.events[i].tick, report.events[i].kind, report.events[i].detail}));
    Numbers hashes = Numbers::array();
    for (const std::uint64_t hash : report.second_hashes)
        hashes.push_back(hex_text(hash));
    return {
        {"ticks", report.ticks}, {"distance", report.distance}, {"end", json_of(report.final_state.position)},
        {"events", events},      {"samples", samples},          {"hashes", hashes}};
}

Status run_tape(const Scene& scene, const StagedLevel& staged, SceneMovement& story) {
    if (scene.tape) {
        Result<Tape> tape = load_tape(*scene.tape);
        if (!tape) return at_scene(scene, "/tape", tape.error());
        story.tape = *std::move(tape);
    } else {
        story.tape = *staged.tape;
    }
    if (Status status = apply_tape_settings(story.settings, story.tape,
                                            (scene.tape ? scene.tape->string() : "the demo's tape"));
        !status)
        return at_scene(scene, "/tape", status.error());
    if (Status status = apply_all(story.settings, scene.settings, scene, "/settings"); !status) return status;
    Result<LevelScene> level_scene = LevelScene::borrow(staged.level, staged.collision, story.settings);
    if (!level_scene) return at_scene(scene, "/level", level_scene.error());
    if (story.tape.start) {
        story.start = *story.tape.start;
    } else {
        const Result<Start> start = find_start(staged.level, *level_scene, story.settings);
        if (!start) return at_scene(scene, "/level", start.error());
        story.start = start->position;
    }
    const TickScene ticks(*level_scene);
    Watcher watcher(story);
    SimulationReport report =
        simulate(ticks, story.settings, story.start, story.tape, {.keep_states = true, .trace = &watcher});
    story.states = std::move(report.states);
    for (PlayerState& state : story.states)
        state.position = ticks.to_level(state);
    if (!story.states.empty()) report.final_state.position = story.states.back().position;
    draw_path(story);
    story.numbers["tape"] = tape_json(story, report);
    return {};
}

}  // namespace

Result<SceneMovement> run_movement(const Scene& scene, const StagedLevel& staged) {
    SceneMovement story;
    const bool has_tape = scene.tape || staged.tape;
    if (!scene.probe && !has_tape) return story;
    story.settings = staged.level.movement;
    if (scene.probe) {
        if (Status status = run_probe(scene, staged, story); !status) return status.error();
    }
    if (has_tape) {
        if (Status status = run_tape(scene, staged, story); !status) return status.error();
    }
    return story;
}

std::vector<MovementContact> movement_contacts(const SceneMovement& story) {
    std::vector<MovementContact> contacts;
    for (const TraceRecord& record : story.probe) {
        const auto* sweep = std::get_if<SweepRecord>(&record);
        if (sweep == nullptr || !sweep->contact || contacts.size() >= max_contacts) continue;
        contacts.push_back({sweep->contact->point, sweep->contact->normal, sweep->contact->face});
    }
    bool held = false;
    SurfaceId surface = default_surface;
    for (const PlayerState& state : story.states) {
        const bool holds = is_held(state);
        const bool touched = holds && (!held || state.ground_surface != surface);
        held = holds;
        if (holds) surface = state.ground_surface;
        if (!touched || contacts.size() >= max_contacts) continue;
        const Vec3 feet = state.position - state.ground_normal * story.settings.radii.y();
        contacts.push_back({feet, state.ground_normal, state.ground_face});
    }
    return contacts;
}

}  // namespace slipface

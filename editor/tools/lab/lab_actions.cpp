#include "tools/lab/lab_actions.h"

#include <cmath>
#include <numbers>

#include "slipface/base/files.h"
#include "slipface/level/preset.h"
#include "slipface/sim/channels.h"
#include "tools/lab/audit_job.h"
#include "tools/lab/run_link.h"

namespace slipface {
namespace {

std::string seconds_text(double seconds) {
    const long tenths = std::lround(seconds * 10.0);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " s";
}

void report_problem(Editor& editor, const std::string& title, const Error& error) {
    editor.message = MessageDialog{title, error.text(), {}};
}

bool write_text(Editor& editor, const std::filesystem::path& path, const std::string& text) {
    const Status status = write_file_atomic(path, text);
    if (!status)
        editor.message = MessageDialog{.title = "Cannot save " + path.filename().string(),
                                       .text = status.error().text(),
                                       .details = {},
                                       .of_refused_write = true};
    else
        editor.status = "Saved " + path.filename().string();
    return status.ok();
}

void watch_tape(Editor& editor, const std::filesystem::path& path) {
    editor.lab.file = path;
    editor.lab.watch.start(path, path, true);
}

}  // namespace

void show_lab(Editor& editor) {
    editor.layout.show(PanelId::timeline);
    editor.layout.show(PanelId::why);
}

void complete_runs(Editor& editor) {
    while (editor.lab.has_tape() && !editor.lab.complete())
        editor.lab.frame(*editor.document, 0.0);
}

void take_playtest_tape(Editor& editor) {
    if (!editor.document || !editor.playtest) return;
    Tape tape = editor.playtest->tape();
    if (tape.tick_count() == 0) return;
    tape.end_hash = editor.playtest->hash();
    const double duration = static_cast<double>(tape.tick_count()) * tape.dt;
    if (const Status status = editor.lab.open(*editor.document, std::move(tape), "Playtest"); !status) {
        editor.status = "Not kept: " + status.error().message;
        return;
    }
    editor.lab.unsaved = true;
    if (editor.walked_on && editor.walked_on->level == editor.document->level().mesh_path)
        (void)editor.lab.add(*editor.document, std::move(editor.walked_on->tape), editor.walked_on->name);
    editor.walked_on.reset();
    complete_runs(editor);
    go_to_headline(editor);
    show_lab(editor);
    editor.status = "Recorded " + seconds_text(duration);
    const Status kept = editor.session.recordings.store(editor.document->level().mesh_path.stem().string(),
                                                        tape_to_text(editor.lab.sealed_tape()));
    if (!kept) editor.status += "; it will be lost at the end of this session: " + kept.error().text();
}

void open_tape(Editor& editor, const std::filesystem::path& path) {
    if (!editor.document) return;
    Result<Tape> tape = load_tape(path);
    const std::string title = "Cannot open " + path.filename().string();
    if (!tape) return report_problem(editor, title, tape.error());
    keep_edited_tape(editor);
    const Status status = editor.lab.open(*editor.document, std::move(*tape), path.filename().string());
    if (!status) return report_problem(editor, title, status.error());
    watch_tape(editor, path);
    show_lab(editor);
    editor.status = "Opened " + path.filename().string();
}

void add_tape(Editor& editor, const std::filesystem::path& path) {
    if (!editor.document) return;
    Result<Tape> tape = load_tape(path);
    const std::string name = path.filename().string();
    const Status status = tape ? editor.lab.add(*editor.document, std::move(*tape), name) : tape.error();
    if (!status) return report_problem(editor, "Cannot open " + name, status.error());
    show_lab(editor);
    editor.layout.show(PanelId::ghosts);
    editor.status = "Added " + name + " as a ghost";
}

void keep_edited_tape(Editor& editor) {
    if (!editor.document || !editor.lab.has_tape() || !editor.lab.unsaved || !editor.lab.edited()) return;
    complete_runs(editor);
    const Status kept = editor.session.recordings.store(editor.document->level().mesh_path.stem().string(),
                                                        tape_to_text(editor.lab.sealed_tape()));
    editor.status = kept ? "The changed tape is among the recordings (Lab > Open recording)"
                         : "The changed tape was not kept: " + kept.error().text();
}

bool look_at_tape_file(Editor& editor) {
    Lab& lab = editor.lab;
    if (!editor.document || !lab.has_tape() || lab.file.empty() || !lab.watch.poll()) return false;
    const std::string name = lab.file.filename().string();
    if (lab.unsaved) {
        editor.status = name + " has changed on disk; your changes stay. Lab > Open tape takes the file";
        return true;
    }
    Result<Tape> tape = load_tape(lab.file);
    const Status status = tape ? lab.edit(*editor.document, std::move(*tape)) : tape.error();
    if (status) lab.unsaved = false;
    watch_tape(editor, lab.file);
    editor.status = status ? "Read " + name + " again; can be undone"
                           : name + " has changed and cannot be read: " + status.error().text();
    return true;
}

void save_tape(Editor& editor, const std::filesystem::path& path) {
    if (!editor.lab.has_tape()) return;
    complete_runs(editor);
    if (!write_text(editor, path, tape_to_text(editor.lab.sealed_tape()))) return;
    editor.lab.unsaved = false;
    watch_tape(editor, path);
}

void save_run_csv(Editor& editor, const std::filesystem::path& path) {
    if (!editor.lab.has_tape() || !editor.document) return;
    complete_runs(editor);
    const LabRun& explained = editor.lab.runs()[editor.lab.explained()];
    write_text(editor, path, run_csv(explained.run, editor.document->level().surfaces));
}

void resume_from_cursor(Editor& editor) {
    if (!editor.document || !editor.lab.has_tape()) return;
    complete_runs(editor);
    const std::size_t tick = editor.lab.cursor();
    const TapeRun& run = editor.lab.runs().front().run;
    const TickScene scene = editor.lab.scene(*editor.document, editor.lab.runs().front());
    const PlayerState state = run.state_before(scene, tick);
    const std::uint64_t hash = run.hash_before(scene, tick);
    const MovementSettings settings = run.settings_at(tick == 0 ? 0 : tick - 1);
    const Tape whole = editor.lab.sealed_tape();
    Tape tape = cut_tape(whole, tick);
    const Vec3 heading = tick > 0 ? Vec3(run.samples()[tick - 1].velocity) : Vec3(Vec3::Zero());
    const bool moving = std::hypot(heading.x(), heading.z()) > 0.1;
    const double yaw = moving ? std::atan2(-heading.x(), -heading.z()) : editor.document->level().spawn_yaw;
    StoredTape old{editor.document->level().mesh_path, whole, "Before: " + editor.lab.name()};
    keep_edited_tape(editor);
    start_playtest(editor);
    if (!editor.playtest) return;
    editor.walked_on = std::move(old);
    if (tick > 0) editor.playtest->resume(tape, settings, state, run.samples()[tick - 1].position, hash, yaw);
    editor.status = "Recording again from tick " + std::to_string(tick);
}

Vec3 viewpoint(const CollisionWorld& world, const Vec3& position, const Vec3& normal, const Vec3& from_now,
               double distance) {
    Vec3 wanted = from_now - position;
    if (!(wanted.norm() > 1e-9) || !wanted.allFinite()) wanted = Vec3(0.5, 0.5, 0.7);
    wanted.normalize();
    const Vec3 begin = position + normal * 0.02;
    Vec3 best = position + wanted * distance;
    double best_free = -1.0;
    const double yaw_now = std::atan2(wanted.x(), wanted.z());
    const auto consider = [&](const Vec3& direction) {
        // The eye must be on the surface's outer side, and not nearly in its plane.
        if (!normal.isZero() && direction.dot(normal) < 0.15) return false;
        const std::optional<RayHit> hit = cast_ray(world, begin, direction * distance, 1.0);
        const double free = hit ? hit->t : 1.0;
        if (free > best_free) {
            best_free = free;
            best = begin + direction * distance * (hit ? 0.9 * free : 1.0);
        }
        return !hit;
    };
    if (consider(wanted)) return best;
    for (const double pitch : {0.45, 0.15, 0.9, -0.3, 1.3, -0.8}) {
        for (int i = 0; i < 12; ++i) {
            const double side = (i % 2 == 0 ? 1.0 : -1.0) * (i + 1) / 2;
            const double yaw = yaw_now + side * std::numbers::pi / 6.0;
            if (consider({std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch)}))
                return best;
        }
    }
    return best;
}

void look_at_story_line(Editor& editor, std::size_t index) {
    if (!editor.document || !editor.lab.has_tape()) return;
    const std::vector<StoryLine>& story = editor.lab.story(*editor.document);
    if (index >= story.size()) return;
    editor.lab.motion = LabMotion::paused;
    editor.lab.lit_line = index;
    const StoryLine& line = story[index];
    if (!line.position) return;
    const Vec3 eye =
        viewpoint(editor.document->collision(), *line.position, line.normal, editor.view.camera().eye, 3.2);
    editor.view.look_at(eye, *line.position);
}

void look_at_cursor(Editor& editor) {
    if (!editor.document || !editor.lab.has_tape()) return;
    const auto samples = editor.lab.runs()[editor.lab.explained()].run.samples();
    if (editor.lab.cursor() >= samples.size()) return;
    const Vec3 position = samples[editor.lab.cursor()].position;
    editor.view.look_at(
        viewpoint(editor.document->collision(), position, Vec3::Zero(), editor.view.camera().eye, 6.0),
        position);
}

void open_finding(Editor& editor, std::size_t index) {
    if (!editor.document || !editor.audit || !editor.audit->report()) return;
    const AuditReport& report = *editor.audit->report();
    if (index >= report.findings.size()) return;
    const AuditFinding& finding = report.findings[index];
    const std::string& name = finding.text;
    const Status status = editor.lab.open(*editor.document, editor.audit->tape_of(finding), name);
    if (!status) return report_problem(editor, "Cannot open the finding", status.error());
    editor.audit->opened = index;
    complete_runs(editor);
    // The state after tick n is the bad one: tick n - 1 causes it, and the tick before that is a good start.
    const std::size_t ticks = editor.lab.ticks();
    editor.lab.seek(ticks > 1 ? ticks - 2 : 0);
    show_lab(editor);
    look_at_cursor(editor);
    editor.status = name;
}

void use_preset(Editor& editor, const Preset& preset) {
    if (!editor.document) return;
    editor.document->set_movement(preset.settings, "Preset " + preset.name);
    editor.status = "Preset " + preset.name;
}

void apply_setting(Editor& editor, const std::string& assignment) {
    if (!editor.document) return;
    MovementSettings movement = editor.document->level().movement;
    if (set_setting(movement, assignment)) editor.document->set_movement(movement, "Set " + assignment);
}

namespace lab_actions {

bool can_use_tape(const Editor& editor) {
    return editor.document && editor.lab.has_tape() && !editor.playtest;
}
bool is_moving_forward(const Editor& editor) {
    return editor.lab.motion == LabMotion::forward;
}
bool is_moving_backward(const Editor& editor) {
    return editor.lab.motion == LabMotion::backward;
}
bool loops(const Editor& editor) {
    return editor.lab.loop;
}
bool can_pin(const Editor& editor) {
    return can_use_tape(editor) && editor.lab.runs().size() < Lab::max_runs;
}

void ask_open_tape(Editor& editor) {
    editor.file_dialog = FileDialogKind::open_tape;
}
bool has_recordings(const Editor& editor) {
    std::error_code error;
    return editor.document && editor.session.recordings.active() &&
           std::filesystem::exists(editor.session.recordings.folder(), error);
}
void ask_open_recording(Editor& editor) {
    editor.file_dialog = FileDialogKind::open_recording;
}
void ask_add_tape(Editor& editor) {
    editor.file_dialog = FileDialogKind::add_tape;
}
void ask_import_run(Editor& editor) {
    editor.file_dialog = FileDialogKind::import_run;
}
void ask_save_tape(Editor& editor) {
    editor.file_dialog = FileDialogKind::save_tape;
}
void ask_save_capsule(Editor& editor) {
    editor.file_dialog = FileDialogKind::save_capsule;
}
void ask_save_csv(Editor& editor) {
    editor.file_dialog = FileDialogKind::save_csv;
}
void close_tape(Editor& editor) {
    keep_edited_tape(editor);
    editor.lab.close();
    editor.imported = {};
}
void play(Editor& editor) {
    Lab& lab = editor.lab;
    const bool start = lab.motion != LabMotion::forward;
    if (start && lab.cursor() + 1 >= lab.ticks()) lab.seek(0);
    lab.motion = start ? LabMotion::forward : LabMotion::paused;
}
void reverse(Editor& editor) {
    Lab& lab = editor.lab;
    const bool start = lab.motion != LabMotion::backward;
    if (start && lab.cursor() == 0) lab.seek(lab.ticks());
    lab.motion = start ? LabMotion::backward : LabMotion::paused;
}
void step_forward(Editor& editor) {
    editor.lab.step(1);
}
void step_back(Editor& editor) {
    editor.lab.step(-1);
}
void to_start(Editor& editor) {
    editor.lab.seek(0);
}
void to_end(Editor& editor) {
    editor.lab.seek(editor.lab.ticks());
}
void next_event(Editor& editor) {
    editor.lab.next_event();
}
void previous_event(Editor& editor) {
    editor.lab.previous_event();
}
void toggle_loop(Editor& editor) {
    editor.lab.loop = !editor.lab.loop;
}
void pin_now(Editor& editor) {
    editor.lab.pin(editor.document->level().movement);
    editor.status = "Added these settings as a ghost";
}
void copy_tape(Editor& editor) {
    complete_runs(editor);
    editor.clipboard = tape_to_text(editor.lab.sealed_tape());
    editor.status = "Tape copied";
}
void copy_story(Editor& editor) {
    editor.clipboard = story_text(editor.lab.story(*editor.document));
    editor.status = "Story copied";
}
void copy_link(Editor& editor) {
    editor.clipboard = "#" + link_to_run(editor);
    editor.status = "Link copied. Save it as NAME.link: opens this run wherever the level is";
}

void copy_probe_command(Editor& editor) {
    const Level& level = editor.document->level();
    editor.clipboard = probe_command_line(editor.probe, level.movement, level.mesh_path.string());
    editor.status = "Command line copied";
}
void copy_probe_test(Editor& editor) {
    editor.clipboard = probe_test_text(editor.probe, *editor.document);
    editor.status = "Test copied: save it and run slipface sweep LEVEL --test FILE";
}
void toggle_reach(Editor& editor) {
    editor.lab.show_reach = !editor.lab.show_reach;
}
bool shows_reach(const Editor& editor) {
    return editor.lab.show_reach;
}
bool audit_runs(const Editor& editor) {
    return editor.audit && editor.audit->running();
}
bool audit_can_start(const Editor& editor) {
    return editor.document && !audit_runs(editor) && !editor.playtest;
}
bool has_audit(const Editor& editor) {
    return editor.audit && !editor.audit->running();
}
void run_audit_job(Editor& editor) {
    AuditSettings settings;
    if (editor.audit) settings = editor.audit->settings;
    editor.audit = AuditJob::start(*editor.document, settings);
    editor.layout.show(PanelId::audit);
}
void cancel_audit(Editor& editor) {
    editor.audit->cancel();
}
void clear_audit(Editor& editor) {
    editor.audit.reset();
}

}  // namespace lab_actions

}  // namespace slipface

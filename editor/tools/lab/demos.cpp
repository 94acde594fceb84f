// Opening the demo scene of a hack.
#include <algorithm>

#include "slipface/base/files.h"
#include "slipface/base/temporary_folder.h"
#include "slipface/scenes/demo.h"
#include "tools/lab/lab_actions.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_demo_bytes = 64u << 20;
constexpr int max_folders = 1000;

bool same_bytes(const fs::path& a, const fs::path& b) {
    const Result<std::string> first = read_file(a, max_demo_bytes), second = read_file(b, max_demo_bytes);
    return first && second && *first == *second;
}

// True if every file of `fresh` is also in `folder`, with the same bytes.
bool holds(const fs::path& folder, const fs::path& fresh) {
    std::error_code error;
    for (fs::directory_iterator it(fresh, error), end; !error && it != end; it.increment(error))
        if (!same_bytes(it->path(), folder / it->path().filename())) return false;
    return !error;
}

// Writes the demo's files into their own folder below the system's temporary folder. If the user saved over
// an earlier demo, that folder stays and the new files get another one. Returns the path of the OBJ.
Result<fs::path> demo_files(const DemoInfo& info) {
    const Result<TemporaryFolder> fresh = TemporaryFolder::make();
    if (!fresh) return fresh.error();
    const Result<fs::path> saved = save_demo(info, fresh->path());
    if (!saved) return saved;
    const fs::path base = fresh->path().parent_path() / "slipface-demos";
    std::error_code error;
    fs::create_directories(base, error);
    for (int i = 1; i <= max_folders; ++i) {
        const fs::path folder = base / (info.name + (i == 1 ? std::string() : "-" + std::to_string(i)));
        if (fs::exists(folder, error)) {
            if (!holds(folder, fresh->path())) continue;
            return folder / saved->filename();
        }
        fs::rename(fresh->path(), folder, error);
        if (!error) return folder / saved->filename();
    }
    return Error{base.string(), "holds too many demos; expected room for one more"};
}

// The paths of all runs fill the view, as far as they are in the level, seen from the direction of the demo's
// camera with its angle.
void fill_view(Editor& editor, const CameraBookmark& camera) {
    const Vec3 body = editor.document->level().movement.radii;
    const Aabb level = editor.document->collision().bounds();
    std::vector<Vec3> paths;
    for (const LabRun& run : editor.lab.runs())
        for (const TickSample& sample : run.run.samples())
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3 side((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                                (corner & 4) != 0 ? 1 : -1);
                paths.push_back((sample.position + side.cwiseProduct(body))
                                    .cwiseMax(level.min - body)
                                    .cwiseMin(level.max + 3.0 * body));
            }
    editor.view.fov_y = camera.fov_y;
    editor.view.yaw = 0.0;  // -Z upwards where the camera looks straight down
    editor.view.look_at(camera.eye, camera.target);
    frame_pane(editor, editor.panes.active, std::move(paths));
}

}  // namespace

void open_demo(Editor& editor, const DemoInfo& info) {
    leave_document(editor, {.then = UnsavedDialog::Then::demo, .open_path = {}, .demo = &info});
}

const DemoInfo* shown_demo(const Editor& editor) {
    if (!editor.document) return nullptr;
    const Level& level = editor.document->level();
    const DemoInfo* const named = find_demo(level.mesh_path.stem().string());
    // A level of the same name has another camera.
    const bool is_it = named && std::ranges::any_of(level.cameras, [&](const CameraBookmark& camera) {
                           return camera.name == named->title;
                       });
    return is_it ? named : nullptr;
}

void show_demo(Editor& editor, const DemoInfo& info) {
    const std::string title = std::string("Cannot open the demo ") + info.title;
    const Result<fs::path> saved = demo_files(info);
    Result<std::unique_ptr<Document>> opened =
        saved ? Document::open(*saved) : Result<std::unique_ptr<Document>>(saved.error());
    if (!opened) {
        editor.message = MessageDialog{title, opened.error().text(), {}};
        return;
    }
    adopt_document(editor, std::move(opened).value(), *saved);
    const Demo demo = make_demo(info);
    if (const Status status = editor.lab.open(*editor.document, demo.tape, info.title); !status) {
        editor.message = MessageDialog{title, status.error().text(), {}};
        return;
    }
    if (demo.off_tape.mover == demo.tape.mover) {
        editor.lab.pin(demo.off);
    } else if (const Status status = editor.lab.add(*editor.document, demo.off_tape, off_of(info)); !status) {
        editor.message = MessageDialog{title, status.error().text(), {}};
        return;
    }
    editor.lab.runs().front().name = "On";
    editor.lab.runs().back().name = "Off";
    complete_runs(editor);
    show_lab(editor);
    editor.layout.show(PanelId::card);
    fill_view(editor, demo.camera);
    editor.lab.seek(0);
    editor.lab.motion = LabMotion::forward;
    editor.status = sentences_of(info);
}

}  // namespace slipface

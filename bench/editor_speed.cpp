// slipface_editor_speed [SIDE [PART [ROUNDS [full]]]]: measures how long the editor takes to respond on a
// level of 2 SIDE^2 triangles (707: a million), each its own face. PART: only the actions whose name has it,
// in that many rounds. Processor time of the whole frame that shows the response, including uploads but not
// the drawing of the level. Before that, the wall and processor time of opening it, up to the first image;
// `full`: which is not a draft, as it is in the window.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>

#include "app/offscreen_host.h"
#include "tools/commands/commands.h"

namespace slipface {
namespace {

double cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double wall_ms() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

class Stopwatch {
  public:
    void print(const char* what) {
        fmt::print("{:<28} {:>9.0f} ms wall {:>9.0f} ms of processor time\n", what, wall_ms() - wall_,
                   cpu_ms() - cpu_);
        *this = {};
    }

  private:
    double wall_ = wall_ms(), cpu_ = cpu_ms();
};

// Gentle hills, so that flood fills by angle have a decision to make.
void write_hills(const std::filesystem::path& path, int side) {
    std::ofstream out(path);
    for (int i = 0; i <= side; ++i)
        for (int j = 0; j <= side; ++j)
            out << "v " << i << ' ' << 3.0 * std::sin(0.05 * i) * std::cos(0.07 * j) << ' ' << j << '\n';
    out << "usemtl ground\n";
    const auto vertex = [side](int i, int j) { return i * (side + 1) + j + 1; };
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            out << "f " << vertex(i, j) << ' ' << vertex(i, j + 1) << ' ' << vertex(i + 1, j + 1) << "\nf "
                << vertex(i, j) << ' ' << vertex(i + 1, j + 1) << ' ' << vertex(i + 1, j) << '\n';
}

class Bench {
  public:
    Bench(OffscreenHost& host, std::string part, int rounds)
        : host_(host), part_(std::move(part)), rounds_(rounds) {}

    // `prepare` and the frames that settle after it are not measured.
    void measure(const char* name, int times, const std::function<void(int)>& prepare,
                 const std::function<void(int)>& act) {
        if (std::string_view(name).find(part_) == std::string_view::npos) return;
        if (rounds_ > 0) times = rounds_;
        std::vector<double> took;
        for (int i = 0; i < times; ++i) {
            prepare(i);
            host_.settle(4);
            const double before = cpu_ms();
            act(i);
            host_.frame();
            took.push_back(cpu_ms() - before);
        }
        std::sort(took.begin(), took.end());
        fmt::print("{:<28} {:>9.2f} {:>9.2f}\n", name, took[took.size() / 2], took.back());
    }
    void command(const char* name, const char* id, const std::function<void(int)>& prepare, int times = 7) {
        measure(name, times, prepare, [&](int) {
            if (!run_command(host_.editor(), id)) fmt::print(stderr, "{} is not enabled\n", id);
        });
    }

  private:
    OffscreenHost& host_;
    std::string part_;
    int rounds_;  // 0: as many as each action has
};

int run(int side, const char* part, int rounds, bool drafts) {
    const std::filesystem::path obj =
        std::filesystem::temp_directory_path() / fmt::format("slipface_editor_speed_{}.obj", side);
    write_hills(obj, side);
    OffscreenOptions options;
    if (drafts) options.draft_from = 1;
    auto made = OffscreenHost::make(options);
    if (!made) {
        fmt::print(stderr, "{}\n", made.error().text());
        return EXIT_FAILURE;
    }
    OffscreenHost& host = **made;
    Editor& editor = host.editor();
    Stopwatch stopwatch;
    open_level(editor, obj);
    std::filesystem::remove(obj);
    if (!editor.document) return EXIT_FAILURE;
    stopwatch.print("open");
    host.settle();
    host.screenshot();
    stopwatch.print("upload and first image");
    if (host.draw_if_needed()) {
        host.screenshot();
        stopwatch.print("the same in full");
    }
    const double middle = 0.5 * side;
    editor.view.look_at({middle, 60, middle + 60}, {middle, 0, middle});
    host.settle();
    host.screenshot();
    stopwatch.print("an image from near by");
    fmt::print("{} faces\n{:<28} {:>9} {:>9}  ms of processor time\n", editor.document->mesh().face_count(),
               "", "median", "worst");
    Bench bench(host, part, rounds);
    const auto nothing = [](int) {};
    const auto mouse_at = [&](int i) { host.move_mouse({420.0f + 13.0f * static_cast<float>(i), 400.0f}); };
    const auto select_one = [&](int i) { editor.document->select({static_cast<FaceId>(1000 + 77 * i)}); };
    const auto select_none = [&](int) { editor.document->select({}); };
    const auto select_all = [&](int) { run_command(editor, "select.all"); };

    bench.measure("hover", 20, nothing, mouse_at);
    bench.measure("click: select a face", 20, mouse_at, [&](int) {
        host.mouse_button(0, true);
        host.frame();
        host.mouse_button(0, false);
    });
    editor.tool = Tool::fill;
    editor.fill_angle = 15.0 * std::numbers::pi / 180.0;
    bench.measure("hover, fill tool", 7, nothing, mouse_at);
    editor.tool = Tool::paint;
    editor.brush_radius = 4.0;
    bench.measure("hover, brush of 4 m", 20, nothing, mouse_at);
    host.move_mouse({420, 400});
    host.frame();
    host.mouse_button(0, true);
    bench.measure("stroke, brush of 4 m", 20, nothing, mouse_at);
    host.mouse_button(0, false);
    host.settle(4);
    bench.command("undo a stroke", "edit.undo", [&](int i) {
        if (i > 0) run_command(editor, "edit.redo");
    });
    editor.tool = Tool::select;
    bench.command("select all", "select.all", select_none);
    bench.command("undo select all", "edit.undo", select_all);
    bench.command("invert", "select.invert", select_one);
    bench.command("grow", "select.grow", select_all);
    bench.command("connected flat", "select.flat", select_one);
    bench.command("connected by angle", "select.smooth", select_one);
    bench.command("connected within material", "select.within_material", select_one);
    bench.command("same direction", "select.same_direction", select_one);
    bench.command("steeper than the limit", "select.steep", select_none);
    bench.command("paint all", "edit.fill_selection", [&](int i) {
        select_all(0);
        choose_brush(editor, static_cast<SurfaceId>(1 + i % 2));
    });
    bench.command("undo paint all", "edit.undo", [&](int i) {
        if (i > 0) run_command(editor, "edit.redo");
    });
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace slipface

int main(int count, char** arguments) {
    return slipface::run(count > 1 ? std::clamp(std::atoi(arguments[1]), 2, 3000) : 707,
                         count > 2 ? arguments[2] : "", count > 3 ? std::atoi(arguments[3]) : 0, count <= 4);
}

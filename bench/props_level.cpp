// slipface_props_level [INSTANCES [SEED]]: writes a level with that many instances of 20 meshes and measures
// what the program does with it: memory, opening, one change of one prop in the editor, saving, an audit
// (docs/performance-tables.md, "Props"). Processor time of all threads; whole frames without the drawing of
// the level.
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "app/offscreen_host.h"
#include "slipface/level/level_file.h"
#include "slipface/sim/audit.h"
#include "tools/commands/commands.h"
#include "tools/props/props.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

double cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// "VmHWM", the most memory so far, or "VmRSS", the memory now; MB.
double memory_mb(const std::string& kind) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(kind)) return std::atof(line.c_str() + kind.size() + 1) / 1024.0;
    return 0.0;
}

class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double uniform(double low, double high) {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return low + (high - low) * static_cast<double>(state_ >> 11) * 0x1p-53;
    }

  private:
    std::uint64_t state_;
};

void write_boulder(const fs::path& path, Random& random, int rows, int columns) {
    std::ofstream out(path);
    const double waves = std::round(random.uniform(2, 6)), deep = random.uniform(0.05, 0.3);
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const double up = 3.141592653589793 * row / rows - 1.5707963;
            const double around = 6.283185307179586 * column / columns;
            const double radius = 1.0 + deep * std::sin(waves * up) * std::cos(waves * around);
            out << fmt::format("v {:.5f} {:.5f} {:.5f}\n", radius * std::cos(up) * std::cos(around),
                               radius * std::sin(up), radius * std::cos(up) * std::sin(around));
        }
    out << "usemtl " << (rows % 2 == 0 ? "stone" : "moss") << "\n";
    const auto at = [&](int row, int column) { return row * columns + column % columns + 1; };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            out << "f " << at(row, column) << ' ' << at(row + 1, column) << ' ' << at(row + 1, column + 1)
                << ' ' << at(row, column + 1) << '\n';
}

// A floor, and props on it: turned, unevenly scaled, half of them mirrored.
fs::path write_level(const fs::path& folder, std::size_t instances, std::uint64_t seed) {
    fs::create_directories(folder / "props");
    Random random(seed);
    for (int i = 0; i < 20; ++i)
        write_boulder(folder / fmt::format("props/rock{:02}.obj", i), random, 8 + i, 16 + i);
    const double half = std::sqrt(10.0 * static_cast<double>(instances)) / 2 + 5;
    std::ofstream floor(folder / "field.obj");
    constexpr int side = 50;
    for (int i = 0; i <= side; ++i)
        for (int j = 0; j <= side; ++j)
            floor << "v " << half * (2.0 * i / side - 1) << " 0 " << half * (2.0 * j / side - 1) << '\n';
    floor << "usemtl ground\n";
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            floor << "f " << i * (side + 1) + j + 1 << ' ' << i * (side + 1) + j + 2 << ' '
                  << (i + 1) * (side + 1) + j + 2 << ' ' << (i + 1) * (side + 1) + j + 1 << '\n';
    floor.close();
    Level level;
    level.mesh_path = folder / "field.obj";
    level.file_path = folder / "field.slipface.json";
    level.spawn = Vec3(0, 4, 0);
    for (std::size_t i = 0; i < instances; ++i) {
        Prop prop;
        prop.name = "rock " + std::to_string(i + 1);
        prop.mesh = fmt::format("props/rock{:02}.obj", i % 20);
        prop.position =
            Vec3(random.uniform(-half, half), random.uniform(-0.5, 0.5), random.uniform(-half, half));
        if (prop.position.head<2>().norm() < 4) prop.position.x() += 8;
        for (int axis = 0; axis < 3; ++axis) {
            prop.rotation[axis] = random.uniform(-3, 3);
            prop.scale[axis] = random.uniform(0.4, 1.7) * (random.uniform(0, 1) < 0.2 ? -1 : 1);
        }
        if (i % 7 == 0) prop.type = "ice";
        level.props.push_back(prop);
    }
    if (const Status saved = save_level(level); !saved) fmt::print(stderr, "{}\n", saved.error().text());
    return level.file_path;
}

class Bench {
  public:
    explicit Bench(OffscreenHost& host) : host_(host) {}
    void measure(const char* name, const std::function<void(int)>& act) {
        std::vector<double> took, acts;
        for (int i = 0; i < 9; ++i) {
            host_.settle(4);
            const double before = cpu_ms();
            act(i);
            const double acted = cpu_ms();
            host_.frame();
            took.push_back(cpu_ms() - before);
            acts.push_back(acted - before);
        }
        std::sort(took.begin(), took.end());
        std::sort(acts.begin(), acts.end());
        fmt::print("{:<34} {:>9.2f} ms, worst {:>9.2f}; without the frame {:>9.2f}\n", name,
                   took[took.size() / 2], took.back(), acts[acts.size() / 2]);
        std::fflush(stdout);
    }

  private:
    OffscreenHost& host_;
};

template <class Act>
auto timed(const char* name, const Act& act) {
    const double before = cpu_ms();
    auto result = act();
    fmt::print("{:<34} {:>9.0f} ms {:>9.0f} MB now {:>9.0f} MB at most\n", name, cpu_ms() - before,
               memory_mb("VmRSS"), memory_mb("VmHWM"));
    std::fflush(stdout);
    return result;
}

int run(std::size_t instances, std::uint64_t seed) {
    const fs::path folder = fs::temp_directory_path() / fmt::format("slipface_props_level_{}", instances);
    const fs::path path = write_level(folder, instances, seed);
    fmt::print("{} instances of 20 meshes, at the start {:.0f} MB\n", instances, memory_mb("VmRSS"));
    {
        const Result<LoadedLevel> loaded = timed("read the level", [&] { return load_level(path); });
        if (!loaded) return fmt::print(stderr, "{}\n", loaded.error().text()), EXIT_FAILURE;
        AuditOptions options;
        options.walkers = 20;
        options.duration_s = 20;
        const auto audit = timed("audit of 24 000 steps", [&] { return run_audit(loaded->level, options); });
        if (!audit) return fmt::print(stderr, "{}\n", audit.error().text()), EXIT_FAILURE;
        fmt::print("  {} steps, hash {:016x}, {} passed through, {} overlaps\n", audit->steps, audit->hash,
                   audit->count(FindingKind::passed_through), audit->count(FindingKind::overlap));
    }
    auto made = OffscreenHost::make({});
    if (!made) return fmt::print(stderr, "{}\n", made.error().text()), EXIT_FAILURE;
    OffscreenHost& host = **made;
    Editor& editor = host.editor();
    timed("open in the editor", [&] {
        open_level(editor, path);
        host.settle();
        return 0;
    });
    if (!editor.document) return EXIT_FAILURE;
    editor.view.look_at({6, 6, 6}, {0, 0, 0});
    timed("draw one picture", [&] {
        host.frame();
        host.screenshot();
        return 0;
    });
    host.settle();
    Bench bench(host);
    bench.measure("a frame", [](int) {});
    bench.measure("hover", [&](int i) { host.move_mouse({420.0f + 13.0f * static_cast<float>(i), 400.0f}); });
    const auto prop = [&](int i) { return static_cast<std::size_t>(i) * instances / 11; };
    bench.measure("choose a prop", [&](int i) { choose_prop(editor, prop(i)); });
    editor.layout.show(PanelId::props);
    editor.tool = Tool::props;
    bench.measure("a frame with the panel", [](int) {});
    bench.measure("move a prop", [&](int i) {
        Prop to = editor.document->level().props[prop(i)];
        to.position.x() += 0.25;
        change_prop(editor, prop(i), to, "Move " + to.name);
    });
    bench.measure("undo", [&](int) { run_command(editor, "edit.undo"); });
    bench.measure("place a prop", [&](int i) { add_prop(editor, "props/rock03.obj", Vec3(i, 1, 2)); });
    bench.measure("duplicate a prop", [&](int i) { duplicate_prop(editor, prop(i)); });
    bench.measure("remove a prop", [&](int i) { remove_prop(editor, prop(i)); });
    bench.measure("paint a prop",
                  [&](int i) { paint_prop(editor, prop(i), static_cast<SurfaceId>(1 + i % 2)); });
    const Status saved = timed("save", [&] { return editor.document->save(); });
    if (!saved) fmt::print(stderr, "{}\n", saved.error().text());
    fs::remove_all(folder);
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace slipface

int main(int count, char** arguments) {
    const long instances = count > 1 ? std::strtol(arguments[1], nullptr, 10) : 10'000;
    const long seed = count > 2 ? std::strtol(arguments[2], nullptr, 10) : 1;
    return slipface::run(static_cast<std::size_t>(std::max(1L, instances)), static_cast<std::uint64_t>(seed));
}

// slipface_open_level [SIDE] [quads]: writes an OBJ of 2 * SIDE^2 triangles (707: a million), opens it as the
// editor does up to the first image, off-screen, then paints every face and saves. Prints a table: wall and
// processor seconds per stage, and peak memory. The time of assimp's parsing of the same file, in a separate
// process, shows how fast the machine is.
#include <assimp/scene.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <assimp/Importer.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "slipface/base/files.h"
#include "slipface/level/level_file.h"
#include "slipface/render/level_image.h"

namespace {

using namespace slipface;

struct Clock {
    double wall, processor;
    static Clock now() {
        rusage usage{};
        ::getrusage(RUSAGE_SELF, &usage);
        const auto seconds = [](const timeval& time) {
            return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
        };
        const auto wall = std::chrono::steady_clock::now().time_since_epoch();
        return {std::chrono::duration<double>(wall).count(),
                seconds(usage.ru_utime) + seconds(usage.ru_stime)};
    }
};

double peak_mb() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1000.0;
}

class Table {
  public:
    void row(const char* stage) {
        const Clock now = Clock::now();
        fmt::print("{:<34}{:>8.3f} s wall{:>9.3f} s processor{:>8.0f} MB peak\n", stage,
                   now.wall - last_.wall, now.processor - last_.processor, peak_mb());
        last_ = Clock::now();
    }

  private:
    Clock last_ = Clock::now();
};

void write_hills(const std::filesystem::path& path, int side, bool quads) {
    std::string text = "usemtl stone\n";
    for (int i = 0; i <= side; ++i)
        for (int j = 0; j <= side; ++j)
            text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", i * 0.5,
                                std::sin(i * 0.11) * std::cos(j * 0.07) * 3, j * 0.5);
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const int at = i * (side + 1) + j + 1;
            if (quads) {
                text += fmt::format("f {} {} {} {}\n", at, at + 1, at + side + 2, at + side + 1);
            } else {
                text += fmt::format("f {} {} {}\nf {} {} {}\n", at, at + 1, at + side + 2, at, at + side + 2,
                                    at + side + 1);
            }
        }
    }
    if (!write_file_atomic(path, text)) std::abort();
}

// In a separate process, so that its memory does not count here. Negative if it failed.
double assimp_s(const std::filesystem::path& obj) {
    int ends[2] = {-1, -1};
    if (::pipe(ends) != 0) return -1.0;
    const pid_t child = ::fork();
    if (child == 0) {
        const Clock start = Clock::now();
        Assimp::Importer importer;
        const bool read = importer.ReadFile(obj.string(), 0) != nullptr;
        const double seconds = read ? Clock::now().wall - start.wall : -1.0;
        ::_exit(::write(ends[1], &seconds, sizeof seconds) == sizeof seconds ? 0 : 1);
    }
    ::close(ends[1]);
    double seconds = -1.0;
    if (::read(ends[0], &seconds, sizeof seconds) != sizeof seconds) seconds = -1.0;
    ::close(ends[0]);
    if (child > 0) ::waitpid(child, nullptr, 0);
    return seconds;
}

int run(const std::filesystem::path& folder, int side, bool quads) {
    const std::filesystem::path obj = folder / "hills.obj";
    write_hills(obj, side, quads);
    fmt::print("{} MB of OBJ, {} triangles\n", std::filesystem::file_size(obj) / 1000000, 2 * side * side);
    Result<std::unique_ptr<OffscreenContext>> context = make_offscreen_context();
    if (!context) return fmt::print("{}\n", context.error().text()), 2;

    const double parsing = assimp_s(obj);
    fmt::print("{:<34}{:>8.3f} s wall, for scale\n", "assimp, nothing but parsing", parsing);
    Table table;
    const Clock start = Clock::now();
    Result<LoadedLevel> loaded = load_level(obj);
    if (!loaded) return fmt::print("{}\n", loaded.error().text()), 2;
    table.row("read, faces, triangles");
    Level& level = loaded->level;
    Result<CollisionWorld> world = build_collision_world(level);
    if (!world) return 2;
    table.row("BVH");
    const Aabb& bounds = level.mesh.bounds();
    Camera camera;
    camera.eye = bounds.max + Vec3(0, 50, 0);
    camera.target = (bounds.min + bounds.max) / 2;
    const Result<Image> image = render_level_image(**context, level, camera, 1280, 720, {});
    if (!image) return fmt::print("{}\n", image.error().text()), 2;
    table.row("upload and first picture");
    const Clock end = Clock::now();
    fmt::print("open to first picture: {:.3f} s wall, {:.3f} s processor; {:.1f} times assimp's parsing\n",
               end.wall - start.wall, end.processor - start.processor, (end.wall - start.wall) / parsing);
    const FaceNeighbours neighbours = face_neighbours(*level.mesh);
    table.row("neighbours (for the flood fill)");

    for (std::size_t face = 0; face < level.overrides.size(); ++face)
        level.overrides[face] = static_cast<SurfaceId>(1 + face % 3);
    table.row("(painting)");
    if (!save_level(level)) return 2;
    table.row("saving every face painted");
    fmt::print("level file: {:.1f} MB, {:.1f} bytes per face\n",
               static_cast<double>(std::filesystem::file_size(level.file_path)) / 1e6,
               static_cast<double>(std::filesystem::file_size(level.file_path)) /
                   static_cast<double>(level.mesh.face_count()));
    const Result<LoadedLevel> again = load_level(obj);
    if (!again) return fmt::print("{}\n", again.error().text()), 2;
    table.row("opening it again, painted");
    fmt::print("{}\n", again->match.text());
    // Unpainted faces that lie on painted ones are looked for.
    for (std::size_t face = 0; face < level.overrides.size(); face += 2)
        level.overrides[face].reset();
    if (!save_level(level)) return 2;
    table.row("saving every second face painted");
    return again->match.exact == level.mesh.face_count() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    const int side = argc > 1 ? std::atoi(argv[1]) : 707;
    if (side < 1 || side > 4000) return fmt::print("SIDE must be 1 to 4000\n"), 64;
    std::string folder = (std::filesystem::temp_directory_path() / "slipface-open-XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr) return 2;
    const int code = run(folder, side, argc > 2 && std::string_view(argv[2]) == "quads");
    std::filesystem::remove_all(folder);
    return code;
}

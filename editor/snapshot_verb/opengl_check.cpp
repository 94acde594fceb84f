// Tests whether images can be trusted on this machine: both backends, their pixels, and the gate.
#include "snapshot_verb/opengl_check.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>

#include "cli/exit_codes.h"
#include "process/process.h"
#include "slipface/base/files.h"
#include "slipface/base/temporary_folder.h"
#include "snapshot_verb/suite_set.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

// A level with hills, blocks and every kind of surface, so that its image contains all that renderers may
// round differently.
std::string yard_obj() {
    constexpr const char* types[] = {"default", "ice",      "ladder",    "sticky",
                                     "bouncy",  "conveyor", "turntable", "hazard"};
    std::string obj;
    int vertices = 0;
    const auto quad = [&](const char* material, std::initializer_list<Vec3> corners) {
        obj += fmt::format("usemtl {}\n", material);
        for (const Vec3& c : corners)
            obj += fmt::format("v {} {} {}\n", c.x(), c.y(), c.z());
        obj += fmt::format("f {} {} {} {}\n", vertices + 1, vertices + 2, vertices + 3, vertices + 4);
        vertices += 4;
    };
    const auto height = [](int x, int z) { return 0.13 * ((x * x * 7 + z * z * 5 + x * z * 3) % 11); };
    for (int z = -8; z < 8; ++z) {
        for (int x = -8; x < 8; ++x) {
            const std::string material = fmt::format("ground__{}", types[(x + 8) / 2 % 8]);
            quad(z % 4 == 0 ? material.c_str() : "ground",
                 {Vec3(x, height(x, z + 1), z + 1), Vec3(x + 1, height(x + 1, z + 1), z + 1),
                  Vec3(x + 1, height(x + 1, z), z), Vec3(x, height(x, z), z)});
        }
    }
    for (int i = 0; i < 6; ++i) {
        const double x = -7.0 + 2.5 * i, z = i % 2 == 0 ? -3.0 : 2.0, top = 1.5 + 0.4 * i;
        quad("wall", {Vec3(x, 0, z), Vec3(x + 1, 0, z), Vec3(x + 1, top, z), Vec3(x, top, z)});
        quad("wall",
             {Vec3(x + 1, 0, z), Vec3(x + 1, 0, z - 1), Vec3(x + 1, top, z - 1), Vec3(x + 1, top, z)});
        quad("roof", {Vec3(x, top, z), Vec3(x + 1, top, z), Vec3(x + 1, top, z - 1), Vec3(x, top, z - 1)});
    }
    return obj;
}

constexpr std::string_view yard_suite = R"({"version": 1, "scenes": [
  {"name": "yard", "level": "yard.obj", "size": [960, 540], "style": "plain overlay wireframe",
   "camera": {"eye": [7.5, 5.5, 10.5], "target": [-0.5, 0.4, -1], "fov_deg": 52},
   "probe": {"from": [-2, 2.6, 4], "move": [5, -1.5, -7]}}]})";

struct Exam {
    bool works = false;
    std::string text;  // the renderer, or the error
    std::optional<Image> first, second;
};

Exam examine(const std::string& gl, const fs::path& folder) {
    const fs::path part = folder / gl;
    std::error_code error;
    fs::create_directories(part, error);
    Exam exam;
    const Result<pid_t> process =
        start_process({.words = {"snapshot", "opengl", "--part", part.string(), "--gl", gl}, .out = 1});
    if (!process) {
        exam.text = process.error().text();
        return exam;
    }
    const int code = wait_for(*process);
    if (const Result<std::string> said = read_file(part / "renderer.txt")) exam.text = *said;
    if (code > 128) exam.text = ending_text(code);
    const Result<Image> first = load_image(part / "first.png"), second = load_image(part / "second.png");
    exam.works = code == 0 && first && second;
    if (exam.works) {
        exam.first = *first;
        exam.second = *second;
    }
    return exam;
}

bool report_line(bool good, const std::string& what, const std::string& details) {
    fmt::print("{:<5} {:<34} {}\n", good ? "ok" : "BAD", what, details);
    return good;
}

bool examine_environment() {
    for (const char* name : {"LP_NATIVE_VECTOR_WIDTH", "LP_NUM_THREADS", "GALLIUM_OVERRIDE_CPU_CAPS",
                             "GALLIVM_PERF", "GALLIUM_DRIVER", "MESA_GL_VERSION_OVERRIDE"}) {
        const char* value = std::getenv(name);
        if (value != nullptr) fmt::print("note  {}={}\n", name, value);
    }
    return true;
}

}  // namespace

int check_opengl_part(const std::string& folder) {
    const fs::path out = folder;
    const auto fail = [&](const Error& error) {
        (void)write_file_atomic(out / "renderer.txt", error.text()).ok();
        return cli::exit_bad_input;
    };
    Result<std::unique_ptr<OffscreenContext>> context = make_offscreen_context();
    if (!context) return fail(context.error());
    std::string text = renderer_line(**context);
    for (const Diagnostic& warning : (*context)->warnings())
        text += "; " + warning.text();
    if (Status status = write_file_atomic(out / "yard.obj", yard_obj()); !status) return fail(status.error());
    const auto scenes = parse_scene_suite(yard_suite, out / "yard.json");
    if (!scenes) return fail(scenes.error());
    for (const char* name : {"first.png", "second.png"}) {
        InputBook book(out);
        SceneStage stage(**context, book);  // a new stage, as another run would have
        const Result<Rendering> rendering = stage.render(scenes->front());
        if (!rendering) return fail(rendering.error());
        if (Status status = save_png(out / name, rendering->image); !status) return fail(status.error());
    }
    (void)write_file_atomic(out / "renderer.txt", text).ok();
    return cli::exit_fine;
}

namespace {

bool self_test_of(const std::string& name, const Image& image) {
    bool fine = true;
    for (const auto& [profile, tolerance] :
         {std::pair("scene", &scene_tolerance), std::pair("ui", &ui_tolerance)}) {
        const SelfTestReport test = run_self_test(image, *tolerance);
        fine &= report_line(test.passed, fmt::format("self-test of the gate, {}", profile),
                            fmt::format("{}, {} cases", name, test.lines.size()));
        for (const std::string& line : test.lines)
            fmt::print("        {}\n", line);
    }
    return fine;
}

}  // namespace

int check_opengl(const std::vector<std::string>& images) {
    const Result<TemporaryFolder> folder = TemporaryFolder::make();
    if (!folder) {
        fmt::print(stderr, "slipface: {}\n", folder.error().text());
        return cli::exit_bad_input;
    }
    examine_environment();
    const Exam osmesa = examine("osmesa", folder->path()), egl = examine("egl", folder->path());
    bool fine = report_line(osmesa.works || egl.works, "a renderer without a display", "");
    report_line(osmesa.works, "OSMesa", osmesa.text);
    report_line(egl.works, "EGL surfaceless", egl.text);
    for (const auto& [name, exam] :
         {std::pair("OSMesa twice: the same bytes", &osmesa), std::pair("EGL twice: the same bytes", &egl)})
        if (exam->works) fine &= report_line(exam->first == exam->second, name, "");
    if (osmesa.works && egl.works) {
        const bool equal = osmesa.first == egl.first;
        const Comparison comparison = compare_images(*osmesa.first, *egl.first, scene_tolerance);
        fine &= report_line(comparison.same, "OSMesa and EGL: the same pixels",
                            equal ? "identical" : comparison.verdict);
    }
    const Exam& used = osmesa.works ? osmesa : egl;
    if (used.works) fine &= self_test_of("a test scene", *used.first);
    for (const std::string& file : images) {
        const Result<Image> image = load_image(file);
        fine &= image ? self_test_of(file, *image) : report_line(false, file, image.error().text());
    }
    return fine ? cli::exit_fine : cli::exit_check_failed;
}

}  // namespace slipface

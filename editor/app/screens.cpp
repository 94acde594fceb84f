#include "app/screens.h"

#include <fmt/format.h>
#if defined(__x86_64__)
#include <cpuid.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "app/script.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"
#include "slipface/level/find_start.h"
#include "slipface/render/gl_graphics.h"
#include "slipface/world/geometric_manager.h"
#include "snapshots/scene_stage.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

struct ScreenHeader {
    std::string level;
    OffscreenOptions options;
    std::vector<MaskRect> masks;
};

std::optional<MaskRect> parse_mask(std::string_view text) {
    std::array<int, 4> numbers{};
    const auto words = split(text, ',');
    if (words.size() != numbers.size()) return std::nullopt;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::optional<std::int64_t> value = parse_int(trim(words[i]));
        if (!value || *value < 0 || *value > 16384) return std::nullopt;
        numbers[i] = static_cast<int>(*value);
    }
    return MaskRect{numbers[0], numbers[1], numbers[2], numbers[3]};
}

Result<ScreenHeader> read_header(std::string_view text, const std::string& location) {
    ScreenHeader header;
    int number = 0;
    for (const std::string_view raw : split(text, '\n')) {
        ++number;
        std::string_view line = trim(raw);
        if (!line.starts_with('#')) break;
        line = trim(line.substr(1));
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos) continue;
        const std::string_view key = line.substr(0, colon), value = trim(line.substr(colon + 1));
        const Error bad{location + ":" + std::to_string(number), "found \"" + std::string(value) + "\""};
        if (key == "level") {
            header.level = value;
        } else if (key == "size") {
            const auto size = parse_size(value);
            if (!size) return Error{bad.location, bad.message + ", expected a size such as 1280x720"};
            header.options.width = size->first;
            header.options.height = size->second;
        } else if (key == "scale") {
            const std::optional<double> scale = parse_double(value);
            if (!scale) return Error{bad.location, bad.message + ", expected a scale such as 1 or 1.5"};
            header.options.scale = static_cast<float>(*scale);
        } else if (key == "mask") {
            const auto mask = parse_mask(value);
            if (!mask) return Error{bad.location, bad.message + ", expected a mask such as 10,20,300,40"};
            header.masks.push_back(*mask);
        }
    }
    return header;
}

// What a script is made from: its lines without comments and the files that they name.
struct ScriptInputs {
    InputBook::Named named;
    nlohmann::ordered_json row;
};

ScriptInputs script_inputs(std::string_view text, const ScreenHeader& header, const fs::path& project,
                           InputBook& book) {
    ScriptInputs found;
    found.row = {{"kind", "row"},
                 {"size", {header.options.width, header.options.height}},
                 {"scale", header.options.scale}};
    found.row["masks"] = nlohmann::ordered_json::array();
    for (const MaskRect& mask : header.masks)
        found.row["masks"].push_back({mask.x, mask.y, mask.width, mask.height});
    found.row["script"] = nlohmann::ordered_json::array();
    book.add_named(header.level, project, found.named, found.row);
    for (const std::string_view raw : split(text, '\n')) {
        const std::string_view line = trim(raw);
        if (line.empty() || line.starts_with('#')) continue;
        found.row["script"].push_back(nlohmann::ordered_json::array({std::string(line)}));
        book.add_named(line, project, found.named, found.row);
    }
    return found;
}

// Dear ImGui's edges come of an approximate square root (rsqrtss), whose last bits each model of processor
// has of its own. "6.207": family and model; empty where it is not known.
std::string processor_model() {
#if defined(__x86_64__)
    unsigned about = 0, ignored = 0;
    if (__get_cpuid(1, &about, &ignored, &ignored, &ignored) != 0)
        return fmt::format("{}.{}", (about >> 8 & 0xf) + (about >> 20 & 0xff),
                           (about >> 4 & 0xf) + (about >> 12 & 0xf0));
#endif
    return "";
}

// The script, the visible widgets, and the renderer.
std::string screen_numbers(const OffscreenHost& host, const ScriptInputs& script, InputBook& book) {
    nlohmann::ordered_json numbers;
    numbers["version"] = 2;
    numbers["row"] = script.row;
    nlohmann::ordered_json widgets = nlohmann::ordered_json::object();
    for (const auto& [path, widget] : ui::widgets()) {
        const auto pixel = [](float value) { return static_cast<int>(std::lround(value)); };
        if (!widget.visible) continue;
        widgets[path] = {pixel(widget.min.x), pixel(widget.min.y), pixel(widget.max.x - widget.min.x),
                         pixel(widget.max.y - widget.min.y)};
    }
    numbers["widgets"] = widgets;
    numbers["inputs"] = nlohmann::ordered_json::parse(inputs_json(script.named.inputs, book));
    numbers["renderer"] = nlohmann::ordered_json::parse(renderer_fingerprint(host.context()));
    numbers["renderer"]["model"] = processor_model();
    numbers["renderer"]["interface"] = ui::interface_release();
    return numbers_to_text(numbers.dump());
}

Result<Rendering> render_screen(const fs::path& script, const fs::path& project, InputBook& book) {
    const std::string location = script.filename().string();
    const Result<std::string> text = read_file(script, 1u << 20);
    if (!text) return text.error();
    Result<ScreenHeader> header = read_header(*text, location);
    if (!header) return header.error();
    header->options.hidden_folder = (project / "").string();
    Result<std::unique_ptr<OffscreenHost>> host = OffscreenHost::make(header->options);
    if (!host) return host.error();
    if (!header->level.empty()) {
        open_level((*host)->editor(), project / header->level);
        (*host)->frame();
        if ((*host)->editor().message) return Error{location, (*host)->editor().message->text};
    }
    const ScriptResult result = run_script(**host, *text, location, project);
    if (!result) return result.error;
    Image image = (*host)->screenshot();
    return Rendering{std::move(image),
                     screen_numbers(**host, script_inputs(*text, *header, project, book), book)};
}

}  // namespace

std::vector<Snapshot> screen_snapshots(const fs::path& folder, InputBook& book) {
    std::error_code error;
    const fs::path absolute = fs::weakly_canonical(folder, error);
    const fs::path project = absolute.parent_path().parent_path();
    std::vector<fs::path> scripts;
    for (fs::directory_iterator it(absolute, error), end; !error && it != end; it.increment(error))
        if (it->path().extension() == ".script") scripts.push_back(it->path());
    std::sort(scripts.begin(), scripts.end());
    std::vector<Snapshot> snapshots;
    for (const fs::path& script : scripts) {
        Snapshot snapshot{"editor/" + script.stem().string(), ui_tolerance,
                          [script, project, &book] { return render_screen(script, project, book); }};
        snapshot.elsewhere = ui_elsewhere;
        const Result<std::string> text = read_file(script, 1u << 20);
        if (const auto header = text ? read_header(*text, script.filename().string()) : text.error()) {
            snapshot.masks = header->masks;
            const InputBook::Named named = script_inputs(*text, *header, project, book).named;
            snapshot.inputs.assign(named.inputs.begin(), named.inputs.end());
        }
        snapshot.input = [&book](const std::string& name) { return book.read(name); };
        snapshots.push_back(std::move(snapshot));
    }
    return snapshots;
}

std::optional<std::pair<int, int>> parse_size(std::string_view text) {
    const std::size_t x = text.find('x');
    if (x == std::string_view::npos) return std::nullopt;
    const std::optional<std::int64_t> width = parse_int(text.substr(0, x)),
                                      height = parse_int(text.substr(x + 1));
    if (!width || !height || *width < 1 || *height < 1 || *width > 16384 || *height > 16384)
        return std::nullopt;
    return std::pair{static_cast<int>(*width), static_cast<int>(*height)};
}

namespace {

constexpr int game_width = 1280, game_height = 720;

// The open level as a game draws it, from the editor's viewpoint.
Result<Image> game_image(const GlTable& gl, const Editor& editor) {
    Result<std::unique_ptr<GeometricManager>> made = GeometricManager::make(editor.document->snapshot());
    if (!made) return made.error();
    World world;
    auto& geometry = static_cast<GeometricManager&>(world.add_manager(std::move(*made)));
    auto& player = world.make_entity<Character>();
    player.settings = geometry.level().movement;
    const TickScene scene = editor.lab.scene(*editor.document);
    const Result<Start> start =
        find_start(geometry.level(), scene.at(0, 0.0), scene.offset(), player.settings);
    player.state = geometry.player_at(start ? start->position : geometry.level().spawn);

    Framebuffer target(gl, game_width, game_height);
    GlGraphics graphics(gl);
    graphics.style = editor.style;
    target.bind();
    graphics.begin_frame(editor.view.camera(), target.width(), target.height());
    world.draw(graphics);
    if (Status drawn = graphics.end_frame(); !drawn) return drawn.error();
    return target.read();
}

}  // namespace

Status write_images(const fs::path& level, const fs::path& editor_png, const fs::path& level_png) {
    OffscreenOptions options;
    options.width = 1440;
    options.height = 900;
    Result<std::unique_ptr<OffscreenHost>> host = OffscreenHost::make(options);
    if (!host) return host.error();
    Editor& editor = (*host)->editor();
    if (!level.empty()) open_level(editor, level);
    if (editor.message) return Error{"", editor.message->text};
    (*host)->settle();
    if (const Status status = save_png(editor_png, (*host)->screenshot()); !status) return status;
    if (!editor.document) return {};
    fit_framed_pane(editor, editor.panes.active, 1.0 * game_width / game_height);
    const Result<Image> image = game_image((*host)->context().gl(), editor);
    return image ? save_png(level_png, *image) : image.error();
}

}  // namespace slipface

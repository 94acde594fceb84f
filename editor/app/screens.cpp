#include "app/screens.h"

#include <algorithm>
#include <system_error>

#include "app/script.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

struct ScreenHeader {
    std::string level;
    OffscreenOptions options;
};

Result<ScreenHeader> read_header(std::string_view text, const std::string& place) {
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
        const Error bad{place + ":" + std::to_string(number), "found \"" + std::string(value) + "\""};
        if (key == "level") {
            header.level = value;
        } else if (key == "size") {
            const auto size = parse_size(value);
            if (!size) return Error{bad.place, bad.message + ", expected a size such as 1280x720"};
            header.options.width = size->first;
            header.options.height = size->second;
        } else if (key == "scale") {
            const std::optional<double> scale = parse_double(value);
            if (!scale) return Error{bad.place, bad.message + ", expected a scale such as 1 or 1.5"};
            header.options.scale = static_cast<float>(*scale);
        }
    }
    return header;
}

Result<Image> render_screen(const fs::path& script, const fs::path& project) {
    const std::string place = script.filename().string();
    const Result<std::string> text = read_file(script, 1u << 20);
    if (!text) return text.error();
    Result<ScreenHeader> header = read_header(*text, place);
    if (!header) return header.error();
    header->options.hidden_folder = (project / "").string();
    Result<std::unique_ptr<OffscreenHost>> host = OffscreenHost::make(header->options);
    if (!host) return host.error();
    if (!header->level.empty()) {
        open_level((*host)->editor(), project / header->level);
        (*host)->frame();
        if ((*host)->editor().message) return Error{place, (*host)->editor().message->text};
    }
    const ScriptResult result = run_script(**host, *text, place, project);
    if (!result) return result.error;
    return (*host)->screenshot();
}

}  // namespace

std::vector<Snapshot> screen_snapshots(const fs::path& folder) {
    std::error_code error;
    const fs::path absolute = fs::weakly_canonical(folder, error);
    const fs::path project = absolute.parent_path().parent_path();
    std::vector<fs::path> scripts;
    for (fs::directory_iterator it(absolute, error), end; !error && it != end; it.increment(error))
        if (it->path().extension() == ".script") scripts.push_back(it->path());
    std::sort(scripts.begin(), scripts.end());
    std::vector<Snapshot> snapshots;
    for (const fs::path& script : scripts)
        snapshots.push_back({"editor/" + script.stem().string(), ui_tolerance,
                             [script, project] { return render_screen(script, project); }});
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

Status write_pictures(const fs::path& level, const fs::path& editor_png, const fs::path& level_png) {
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
    return save_png(level_png, (*host)->level_picture());
}

}  // namespace slipface

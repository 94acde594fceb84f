#include "snapshots/other_programs.h"

#include <fmt/format.h>

#include <algorithm>

#include "process/process.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "snapshots/scene_stage.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_memory = std::uint64_t{16} << 30U, largest_numbers = std::uint64_t{64} << 20U;
constexpr int threads = 16;  // whose processor time a command may use

// The PNGs below `folder`, without the ending, ascending.
std::vector<std::string> images_below(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (it->path().extension() == ".png")
            names.push_back(it->path().lexically_relative(folder).replace_extension().generic_string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string last_line(std::string_view text) {
    text = trim(text);
    return std::string(text.substr(text.rfind('\n') + 1));
}

// Why what a command wrote is not what its row says; empty: it is.
std::string wrong_frames(const std::vector<std::string>& written, std::vector<std::string> frames) {
    if (frames.empty())
        return written.size() == 1
                   ? ""
                   : fmt::format("wrote {} images, expected one or \"frames\"", written.size());
    std::sort(frames.begin(), frames.end());
    for (const std::string& frame : frames)
        if (!std::binary_search(written.begin(), written.end(), frame))
            return fmt::format("wrote no {}.png", frame);
    for (const std::string& name : written)
        if (!std::binary_search(frames.begin(), frames.end(), name))
            return fmt::format("wrote {}.png, which \"frames\" does not name", name);
    return "";
}

Status run_command(const OtherProgram& program, const fs::path& folder, const std::string& location) {
    const fs::path frames = folder / "frames", said = folder / "said.txt";
    std::error_code error;
    fs::create_directory(frames, error);
    const Result<pid_t> process = start_process(
        {.words = {"-c", program.command + " 2>&1"},
         .program = "/bin/sh",
         .folder = program.folder,
         .environment = {{"SLIPFACE_CAPTURE", frames.string()}},
         .out = said,
         .limits = ProcessLimits{.processor_s = threads * program.seconds, .memory_bytes = max_memory}});
    if (!process) return process.error();
    const std::optional<int> code = wait_for(*process, program.seconds);
    if (!code) return Error{location, fmt::format("takes longer than {} s", program.seconds)};
    if (*code == 0) {
        const std::string wrong = wrong_frames(images_below(frames), program.frames);
        return wrong.empty() ? Status() : Error{location, wrong};
    }
    const Result<std::string> text = read_file(said);
    return Error{location, fmt::format("{}{}{}", ending_text(*code), text && !text->empty() ? ": " : "",
                                       text ? last_line(*text) : "")};
}

// Adds the sections of a frame's JSON.
Status add_numbers(const fs::path& file, Numbers& numbers) {
    std::error_code error;
    if (!fs::exists(file, error)) return {};
    const Result<std::string> text = read_file(file, largest_numbers);
    if (!text) return text.error();
    const Numbers json = Numbers::parse(*text, nullptr, false);
    const Error wrong{
        file.filename().string(),
        "expected JSON with the objects \"numbers\", \"widgets\", [x, y, width, height] each, and "
        "\"renderer\", or some of them"};
    if (!json.is_object()) return wrong;
    for (const auto& [key, section] : json.items()) {
        if ((key != "numbers" && key != "widgets" && key != "renderer") || !section.is_object()) return wrong;
        if (key == "widgets")
            for (const auto& [name, box] : section.items())
                if (!box.is_array() || box.size() != 4 ||
                    !std::all_of(box.begin(), box.end(),
                                 [](const Numbers& n) { return n.is_number_integer(); }))
                    return wrong;
        if (!section.empty()) numbers[key] = section;
    }
    return {};
}

}  // namespace

Result<std::vector<std::string>> frames_of(const Scene& scene) {
    const OtherProgram& program = *scene.program;
    if (!program.command.empty())
        return program.frames.empty() ? std::vector<std::string>{""} : program.frames;
    std::error_code error;
    if (!fs::is_directory(program.folder, error))
        return Error{scene.location + "/images", program.folder.string() + " is no folder"};
    std::vector<std::string> names = images_below(program.folder);
    for (const std::string& name : names)
        if (!valid_snapshot_name(scene.name + "/" + name))
            return Error{
                scene.location + "/images",
                fmt::format("found {}.png, expected letters, digits, '-', '_' and '@' in its name", name)};
    return names;
}

Result<fs::path> ProgramRuns::folder_with(const Scene& scene) {
    const OtherProgram& program = *scene.program;
    if (program.command.empty()) return program.folder;
    const std::pair key(program.folder, program.command);
    auto run = runs_.find(key);
    if (run == runs_.end() || run->second.taken.contains(program.frame)) {
        if (run != runs_.end()) runs_.erase(run);
        Result<TemporaryFolder> folder = TemporaryFolder::make();
        if (!folder) return folder.error();
        run = runs_.emplace(key, Run{*std::move(folder), {}, {}}).first;
        run->second.status = run_command(program, run->second.folder.path(), scene.location + "/command");
    }
    run->second.taken.insert(program.frame);
    if (!run->second.status) return run->second.status.error();
    return run->second.folder.path() / "frames";
}

Result<Rendering> ProgramRuns::render(const Scene& scene, InputBook& book) {
    const OtherProgram& program = *scene.program;
    const Result<fs::path> folder = folder_with(scene);
    if (!folder) return folder.error();
    const std::string frame = program.frame.empty() ? images_below(*folder).front() : program.frame;
    Result<Image> image = load_image(*folder / (frame + ".png"));
    if (!image) return image.error();
    Numbers numbers, row = {{"kind", "row"}};
    if (!program.command.empty()) row["command"] = program.command;
    add_comparison(row, scene);
    InputBook::Named named;
    book.add_named(program.command, program.folder, named, row);
    numbers["version"] = numbers_version;
    numbers["row"] = std::move(row);
    if (Status status = add_numbers(*folder / (frame + ".json"), numbers); !status) return status.error();
    numbers["inputs"] = Numbers::parse(inputs_json(named.inputs, book));
    return Rendering{*std::move(image), numbers_text(numbers)};
}

InputBook::Named program_inputs(const Scene& scene, InputBook& book) {
    InputBook::Named named;
    Numbers row;
    book.add_named(scene.program->command, scene.program->folder, named, row);
    return named;
}

}  // namespace slipface

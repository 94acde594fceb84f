#include "snapshots/input_book.h"

#include <algorithm>
#include <optional>
#include <set>

#include "goldens/level_facts.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/system.h"
#include "slipface/base/text.h"
#include "slipface/level/level_file.h"
#include "slipface/sim/tape.h"
#include "snapshots/staged_level.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_tape_lines = 20'000;  // of longer tapes only a hash is stored
constexpr std::string_view level_ending = ".slipface.json";

bool is_tape(const fs::path& file) {
    return file.extension() == ".tape";
}

bool is_level(const fs::path& file) {
    const std::string ending = file.extension().string();
    return file.filename().string().ends_with(level_ending) || ending == ".obj" || ending == ".glb" ||
           ending == ".gltf";
}

// A hash of what the files contain, whatever they are called.
std::string bytes_of(const std::set<fs::path>& files) {
    Hasher hasher;
    for (const fs::path& file : files) {
        const Result<std::string> bytes = read_file(file);
        hasher.u64(bytes ? hash_blocks(bytes->data(), bytes->size()) : 0);
    }
    return hex_text(hasher.value());
}

std::set<fs::path> files_of(const Level& level) {
    const fs::path folder = level.mesh_path.parent_path();
    std::set<fs::path> files{level.mesh_path, level.file_path};
    const auto add_mesh = [&](const Mesh& mesh, const fs::path& of) {
        for (const std::string& name : mesh.other_files)
            files.insert((of / name).lexically_normal());
        for (const Material& material : mesh.materials)
            if (!material.texture.empty() && !material.picture)
                files.insert((folder / material.texture).lexically_normal());
    };
    add_mesh(*own_mesh(level), folder);
    for (const PropMesh& prop : level.placed.meshes) {
        const fs::path file = (folder / prop.file).lexically_normal();
        files.insert(file);
        if (prop.mesh) add_mesh(*prop.mesh, file.parent_path());
    }
    for (const Prop& prop : level.props)
        if (!prop.texture.empty()) files.insert((folder / prop.texture).lexically_normal());
    if (level.light && !level.light->image.empty()) files.insert(folder / level.light->image);
    if (level.heightfield) files.insert(folder / level.heightfield->file);
    return files;
}

Result<Input> read_level_input(const fs::path& file) {
    if (file.string().starts_with(demo_prefix)) {
        const Result<std::unique_ptr<StagedLevel>> staged = load_staged_level(file);
        if (!staged) return staged.error();
        Numbers facts = level_facts((*staged)->level, {});
        facts["tape"] = tape_to_text(*(*staged)->tape);
        return Input{numbers_text(facts), ""};
    }
    const Result<LoadedLevel> loaded = load_level(file);
    if (!loaded) return loaded.error();
    return Input{numbers_text(level_facts(loaded->level, loaded->warnings)),
                 bytes_of(files_of(loaded->level))};
}

// The lines that say what is played: inputs that are the same for several lines in one.
std::vector<std::string> played_lines(const Tape& tape) {
    std::vector<std::string> lines;
    std::int64_t ticks = 0;
    std::optional<std::string> input;  // of the last line, if it is one
    const std::string text = tape_to_text(tape);
    for (const std::string_view line : split(text, '\n')) {
        const std::string_view word = line.substr(0, line.find(' '));
        if (word.empty() || word == "slipface-tape" || word == "level" || word == "surfaces" || word == "end")
            continue;
        const std::optional<std::int64_t> more = parse_int(word);
        const std::string rest(more ? line.substr(word.size()) : std::string_view());
        if (more && *more == 0) continue;
        if (more && input == rest) {
            ticks += *more;
            lines.back() = std::to_string(ticks) + rest;
            continue;
        }
        ticks = more.value_or(0);
        input = more ? std::optional(rest) : std::nullopt;
        lines.emplace_back(line);
    }
    return lines;
}

Result<Input> read_tape_input(const fs::path& file) {
    const Result<Tape> tape = load_tape(file);
    if (!tape) return tape.error();
    const std::vector<std::string> lines = played_lines(*tape);
    Hasher hasher;
    Numbers rows = Numbers::array();
    for (const std::string& line : lines) {
        hasher.text(line + "\n");
        if (lines.size() <= max_tape_lines) rows.push_back(Numbers::array({line}));
    }
    const Numbers facts = {
        {"version", numbers_version}, {"kind", "tape"}, {"hash", hex_text(hasher.value())}, {"lines", rows}};
    return Input{numbers_text(facts), bytes_of({file})};
}

}  // namespace

InputBook::InputBook(fs::path project) : project_(std::move(project)) {}

std::string InputBook::add(const fs::path& file) {
    std::string text = file.generic_string();
    if (text.starts_with(demo_prefix)) {
        text.replace(0, demo_prefix.size(), "demo/");
    } else {
        std::error_code error;
        text = fs::weakly_canonical(file, error).lexically_relative(project_).generic_string();
        if (text.ends_with(level_ending)) text.resize(text.size() - level_ending.size());
        if (text.ends_with(".obj")) text.resize(text.size() - 4);
    }
    // Names are made of what snapshots' names are made of.
    std::string name;
    bool separated = true;
    for (const char c : text) {
        const bool separator = c == '/' || c == '.';
        const bool plain =
            std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '@';
        if (separator && separated) continue;  // "../" and "./"
        name += separator || plain ? c : '-';
        separated = separator;
    }
    while (!name.empty() && (name.back() == '/' || name.back() == '.'))
        name.pop_back();
    if (name.size() > 180) name.erase(0, name.size() - 180);
    name = std::string(input_folder) + name;
    files_.emplace(name, file);
    return name;
}

void InputBook::add_named(std::string_view text, const fs::path& folder, Named& named, Numbers& row) {
    std::error_code error;
    const std::string_view between =
        fs::is_regular_file(folder / path_of(text), error) ? "" : " \t\"'=;()<>|&";
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find_first_of(between));
        text.remove_prefix(std::min(word.size() + 1, text.size()));
        const fs::path file = word.empty() ? fs::path() : (folder / path_of(word)).lexically_normal();
        const fs::file_status status = fs::status(file, error);
        const std::string name =
            fs::weakly_canonical(file, error).lexically_relative(project_).generic_string();
        if (status.type() != fs::file_type::regular || name.starts_with("..")) continue;
        if (is_tape(file) || is_level(file)) {
            if (!named.files.contains(file)) named.inputs.push_back(add(file));
        } else if ((status.permissions() & fs::perms::owner_exec) == fs::perms::none) {
            const Result<std::string> bytes = read_file(file);
            Hasher hasher;
            hasher.text(bytes ? *bytes : std::string());
            row["files"][name] = hasher.value();
        } else {
            continue;
        }
        named.files.insert(file);
    }
}

std::vector<std::string> InputBook::names() const {
    std::vector<std::string> names;
    for (const auto& [name, file] : files_)
        names.push_back(name);
    return names;
}

Result<Input> InputBook::read(const std::string& name) {
    if (const auto known = read_.find(name); known != read_.end()) return known->second;
    const auto file = files_.find(name);
    if (file == files_.end()) return Error{name, "is no input of a snapshot"};
    Result<Input> input =
        is_tape(file->second) ? read_tape_input(file->second) : read_level_input(file->second);
    if (input) read_[name] = *input;
    return input;
}

Snapshot InputBook::snapshot(const std::string& name) {
    Snapshot snapshot{name, scene_tolerance, [this, name]() -> Result<Rendering> {
                          const Result<Input> input = read(name);
                          if (!input) return input.error();
                          return Rendering{{}, input->facts};
                      }};
    snapshot.input = [this](const std::string& of) { return read(of); };
    return snapshot;
}

}  // namespace slipface

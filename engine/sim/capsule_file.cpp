#include "slipface/sim/capsule_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "slipface/base/files.h"
#include "slipface/level/level_file.h"
#include "slipface/level/level_sources.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr const char* description_name = "capsule.json";
constexpr const char* tape_name = "run.tape";
constexpr const char* version_key = "slipface-capsule";
constexpr std::size_t max_pictures = std::size_t{64} << 20;
constexpr std::size_t longest_note = 10'000;

const ArchiveEntry* find(const std::vector<ArchiveEntry>& entries, std::string_view name) {
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const ArchiveEntry& entry) { return entry.name == name; });
    return found == entries.end() ? nullptr : &*found;
}

// The name relative to the level's folder; empty: it lies outside, where a level may not refer to.
std::string name_in(const fs::path& folder, const fs::path& file) {
    const std::string name = fs::absolute(file)
                                 .lexically_normal()
                                 .lexically_relative(fs::absolute(folder).lexically_normal())
                                 .generic_string();
    return name == "." || name.starts_with("..") ? std::string() : name;
}

Status read_description(const ArchiveEntry& entry, const std::string& location, CapsuleFile& capsule) {
    const auto fail = [&](const std::string& what) {
        return Error{location + ": " + description_name, what};
    };
    const nlohmann::json json = nlohmann::json::parse(entry.bytes, nullptr, false);
    if (!json.is_object()) return fail("is no JSON object");
    const auto version = json.find(version_key);
    if (version == json.end() || *version != 1)
        return fail("found another version, expected \"slipface-capsule\": 1");
    const auto level = json.find("level");
    if (level == json.end() || !level->is_string())
        return fail("expected \"level\", the name of its geometry");
    capsule.level = level->get<std::string>();
    if (const auto tick = json.find("tick"); tick != json.end()) {
        if (!tick->is_number_unsigned()) return fail("found another \"tick\" than a number from 0 on");
        capsule.tick = tick->get<std::size_t>();
    }
    if (const auto note = json.find("note"); note != json.end()) {
        if (!note->is_string()) return fail("found another \"note\" than a text");
        capsule.note = note->get<std::string>().substr(0, longest_note);
    }
    return {};
}

}  // namespace

Result<CapsuleFile> make_capsule_file(const Level& level, Tape tape, std::size_t tick, std::string note,
                                      std::size_t* left_out) {
    if (mesh_changed_on_disk(level))
        return Error{level.mesh_path.string(), "is not on disk as it is open; save or reload it first"};
    CapsuleFile capsule{.level = level.mesh_path.filename().string(),
                        .tape = std::move(tape),
                        .tick = tick,
                        .note = note.substr(0, longest_note),
                        .files = {}};
    const fs::path folder = level.mesh_path.parent_path();
    Level beside = level;
    beside.file_path = level_file_for(level.mesh_path);
    capsule.files.push_back({beside.file_path.filename().string(), level_to_json(beside)});
    const auto add = [&](const fs::path& file, std::size_t most) -> Result<std::size_t> {
        const std::string name = name_in(folder, file);
        std::error_code error;
        if (name.empty() || find(capsule.files, name) || !fs::is_regular_file(file, error))
            return std::size_t{0};
        const std::uintmax_t size = fs::file_size(file, error);
        if (!error && size > most) return most + 1;
        Result<std::string> bytes = read_file(file);
        if (!bytes) return bytes.error();
        capsule.files.push_back({name, std::move(*bytes)});
        return capsule.files.back().bytes.size();
    };
    const LevelSources sources = level_sources(level);
    std::vector<fs::path> needed{level.mesh_path};
    needed.insert(needed.end(), sources.meshes.begin(), sources.meshes.end());
    needed.insert(needed.end(), sources.maps.begin(), sources.maps.end());
    for (const fs::path& file : needed)
        if (const Result<std::size_t> added = add(file, max_archive_bytes); !added) return added.error();
    std::size_t room = max_pictures, passed = 0;
    for (const fs::path& file : sources.textures) {
        const Result<std::size_t> added = add(file, room);
        if (!added) return added.error();
        if (*added > room)
            ++passed;
        else
            room -= *added;
    }
    if (left_out) *left_out = passed;
    return capsule;
}

Status write_capsule_file(const CapsuleFile& capsule, const fs::path& path) {
    const nlohmann::ordered_json description{
        {version_key, 1}, {"level", capsule.level}, {"tick", capsule.tick}, {"note", capsule.note}};
    std::vector<ArchiveEntry> entries{
        {description_name,
         description.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"},
        {tape_name, tape_to_text(capsule.tape)}};
    entries.insert(entries.end(), capsule.files.begin(), capsule.files.end());
    const Result<std::string> bytes = archive_of(entries);
    if (!bytes) return bytes.error();
    return write_file_atomic(path, *bytes);
}

Result<CapsuleFile> read_capsule_file(const fs::path& path) {
    const Result<std::string> bytes = read_file(path, max_archive_bytes);
    if (!bytes) return bytes.error();
    const std::string location = path.string();
    Result<std::vector<ArchiveEntry>> entries = read_archive(*bytes, location);
    if (!entries) return entries.error();
    CapsuleFile capsule;
    const ArchiveEntry* const description = find(*entries, description_name);
    const ArchiveEntry* const tape = find(*entries, tape_name);
    if (!description || !tape)
        return Error{location, "is no capsule: expected capsule.json and run.tape in it"};
    if (Status status = read_description(*description, location, capsule); !status) return status.error();
    Result<Tape> parsed = parse_tape(tape->bytes, location + ": " + tape_name);
    if (!parsed) return parsed.error();
    capsule.tape = std::move(*parsed);
    if (!find(*entries, capsule.level) || capsule.level.find('/') != std::string::npos)
        return Error{location, "names the level \"" + capsule.level.substr(0, 60) + "\", which is not in it"};
    std::erase_if(*entries, [](const ArchiveEntry& entry) {
        return entry.name == description_name || entry.name == tape_name;
    });
    capsule.files = std::move(*entries);
    return capsule;
}

Result<fs::path> unpack_level(const CapsuleFile& capsule, const fs::path& folder) {
    for (const ArchiveEntry& entry : capsule.files) {
        const fs::path file = folder / entry.name;
        std::error_code error;
        fs::create_directories(file.parent_path(), error);
        if (error) return Error{file.parent_path().string(), "cannot be made: " + error.message()};
        if (Status status = write_file_atomic(file, entry.bytes); !status) return status.error();
    }
    return folder / capsule.level;
}

}  // namespace slipface

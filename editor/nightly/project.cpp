#include "nightly/project.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"
#include "slipface/level/appearance_files.h"
#include "slipface/level/level_file.h"
#include "slipface/level/preset.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;
using ProjectJson = nlohmann::ordered_json;

constexpr std::uint64_t max_project_bytes = std::uint64_t{16} << 20;
constexpr std::size_t max_items = 1'000'000;

std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    for (const std::string_view part : split(text, ' '))
        if (!trim(part).empty()) words.emplace_back(trim(part));
    return words;
}

// The files of `folder` that a pattern names, sorted; paths from `folder`.
Result<std::vector<std::string>> files_of(const fs::path& folder, const std::string& pattern,
                                          const std::string& location) {
    const fs::path path(pattern);
    std::vector<std::string> files;
    std::error_code error;
    if (pattern.find_first_of("*?") == std::string::npos) {
        if (fs::is_regular_file(folder / path, error)) files.push_back(path.generic_string());
    } else {
        const fs::path parent = folder / path.parent_path();
        for (fs::directory_iterator entry(parent, error), end; !error && entry != end;
             entry.increment(error)) {
            const std::string name = entry->path().filename().string();
            if (glob_match(path.filename().string(), name) && entry->is_regular_file(error))
                files.push_back((path.parent_path() / name).generic_string());
        }
        std::sort(files.begin(), files.end());
    }
    if (files.empty())
        return Error{location, fmt::format("found \"{}\", expected a file, or a pattern that fits one, in {}",
                                           pattern, folder.string())};
    return files;
}

Result<std::vector<std::string>> texts_of(const ProjectJson& json, const std::string& location) {
    std::vector<std::string> texts;
    if (!json.is_array() || json.empty()) return Error{location, "expected a list of texts"};
    for (const ProjectJson& item : json) {
        if (!item.is_string()) return Error{location, "expected a list of texts"};
        texts.push_back(item.get<std::string>());
    }
    return texts;
}

Result<std::vector<std::string>> presets_of(const ProjectJson& root, const fs::path& folder,
                                            const std::string& location) {
    if (!root.contains("presets")) return std::vector<std::string>{""};
    Result<std::vector<std::string>> presets = texts_of(root["presets"], location);
    if (!presets) return presets;
    for (std::string& preset : *presets) {
        const bool shipped = std::any_of(shipped_presets().begin(), shipped_presets().end(),
                                         [&](const ShippedPreset& one) { return one.id == preset; });
        if (preset == "level")
            preset.clear();
        else if (const auto found = load_preset(folder / preset); !shipped && !found)
            return Error{location,
                         fmt::format("found \"{}\", expected level, a shipped preset or a preset file: {}",
                                     preset, found.error().text())};
    }
    return presets;
}

struct Chosen {
    const NightCheck* check;
    std::vector<std::string> options;
};

Result<std::vector<Chosen>> checks_of(const ProjectJson& root, const std::string& location) {
    std::vector<Chosen> chosen;
    const auto checks = root.find("checks");
    if (checks == root.end() || !checks->is_object() || checks->empty())
        return Error{location, "expected an object of verbs with their options"};
    for (const auto& [verb, options] : checks->items()) {
        const auto check = std::find_if(night_checks().begin(), night_checks().end(),
                                        [&name = verb](const NightCheck& one) { return name == one.verb; });
        if (check == night_checks().end() || !options.is_string())
            return Error{location + "/" + verb,
                         "expected audit, reach, doctor or snapshot, and options as a text"};
        chosen.push_back({&*check, words_of(options.get<std::string>())});
        std::vector<std::string>& words = chosen.back().options;
        // The verb's own default is a time.
        if (verb == "reach" && std::find(words.begin(), words.end(), "--rounds") == words.end())
            words.insert(words.end(), {"--rounds", "400"});
        for (const std::string& word : words)
            for (const std::string& refused : check->refused)
                if (word == refused || word.starts_with(refused + "="))
                    return Error{
                        location + "/" + verb,
                        fmt::format("found {}, which the night sets itself or which would not give the same "
                                    "result again",
                                    refused)};
    }
    return chosen;
}

std::string safe(const std::string& path) {
    std::string text;
    for (const fs::path& part : fs::path(path).relative_path().lexically_normal())
        text += (text.empty() ? "" : "/") + (part == ".." ? "up" : part.string());
    return text;
}

}  // namespace

const std::vector<NightCheck>& night_checks() {
    static const std::vector<NightCheck> checks{
        {"audit",
         true,
         true,
         false,
         {"audit"},
         {"--preset", "--threads", "--json", "--out", "--tapes", "--shard"}},
        {"reach",
         true,
         true,
         false,
         {"reach", "--check"},
         {"--preset", "--threads", "--json", "--out", "--tapes", "--seconds", "--before", "--how", "--links",
          "--resume", "--checkpoint"}},
        {"doctor", true, false, false, {"doctor"}, {"--json"}},
        {"snapshot",
         false,
         false,
         true,
         {"snapshot", "check"},
         {"--out", "--jobs", "--shard", "--detailed-exit"}}};
    return checks;
}

std::string NightItem::name() const {
    if (level.empty()) return check->verb;
    return fmt::format("{}{}{}: {}", level, preset.empty() ? "" : ", ", preset, check->verb);
}

fs::path NightItem::folder() const {
    const fs::path top = "items";
    if (level.empty()) return top / check->verb;
    return top / safe(level) / (preset.empty() ? "level" : safe(preset)) / check->verb;
}

std::vector<std::string> NightItem::command() const {
    std::vector<std::string> words{"slipface"};
    words.insert(words.end(), check->command.begin(), check->command.end());
    if (!level.empty()) words.push_back(level);
    if (!preset.empty()) words.insert(words.end(), {"--preset", preset});
    words.insert(words.end(), options.begin(), options.end());
    return words;
}

Result<Project> load_project(const fs::path& file) {
    const std::string location = file.string();
    const Result<std::string> text = read_file(file, max_project_bytes);
    if (!text) return text.error();
    const ProjectJson root = ProjectJson::parse(*text, nullptr, false);
    if (!root.is_object() || root.value("slipface_nightly", ProjectJson()) != 1)
        return Error{location, "is no project: expected an object with \"slipface_nightly\": 1"};
    for (const auto& [key, value] : root.items())
        if (key != "slipface_nightly" && key != "levels" && key != "presets" && key != "checks")
            return Error{location + ":/" + key, "expected slipface_nightly, levels, presets or checks"};
    Project project{.folder = file.has_parent_path() ? file.parent_path() : ".",
                    .fingerprint = fingerprint_of_files({&file, 1}),
                    .items = {}};

    const auto checks = checks_of(root, location + ":/checks");
    if (!checks) return checks.error();
    const auto presets = presets_of(root, project.folder, location + ":/presets");
    if (!presets) return presets.error();
    std::vector<std::string> levels;
    if (std::any_of(checks->begin(), checks->end(), [](const Chosen& one) { return one.check->per_level; })) {
        const auto patterns = texts_of(root.value("levels", ProjectJson()), location + ":/levels");
        if (!patterns) return patterns.error();
        for (const std::string& pattern : *patterns) {
            const auto files = files_of(project.folder, pattern, location + ":/levels");
            if (!files) return files.error();
            for (const std::string& level : *files)
                if (std::find(levels.begin(), levels.end(), level) == levels.end()) levels.push_back(level);
        }
    }
    for (const auto& [check, options] : *checks) {
        if (!check->per_level) {
            project.items.push_back({.check = check, .level = "", .preset = "", .options = options});
            continue;
        }
        for (const std::string& level : levels) {
            // A level without goals has none to check.
            if (std::string_view(check->verb) == "reach" && files_of_level(project.folder / level).goals == 0)
                continue;
            for (std::size_t i = 0; i < (check->per_preset ? presets->size() : 1); ++i)
                project.items.push_back({.check = check,
                                         .level = level,
                                         .preset = check->per_preset ? (*presets)[i] : "",
                                         .options = options});
        }
        if (project.items.size() > max_items)
            return Error{location, fmt::format("found {} checks, expected at most {}", project.items.size(),
                                               max_items)};
    }
    return project;
}

void find_keys(Project& project, const std::string& program) {
    std::map<std::string, std::uint64_t> of_level;
    std::map<fs::path, std::uint64_t> of_folder;
    for (NightItem& item : project.items) {
        if (item.level.empty()) continue;
        const fs::path level = project.folder / item.level;
        const auto [at, is_new] = of_level.try_emplace(item.level, 0);
        if (is_new) at->second = fingerprint_of_files(files_of_level(level).files);
        const fs::path preset = project.folder / item.preset;
        Hasher hasher;
        hasher.text(program);
        hasher.text(shell_text(item.command()));
        hasher.u64(at->second);
        if (!item.check->per_preset) {  // the doctor misses textures, too
            const auto [folder, is_other] = of_folder.try_emplace(level.parent_path(), 0);
            if (is_other) folder->second = fingerprint_of_files(appearance_files(level));
            hasher.u64(folder->second);
        }
        if (!item.preset.empty()) hasher.u64(fingerprint_of_files({&preset, 1}));
        item.key = hasher.value();
    }
}

std::string shell_text(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) {
        line += line.empty() ? "" : " ";
        const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
            return std::isalnum(c) != 0 ||
                   std::string_view("_-./:=,+%@").find(static_cast<char>(c)) != std::string_view::npos;
        });
        if (plain) {
            line += word;
            continue;
        }
        line += '\'';
        for (const char c : word)
            line += c == '\'' ? std::string("'\\''") : std::string(1, c);
        line += '\'';
    }
    return line;
}

}  // namespace slipface

#include "snapshot_verb/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "cli/exit_codes.h"
#include "goldens/explain.h"
#include "goldens/numbers_json.h"
#include "process/process.h"
#include "slipface/base/files.h"
#include "slipface/base/temporary_folder.h"
#include "slipface/base/text.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t largest_output = std::uint64_t{256} << 20U;
constexpr const char* commit_line = "--format=commit %h %as %s";

// What git prints in `folder`; an error where it fails.
Result<std::string> git(const fs::path& folder, const std::vector<std::string>& words) {
    const Result<TemporaryFolder> own = TemporaryFolder::make();
    if (!own) return own.error();
    const fs::path out = own->path() / "out";
    const Result<pid_t> process = start_process(
        {.words = words, .program = "git", .folder = folder, .out = out, .err = own->path() / "err"});
    if (!process) return process.error();
    if (wait_for(*process) == 0) return read_file(out, largest_output);
    const Result<std::string> said = read_file(own->path() / "err");
    return Error{"git", said ? std::string(trim(*said)) : "failed"};
}

// A golden as a commit has it; what is not there is empty.
struct Version {
    std::string numbers;
    Image image;
    std::map<std::string, std::string> facts;  // by input
};

Version version_at(const fs::path& folder, const std::string& commit, const std::string& name) {
    const auto show = [&](const std::string& file) {
        const Result<std::string> bytes = git(folder, {"show", commit + ":./" + file});
        return bytes ? *bytes : std::string();
    };
    Version version{show(name + ".json"), {}, {}};
    if (is_input(name)) return version;
    if (Result<Image> image = decode_image(show(name + ".png"), name)) version.image = *std::move(image);
    const Numbers numbers = Numbers::parse(version.numbers, nullptr, false);
    if (numbers.is_object() && numbers.contains("inputs"))
        for (const auto& [input, mark] : numbers["inputs"].items())
            version.facts[input] = show(input + ".json");
    return version;
}

// The acts between two versions, and how many pixels they changed.
std::string change_between(const std::string& name, const Version& before, const Version& after) {
    if (after.numbers.empty() && after.image.rgba.empty()) return "it was removed";
    if (before.numbers.empty() && before.image.rgba.empty()) return "it was approved first";
    const auto numbers = compare_numbers(before.numbers, after.numbers, name);
    if (!numbers) return "its numbers are of another release";
    std::vector<Finding> findings;
    if (is_input(name)) {
        findings = explain_input({name, before.numbers, after.numbers, false});
    } else {
        std::vector<InputPair> inputs;
        for (const auto& [input, facts] : after.facts)
            if (const auto was = before.facts.find(input); was != before.facts.end())
                inputs.push_back({input, was->second, facts, false});
        const bool screen = after.numbers.find("\"widgets\": {") != std::string::npos;
        findings = explain({before.image, Rendering{after.image, after.numbers}, before.numbers, *numbers,
                            inputs, screen ? ui_tolerance : scene_tolerance});
    }
    std::string text;
    for (const Finding& finding : findings)
        if (finding.act)
            text +=
                fmt::format("{}{}: {}", text.empty() ? "" : "; ", cause_name(finding.cause), finding.text);
    if (before.image == after.image) return text + (is_input(name) ? "" : "; the same image");
    if (before.image.width != after.image.width || before.image.height != after.image.height)
        return text + "; another size";
    return text +
           fmt::format("; {} pixels", compare_images(before.image, after.image, ui_tolerance).differing);
}

}  // namespace

int snapshot_history(const std::string& goldens, const std::string& name) {
    const fs::path folder = goldens;
    std::vector<std::string> words{"log", commit_line, "--", name + ".png", name + ".json"};
    const Result<std::string> numbers = read_file(folder / (name + ".json"));
    if (const Numbers json = numbers ? Numbers::parse(*numbers, nullptr, false) : Numbers();
        json.is_object() && json.contains("inputs"))
        for (const auto& [input, mark] : json["inputs"].items())
            words.push_back(input + ".json");
    const Result<std::string> log = git(folder, words);
    if (!log || trim(*log).empty()) {
        fmt::print(
            stderr, "slipface: {}\n",
            log ? Error{name, "no commit has it; expected the name of a golden"}.text() : log.error().text());
        return cli::exit_bad_input;
    }
    std::vector<std::pair<std::string, std::string>> commits;  // hash; date and subject
    for (std::string_view line : split(trim(*log), '\n')) {
        line.remove_prefix(std::string_view("commit ").size());
        const std::size_t space = line.find(' ');
        commits.emplace_back(line.substr(0, space), line.substr(space + 1));
    }
    Version after = version_at(folder, commits.front().first, name);
    for (std::size_t i = 0; i < commits.size(); ++i) {
        Version before = i + 1 < commits.size() ? version_at(folder, commits[i + 1].first, name) : Version();
        const auto& [commit, text] = commits[i];
        fmt::print("{} {} {}\n           {}\n", text.substr(0, 10), commit, text.substr(11),
                   change_between(name, before, after));
        after = std::move(before);
    }
    return cli::exit_fine;
}

void add_history(Report& report) {
    if (report.failed() == 0) return;
    const Result<std::string> log =
        git(report.goldens, {"log", "-n", "1000", "--relative", "--name-only", commit_line, "--", "."});
    if (!log) return;
    constexpr std::size_t most = 5;
    std::map<std::string, std::vector<std::string>> commits;  // of a golden, newest first
    std::string commit;
    for (const std::string_view line : split(*log, '\n')) {
        if (line.starts_with("commit ")) commit = line.substr(7);
        std::vector<std::string>& of = commits[std::string(line.substr(0, line.rfind('.')))];
        if (of.size() < most && (of.empty() || of.back() != commit)) of.push_back(commit);
    }
    for (GoldenResult& entry : report.entries)
        if (entry.state != GoldenState::same) entry.history = commits[entry.name];
}

}  // namespace slipface

#include "nightly/run_item.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "cli/exit_codes.h"
#include "process/process.h"
#include "slipface/base/files.h"
#include "slipface/base/temporary_folder.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;
using ChildJson = nlohmann::json;

constexpr std::size_t max_findings = 50;  // of an item in the report
constexpr const char* result_file = "result.json";

// A process that writes to two files in its item's folder.
struct Child {
    pid_t pid = -1;
    fs::path out, err;
};

Result<Child> start(std::vector<std::string> words, const fs::path& work, const fs::path& files) {
    Child child{.pid = -1, .out = files / "out.txt", .err = files / "err.txt"};
    const Result<pid_t> process =
        start_process({.words = std::move(words), .folder = work, .out = child.out, .err = child.err});
    if (!process) return process.error();
    child.pid = *process;
    return child;
}

ChildOutput output_of(const Child& child, int code) {
    ChildOutput output{.code = code, .out = {}, .err = {}};
    if (const Result<std::string> text = read_file(child.out)) output.out = *text;
    if (const Result<std::string> text = read_file(child.err)) output.err = *text;
    std::error_code ignored;
    fs::remove(child.out, ignored);
    fs::remove(child.err, ignored);
    return output;
}

// Where an item's process writes, beside what its command says.
std::vector<std::string> arguments_of(const NightItem& item, const fs::path& files, int cores) {
    std::vector<std::string> words = item.command();
    words.erase(words.begin());
    const std::string verb = item.check->verb, folder = files.string();
    if (verb == "snapshot") {
        words.insert(words.end(), {"--out", folder, "--quiet", "--jobs", std::to_string(cores)});
    } else {
        words.push_back("--json");
        if (verb != "doctor")
            words.insert(words.end(), {"--tapes", folder, "--threads", std::to_string(cores)});
    }
    return words;
}

std::string tape_ending_with(const fs::path& folder, const std::string& ending) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (entry->path().filename().string().ends_with(ending)) return entry->path().filename().string();
    return "";
}

void add(NightResult& result, NightFinding finding) {
    if (++result.count <= max_findings) result.findings.push_back(std::move(finding));
}

// What the verb's JSON says. Throws what nlohmann throws.
void read_findings(const std::string& verb, const ChildOutput& output, const fs::path& files,
                   NightResult& result) {
    if (verb == "snapshot") {
        const Result<std::string> text = read_file(files / "report.json");
        const ChildJson report = ChildJson::parse(text ? *text : "");
        result.page = "report.html";
        for (const ChildJson& entry : report.at("entries")) {
            if (entry.at("state") == "same") continue;
            std::string why = entry.at("message").get<std::string>();
            for (const ChildJson& finding : entry.value("findings", ChildJson::array()))
                why += (why.empty() ? "" : "; ") + finding.at("text").get<std::string>();
            add(result, {entry.at("state").get<std::string>(),
                         entry.at("name").get<std::string>() + (why.empty() ? "" : ": ") + why, ""});
        }
        result.text = fmt::format("{} images, {} not the same", report.at("entries").size(), result.count);
        return;
    }
    const ChildJson json = ChildJson::parse(output.out);
    if (verb == "audit") {
        for (const ChildJson& finding : json.at("findings")) {
            const auto kind = finding.at("kind").get<std::string>();
            const std::string tape =
                result.count < max_findings
                    ? tape_ending_with(files,
                                       fmt::format("-{}-{}-{}.tape", kind, finding.at("walker").get<int>(),
                                                   finding.at("life").get<int>()))
                    : "";
            add(result, {kind, finding.at("text").get<std::string>(), tape});
        }
        result.text =
            fmt::format("{} findings in {} steps", result.count, json.at("steps").get<std::uint64_t>());
    } else if (verb == "reach") {
        for (const ChildJson& goal : json.at("goals")) {
            if (goal.at("holds").get<bool>()) continue;
            std::string text = goal.at("text").get<std::string>();
            for (const ChildJson& cause : goal.value("causes", ChildJson::array()))
                text += "; " + cause.get<std::string>();
            add(result, {"goal", text, fs::path(goal.value("tape", "")).filename().string()});
        }
        result.text = fmt::format("{} of {} goals broken", result.count, json.at("goals").size());
    } else {
        for (const ChildJson& problem : json.at("list"))
            add(result, {problem.at("kind").get<std::string>(),
                         fmt::format("{}, at ({:.2f}, {:.2f}, {:.2f})", problem.at("text").get<std::string>(),
                                     problem.at("position").at(0).get<double>(),
                                     problem.at("position").at(1).get<double>(),
                                     problem.at("position").at(2).get<double>()),
                         ""});
        result.text = fmt::format("{} problems", result.count);
    }
}

NightResult result_of(std::size_t index, const NightItem& item) {
    NightResult result;
    result.index = index;
    result.name = item.name();
    result.folder = item.folder().generic_string();
    result.level = item.level;
    result.command = item.command();
    result.key = item.key;
    return result;
}

std::string last_line(const std::string& text) {
    const std::string_view end = trim(std::string_view(text));
    return std::string(end.substr(end.rfind('\n') + 1));
}

NightResult read_result(std::size_t index, const NightItem& item, const ChildOutput& output,
                        const fs::path& files) {
    NightResult result = result_of(index, item);
    if (output.code == cli::exit_fine || output.code == cli::exit_check_failed) {
        try {
            read_findings(item.check->verb, output, files, result);
            result.state = output.code == cli::exit_fine ? NightState::clean : NightState::findings;
            return result;
        } catch (const std::exception& exception) {
            result = result_of(index, item);
            result.text = fmt::format("printed what cannot be read: {}", exception.what());
        }
    } else if (output.code > 128) {
        result.text = ending_text(output.code);
    } else {
        result.text = last_line(output.err);
        if (const std::string prefix = "slipface: "; result.text.starts_with(prefix))
            result.text.erase(0, prefix.size());
    }
    result.state = NightState::failed;
    return result;
}

constexpr const char* lost_child = "a process that was started can no longer be waited for";

}  // namespace

Result<ChildOutput> run_child(const std::vector<std::string>& arguments, const fs::path& folder) {
    const Result<TemporaryFolder> own = TemporaryFolder::make();
    if (!own) return own.error();
    const Result<Child> child = start(arguments, folder, own->path());
    if (!child) return child.error();
    const int code = wait_for(child->pid);
    ChildOutput output = output_of(*child, code);
    if (code < 0) return Error{arguments.front(), lost_child};
    return output;
}

std::optional<NightResult> stored_result(const fs::path& out, const NightItem& item, std::size_t index) {
    const fs::path file = out / item.folder() / result_file;
    const Result<std::string> text = read_file(file);
    if (!text) return std::nullopt;
    Result<NightResult> result = night_result_from_json(*text, file.string());
    if (!result || result->key != item.key || item.key == 0 || result->state == NightState::failed)
        return std::nullopt;
    std::error_code error;
    for (const NightFinding& finding : result->findings)
        if (!finding.tape.empty() && !fs::is_regular_file(out / item.folder() / finding.tape, error))
            return std::nullopt;
    result->index = index;
    return std::move(*result);
}

Status run_items(const NightRun& run, const std::vector<std::pair<std::size_t, const NightItem*>>& items,
                 const std::function<void(NightResult)>& done) {
    std::map<pid_t, std::pair<Child, std::size_t>> running;  // its item's place in `items`
    Status status;
    const auto wait_for_one = [&] {
        const auto [pid, code] = wait_for_any();
        if (pid < 0) {
            status = Error{run.out.string(), lost_child};
            running.clear();
        }
        const auto at = running.find(pid);
        if (at == running.end()) return;
        const auto [child, place] = at->second;
        running.erase(at);
        const auto [index, item] = items[place];
        const fs::path files = run.out / item->folder();
        NightResult result = read_result(index, *item, output_of(child, code), files);
        if (Status written = write_file_atomic(files / result_file, night_result_to_json(result)); !written)
            status = written;
        done(std::move(result));
    };
    for (std::size_t place = 0; place < items.size() && status.ok(); ++place) {
        const NightItem& item = *items[place].second;
        while (static_cast<int>(running.size()) >= (item.check->uses_all_cores ? 1 : run.jobs))
            wait_for_one();
        const fs::path files = run.out / item.folder();
        std::error_code error;
        fs::remove_all(files, error);
        fs::create_directories(files, error);
        if (error) {
            status = Error{files.string(), "cannot be made: " + error.message()};
            break;
        }
        const int cores = item.check->uses_all_cores ? run.jobs : 1;
        Result<Child> child = start(arguments_of(item, files, cores), run.project, files);
        if (!child) {
            status = child.error();
            break;
        }
        running.emplace(child->pid, std::pair(*child, place));
    }
    while (!running.empty())
        wait_for_one();
    return status;
}

}  // namespace slipface

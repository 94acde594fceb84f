#include "nightly/night_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>

#include "slipface/base/files.h"
#include "slipface/base/hash.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;
using NightJson = nlohmann::ordered_json;

constexpr std::uint64_t max_report_bytes = std::uint64_t{1} << 30;

std::string hex(std::uint64_t value) {
    return fmt::format("{:016x}", value);
}

std::string dump(const NightJson& json, int indent) {
    return json.dump(indent, ' ', false, NightJson::error_handler_t::replace);
}

std::string checksum_of(const NightJson& json) {
    Hasher hasher;
    hasher.text(dump(json, -1));
    return hex(hasher.value());
}

NightJson json_of(const NightResult& result) {
    NightJson json{{"index", result.index},
                   {"name", result.name},
                   {"folder", result.folder},
                   {"level", result.level},
                   {"command", result.command},
                   {"key", hex(result.key)},
                   {"state", night_state_names[static_cast<std::size_t>(result.state)]},
                   {"text", result.text},
                   {"page", result.page},
                   {"count", result.count}};
    json["findings"] = NightJson::array();
    for (const NightFinding& finding : result.findings)
        json["findings"].push_back({{"kind", finding.kind}, {"text", finding.text}, {"tape", finding.tape}});
    return json;
}

// Throws what nlohmann throws.
NightResult result_of(const NightJson& json) {
    NightResult result;
    result.index = json.at("index").get<std::size_t>();
    result.name = json.at("name").get<std::string>();
    result.folder = json.at("folder").get<std::string>();
    result.level = json.at("level").get<std::string>();
    result.command = json.at("command").get<std::vector<std::string>>();
    result.key = std::stoull(json.at("key").get<std::string>(), nullptr, 16);
    const auto state = json.at("state").get<std::string>();
    const auto at = std::find(night_state_names.begin(), night_state_names.end(), state);
    if (at == night_state_names.end()) throw std::runtime_error("found the state " + state);
    result.state = static_cast<NightState>(at - night_state_names.begin());
    result.text = json.at("text").get<std::string>();
    result.page = json.at("page").get<std::string>();
    result.count = json.at("count").get<std::size_t>();
    for (const NightJson& finding : json.at("findings"))
        result.findings.push_back({finding.at("kind").get<std::string>(),
                                   finding.at("text").get<std::string>(),
                                   finding.at("tape").get<std::string>()});
    // What a report names lies below its own folder: merging replaces the whole of it.
    for (const fs::path& path : {fs::path(result.folder), fs::path(result.page)})
        if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end())
            throw std::runtime_error("found the path " + path.string());
    if (!result.folder.starts_with("items/")) throw std::runtime_error("found the folder " + result.folder);
    return result;
}

// The object without its checksum, which fits it.
NightJson checked(std::string_view text) {
    NightJson json = NightJson::parse(text);
    const auto checksum = json.at("checksum").get<std::string>();
    json.erase("checksum");
    if (checksum != checksum_of(json)) throw std::runtime_error("its checksum does not fit what it says");
    return json;
}

std::string signed_text(NightJson json) {
    json["checksum"] = checksum_of(json);
    return dump(json, 1) + "\n";
}

int severity(const NightFinding& finding) {
    constexpr std::array kinds{"passed_through", "left_level", "overlap", "stuck", "goal"};
    return static_cast<int>(std::find(kinds.begin(), kinds.end(), finding.kind) - kinds.begin());
}

}  // namespace

std::size_t NightReport::count(NightState state) const {
    return static_cast<std::size_t>(std::count_if(
        results.begin(), results.end(), [&](const NightResult& one) { return one.state == state; }));
}

std::string night_result_to_json(const NightResult& result) {
    return signed_text(json_of(result));
}

Result<NightResult> night_result_from_json(std::string_view text, const std::string& location) try {
    return result_of(checked(text));
} catch (const std::exception& exception) {
    return Error{location, fmt::format("is no result: {}", exception.what())};
}

std::string night_report_to_json(const NightReport& report) {
    NightJson json{
        {"slipface_night", 1},          {"program", report.program}, {"project", hex(report.project)},
        {"inputs", hex(report.inputs)}, {"items", report.items},     {"shard", shard_text(report.shard)},
        {"results", NightJson::array()}};
    for (const NightResult& result : report.results)
        json["results"].push_back(json_of(result));
    return signed_text(std::move(json));
}

Result<NightReport> night_report_from_json(std::string_view text, const std::string& location) try {
    const NightJson json = checked(text);
    if (json.at("slipface_night") != 1) return Error{location, "expected \"slipface_night\": 1"};
    NightReport report;
    report.program = json.at("program").get<std::string>();
    report.project = std::stoull(json.at("project").get<std::string>(), nullptr, 16);
    report.inputs = std::stoull(json.at("inputs").get<std::string>(), nullptr, 16);
    report.items = json.at("items").get<std::size_t>();
    const Result<Shard> shard = parse_shard(json.at("shard").get<std::string>(), location + ":/shard");
    if (!shard) return shard.error();
    report.shard = *shard;
    for (const NightJson& result : json.at("results"))
        report.results.push_back(result_of(result));
    return report;
} catch (const std::exception& exception) {
    return Error{location, fmt::format("is no report of a night, or a damaged one: {}", exception.what())};
}

std::vector<const NightResult*> worst_first(const NightReport& report) {
    std::vector<const NightResult*> order;
    for (const NightResult& result : report.results)
        order.push_back(&result);
    const auto key = [](const NightResult* one) {
        int worst = 99;
        for (const NightFinding& finding : one->findings)
            worst = std::min(worst, severity(finding));
        return std::tuple(one->state, worst, -static_cast<std::int64_t>(one->count), one->index);
    };
    std::sort(order.begin(), order.end(),
              [&](const NightResult* a, const NightResult* b) { return key(a) < key(b); });
    return order;
}

Status copy_folder(const fs::path& from, const fs::path& to) {
    std::error_code error;
    if (fs::equivalent(from, to, error)) return {};
    error.clear();
    fs::remove_all(to, error);
    fs::create_directories(to, error);
    if (!error) fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::overwrite_existing, error);
    if (error) return Error{to.string(), "cannot be written: " + error.message()};
    return {};
}

Status write_night_report(const NightReport& report, const fs::path& out, const fs::path& project_folder) {
    std::error_code error;
    fs::create_directories(out, error);
    const fs::path here = project_folder.empty() ? "." : project_folder;
    const fs::path to_report = fs::relative(out, here, error);
    for (const auto& [name, text] : {std::pair("report.json", night_report_to_json(report)),
                                     std::pair("report.html", night_report_to_html(report, to_report)),
                                     std::pair("junit.xml", night_report_to_junit(report, to_report))})
        if (Status status = write_file_atomic(out / name, text); !status) return status;
    return {};
}

Result<NightReport> merge_night_reports(const std::vector<fs::path>& files, const fs::path& out) {
    std::vector<NightReport> parts;
    std::vector<ShardFile> shards;
    for (const fs::path& file : files) {
        const Result<std::string> text = read_file(file, max_report_bytes);
        if (!text) return text.error();
        Result<NightReport> part = night_report_from_json(*text, file.string());
        if (!part) return part.error();
        parts.push_back(std::move(*part));
        shards.push_back({file.string(), parts.back().shard});
        const NightReport &a = parts.front(), &b = parts.back();
        const char* const other = a.program != b.program                         ? "program"
                                  : a.project != b.project || a.items != b.items ? "project file"
                                  : a.inputs != b.inputs                         ? "levels, presets or images"
                                                                                 : nullptr;
        if (other != nullptr)
            return Error{file.string(), fmt::format("is part of another night than {}: they differ in {}",
                                                    shards.front().file, other)};
    }
    if (Status status = check_shards_complete(shards, "nightly merge"); !status) return status.error();
    NightReport whole = parts.front();
    whole.shard = {};
    whole.results.clear();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (NightResult& result : parts[i].results) {
            const fs::path from = files[i].parent_path() / result.folder;
            std::error_code error;
            if (!fs::is_directory(from, error))
                return Error{from.string(), "is missing; the report names its files"};
            if (Status status = copy_folder(from, out / result.folder); !status) return status.error();
            whole.results.push_back(std::move(result));
        }
    }
    std::sort(whole.results.begin(), whole.results.end(),
              [](const NightResult& a, const NightResult& b) { return a.index < b.index; });
    for (std::size_t i = 0; i < whole.results.size(); ++i)
        if (whole.results[i].index != i)
            return Error{"nightly merge", fmt::format("found {} results, expected each of {} once",
                                                      whole.results.size(), whole.items)};
    if (whole.results.size() != whole.items)
        return Error{"nightly merge",
                     fmt::format("found {} results, expected {}", whole.results.size(), whole.items)};
    return whole;
}

}  // namespace slipface

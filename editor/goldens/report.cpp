#include "goldens/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "goldens/junit.h"
#include "goldens/numbers_json.h"
#include "slipface/base/counted.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/version.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t largest_report = std::uint64_t{256} << 20U;

int severity(const GoldenResult& entry) {
    constexpr std::array<int, golden_state_count> rank{6, 3, 4, 0, 2, 1, 5};  // as GoldenState counts
    return rank[static_cast<std::size_t>(entry.state)];
}

Numbers entry_json(const GoldenResult& entry) {
    Numbers json;
    json["name"] = entry.name;
    json["state"] = golden_state_name(entry.state);
    json["message"] = entry.message;
    json["seconds"] = entry.seconds;
    json["drawing_s"] = entry.drawing_s;
    if (!entry.matched.empty()) json["matched"] = entry.matched;
    if (!entry.history.empty()) json["history"] = entry.history;
    if (!entry.coverage.reached.empty()) json["reached"] = entry.coverage.reached;
    if (!entry.coverage.there.empty()) json["there"] = entry.coverage.there;
    const Comparison& c = entry.comparison;
    if (!c.verdict.empty())
        json["pixels"] = {
            {"verdict", c.verdict},           {"same", c.same},
            {"size_differs", c.size_differs}, {"largest", c.max_delta},
            {"differing", c.differing},       {"allowed", c.allowed},
            {"densest", c.densest_window},    {"at", Numbers::array({c.densest_x, c.densest_y})}};
    for (const Finding& finding : entry.findings)
        json["findings"].push_back({{"cause", cause_name(finding.cause)},
                                    {"pixels", finding.pixels},
                                    {"text", finding.text},
                                    {"act", finding.act}});
    for (const NumberDifference& number : entry.numbers)
        json["numbers"].push_back({{"path", number.path},
                                   {"cause", cause_name(number.cause)},
                                   {"expected", number.expected},
                                   {"actual", number.actual},
                                   {"decides", number.decides}});
    if (entry.state == GoldenState::different)
        for (const SweepRow& row : entry.sweep)
            json["sweep"].push_back(Numbers::array({row.pixel_delta, row.differing}));
    return json;
}

Cause cause_of(const Numbers& json) {
    for (std::size_t i = 0; i < cause_count; ++i)
        if (json.value("cause", "") == cause_name(static_cast<Cause>(i))) return static_cast<Cause>(i);
    return Cause::level;
}

GoldenResult entry_of(const Numbers& json) {
    GoldenResult entry;
    entry.name = json.at("name").get<std::string>();
    const auto state = json.at("state").get<std::string>();
    std::size_t index = 0;
    while (index < golden_state_count && state != golden_state_name(static_cast<GoldenState>(index)))
        ++index;
    if (index == golden_state_count || !valid_snapshot_name(entry.name))
        throw std::runtime_error("found the state \"" + state + "\" of \"" + entry.name + "\"");
    entry.state = static_cast<GoldenState>(index);
    entry.message = json.value("message", "");
    entry.seconds = json.value("seconds", 0.0);
    entry.drawing_s = json.value("drawing_s", 0.0);
    entry.matched = json.value("matched", "");
    entry.history = json.value("history", std::vector<std::string>());
    entry.coverage = {json.value("reached", std::set<std::string>()),
                      json.value("there", std::set<std::string>())};
    if (json.contains("pixels")) {
        const Numbers& pixels = json["pixels"];
        Comparison& c = entry.comparison;
        c.verdict = pixels.at("verdict").get<std::string>();
        c.same = pixels.at("same").get<bool>();
        c.size_differs = pixels.at("size_differs").get<bool>();
        c.max_delta = pixels.at("largest").get<int>();
        c.differing = pixels.at("differing").get<std::size_t>();
        c.allowed = pixels.at("allowed").get<std::size_t>();
        c.densest_window = pixels.at("densest").get<int>();
        c.densest_x = pixels.at("at").at(0).get<int>();
        c.densest_y = pixels.at("at").at(1).get<int>();
    }
    for (const Numbers& finding : json.value("findings", Numbers::array()))
        entry.findings.push_back({cause_of(finding), finding.at("pixels").get<std::size_t>(),
                                  finding.at("text").get<std::string>(), finding.value("act", true)});
    for (const Numbers& number : json.value("numbers", Numbers::array())) {
        auto path = number.at("path").get<std::string>();
        if (!path.starts_with('/'))
            throw std::runtime_error("found the number's path \"" + path +
                                     "\"; expected one that begins with /");
        entry.numbers.push_back({std::move(path), cause_of(number), number.at("expected").get<std::string>(),
                                 number.at("actual").get<std::string>(), number.at("decides").get<bool>()});
    }
    const Numbers sweep = json.value("sweep", Numbers::array());
    for (std::size_t i = 0; i < std::min(sweep.size(), entry.sweep.size()); ++i)
        entry.sweep[i] = {sweep[i].at(0).get<int>(), sweep[i].at(1).get<std::size_t>()};
    return entry;
}

// The last member of a report: a hash of all members before it.
std::string checksum_of(const Numbers& json) {
    Hasher hasher;
    hasher.text(json.dump(-1, ' ', false, Numbers::error_handler_t::replace));
    return fmt::format("{:016x}", hasher.value());
}

// GitHub's escapes for the text after "::".
std::string annotation_text(std::string_view text) {
    std::string out;
    for (const char c : text)
        out += c == '%' ? "%25" : c == '\n' ? "%0A" : c == '\r' ? "%0D" : std::string(1, c);
    return out;
}

Status copy_images(const std::string& name, const fs::path& from, const fs::path& to) {
    for (const char* ending :
         {".expected.png", ".actual.png", ".actual.json", ".difference.png", ".first.png", ".second.png"}) {
        std::error_code error;
        const fs::path source = from / (name + ending), target = to / (name + ending);
        if (!fs::is_regular_file(source, error) || fs::equivalent(source, target, error)) continue;
        fs::create_directories(target.parent_path(), error);
        fs::copy_file(source, target, fs::copy_options::overwrite_existing, error);
        if (error) return Error{target.string(), "cannot be written: " + error.message()};
    }
    return {};
}

}  // namespace

std::size_t Report::count(GoldenState state) const {
    return static_cast<std::size_t>(std::count_if(
        entries.begin(), entries.end(), [&](const GoldenResult& entry) { return entry.state == state; }));
}

std::vector<std::string> not_reached(const Report& report) {
    Coverage all;
    for (const GoldenResult& entry : report.entries)
        all.add(entry.coverage);
    return all.there.empty() ? std::vector<std::string>() : not_reached(all);
}

void sort_by_severity(Report& report) {
    const auto key = [](const GoldenResult& entry) {
        const double fraction = entry.state == GoldenState::different
                                    ? static_cast<double>(entry.comparison.differing) /
                                          static_cast<double>(entry.comparison.allowed + 1)
                                    : 0.0;
        return std::tuple(severity(entry), -fraction, entry.name);
    };
    std::stable_sort(report.entries.begin(), report.entries.end(),
                     [&](const GoldenResult& a, const GoldenResult& b) { return key(a) < key(b); });
}

std::string entry_to_json(const GoldenResult& entry) {
    return entry_json(entry).dump(-1, ' ', false, Numbers::error_handler_t::replace);
}

Result<GoldenResult> entry_from_json(std::string_view json, const std::string& location) try {
    return entry_of(Numbers::parse(json));
} catch (const std::exception& exception) {
    return Error{location, fmt::format("is no report entry: {}", exception.what())};
}

std::string report_to_json(const Report& report) {
    Numbers json;
    json["version"] = 1;
    json["goldens"] = report.goldens;
    json["renderer"] = report.renderer;
    if (!report.shard.whole()) json["shard"] = shard_text(report.shard);
    if (!report.suite.empty()) json["suite"] = report.suite;
    json["seconds"] = report.seconds;
    json["entries"] = Numbers::array();
    for (const GoldenResult& entry : report.entries)
        json["entries"].push_back(entry_json(entry));
    json["checksum"] = checksum_of(json);
    return json.dump(1, ' ', false, Numbers::error_handler_t::replace) + "\n";
}

Result<Report> report_from_json(std::string_view text, const std::string& location) try {
    Numbers json = Numbers::parse(text);
    if (json.contains("checksum")) {
        const auto checksum = json.at("checksum").get<std::string>();
        json.erase("checksum");
        if (checksum != checksum_of(json))
            return Error{location, "is damaged: its checksum does not fit what it says"};
    }
    if (json.at("version") != 1) return Error{location + ":/version", "expected version 1"};
    Report report;
    report.goldens = json.at("goldens").get<std::string>();
    report.renderer = json.value("renderer", "");
    report.suite = json.value("suite", "");
    report.seconds = json.value("seconds", 0.0);
    if (json.contains("shard")) {
        const Result<Shard> shard = parse_shard(json.at("shard").get<std::string>(), location + ":/shard");
        if (!shard) return shard.error();
        report.shard = *shard;
    }
    for (const Numbers& entry : json.at("entries"))
        report.entries.push_back(entry_of(entry));
    return report;
} catch (const std::exception& exception) {
    return Error{location, fmt::format("is no report: {}", exception.what())};
}

bool can_be_approved(const GoldenResult& entry) {
    return entry.state == GoldenState::different || entry.state == GoldenState::missing ||
           entry.state == GoldenState::unreadable;
}

std::vector<ActRow> act_rows(const Report& report) {
    std::vector<ActRow> rows;
    std::map<std::string, std::size_t> known;
    const auto add = [&](const std::string& text, const std::string& word, std::size_t entry,
                         std::size_t pixels) {
        const auto [at, is_new] = known.emplace(word + " " + text, rows.size());
        if (is_new) rows.push_back({text, word, {}, 0});
        ActRow& row = rows[at->second];
        if (row.entries.empty() || row.entries.back() != entry) row.entries.push_back(entry);
        row.pixels = std::max(row.pixels, pixels);
    };
    for (std::size_t i = 0; i < report.entries.size(); ++i) {
        const GoldenResult& entry = report.entries[i];
        if (entry.state == GoldenState::same) continue;
        bool any = false;
        for (const Finding& finding : entry.findings) {
            if (!finding.act) continue;
            any = true;
            add(finding.text,
                entry.state == GoldenState::different ? cause_name(finding.cause)
                                                      : golden_state_name(entry.state),
                i, entry.comparison.differing);
        }
        if (any) continue;
        const bool common = entry.state == GoldenState::missing || entry.state == GoldenState::orphan;
        add(entry.state == GoldenState::missing ? "nothing is approved under this name"
            : entry.state == GoldenState::orphan
                ? "no snapshot makes this; `slipface snapshot approve --prune` removes it"
                : entry.message,
            golden_state_name(entry.state), i, common ? 0 : entry.comparison.differing);
    }
    std::stable_sort(rows.begin(), rows.end(),
                     [](const ActRow& a, const ActRow& b) { return a.entries.size() > b.entries.size(); });
    return rows;
}

std::string entries_text(const Report& report, const ActRow& row) {
    std::vector<std::string> images, inputs;
    for (const std::size_t entry : row.entries) {
        const std::string& name = report.entries[entry].name;
        if (is_input(name))
            inputs.push_back(name);
        else
            images.push_back(name);
    }
    const auto list = [](const std::vector<std::string>& names) {
        constexpr std::size_t most = 6;
        std::string text;
        for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
            text += (i > 0 ? ", " : "") + names[i];
        return names.size() > most ? fmt::format("{} and {} more", text, names.size() - most) : text;
    };
    std::string text =
        images.empty() ? "" : fmt::format("{}: {}", counted(images.size(), "image"), list(images));
    if (row.pixels > 0) text += fmt::format("; {} at most", counted(row.pixels, "pixel"));
    if (inputs.empty()) return text;
    return images.empty() ? list(inputs) + (row.word == "missing" ? "" : ", in no image")
                          : fmt::format("{}; {}", text, list(inputs));
}

std::string report_to_junit(const Report& report) {
    std::vector<JunitCase> cases;
    for (const GoldenResult& entry : report.entries)
        if (entry.state == GoldenState::same) cases.push_back({.name = entry.name, .seconds = entry.seconds});
    for (const ActRow& row : act_rows(report)) {
        JunitCase& one = cases.emplace_back();
        one.name = row.text;
        one.failure = row.word;
        one.message = fmt::format("{}: {} ({})", row.word, row.text, entries_text(report, row));
        for (const std::size_t entry : row.entries) {
            one.seconds = one.seconds.value_or(0.0) + report.entries[entry].seconds;
            one.details += fmt::format("{}: {}\n", report.entries[entry].name, report.entries[entry].message);
            if (!is_input(report.entries[entry].name))
                one.details += fmt::format("[[ATTACHMENT|{}.actual.png]]\n", report.entries[entry].name);
        }
    }
    return junit_text("snapshots", cases, report.seconds);
}

std::string report_to_annotations(const Report& report) {
    std::string lines;
    for (const ActRow& row : act_rows(report)) {
        const std::string& first = report.entries[row.entries.front()].name;
        lines += fmt::format(
            "::error file={}/{}{},title=Snapshots::{}\n", report.goldens, first,
            is_input(first) ? ".json" : ".png",
            annotation_text(fmt::format("{}: {}\n{}", row.word, row.text, entries_text(report, row))));
    }
    return lines;
}

std::string approve_command(const Report& report, const fs::path& out) {
    std::vector<std::string> names;
    for (const GoldenResult& entry : report.entries)
        if (can_be_approved(entry)) names.push_back(entry.name);
    if (names.empty()) return "";
    std::string command =
        fmt::format("slipface snapshot approve --from {}", (out / "report.json").generic_string());
    if (report.goldens != "screenshots") command += " --goldens " + report.goldens;
    if (names.size() <= 6)
        for (const std::string& name : names)
            command += " " + name;
    return command;
}

std::string suite_fingerprint(const std::vector<std::string>& names, const std::vector<fs::path>& files) {
    Hasher hasher;
    hasher.text(program_version());
    for (const std::string& name : names) {
        hasher.u64(name.size());
        hasher.text(name);
    }
    hasher.u64(fingerprint_of_files(files));
    return fmt::format("{:016x}", hasher.value());
}

Status write_report(const Report& report, const fs::path& out) {
    std::error_code error;
    fs::create_directories(out, error);
    for (const auto& [name, text] : {std::pair("report.json", report_to_json(report)),
                                     std::pair("report.html", report_to_html(report, out)),
                                     std::pair("junit.xml", report_to_junit(report))}) {
        if (Status status = write_file_atomic(out / name, text); !status) return status;
    }
    return write_report_images(report, out);
}

Result<Report> merge_reports(const std::vector<fs::path>& report_files, const fs::path& out) {
    Report merged;
    std::set<std::string> names;
    std::vector<ShardFile> shards;
    std::vector<Report> parts;
    for (const fs::path& file : report_files) {
        const Result<std::string> text = read_file(file, largest_report);
        if (!text) return text.error();
        Result<Report> part = report_from_json(*text, file.string());
        if (!part) return part.error();
        shards.push_back({file.string(), part->shard});
        parts.push_back(std::move(*part));
        const Report &first = parts.front(), &last = parts.back();
        if (last.suite != first.suite || last.goldens != first.goldens)
            return Error{
                file.string(),
                fmt::format("is part of another check than {}: other goldens, levels or scripts, another "
                            "choice of snapshots, or another version of the program",
                            shards.front().file)};
    }
    if (Status status = check_shards_complete(shards, "snapshot merge"); !status) return status.error();
    merged.suite = parts.front().suite;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        Report* const part = &parts[i];
        const fs::path& file = report_files[i];
        merged.goldens = part->goldens;
        if (!part->renderer.empty()) merged.renderer = part->renderer;
        merged.seconds = std::max(merged.seconds, part->seconds);
        for (GoldenResult& entry : part->entries) {
            if (!names.insert(entry.name).second) {
                if (entry.state == GoldenState::orphan) continue;
                return Error{file.string(), fmt::format("\"{}\" is in another report, too", entry.name)};
            }
            if (Status status = copy_images(entry.name, file.parent_path(), out); !status)
                return status.error();
            merged.entries.push_back(std::move(entry));
        }
    }
    sort_by_severity(merged);
    return merged;
}

}  // namespace slipface

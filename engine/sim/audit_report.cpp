// An audit's report as JSON, and merging the parts of an audit.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "slipface/base/counted.h"
#include "slipface/base/hash.h"
#include "slipface/sim/audit.h"

namespace slipface {
namespace {

using Json = nlohmann::ordered_json;

constexpr int version = 4;

std::string hex(std::uint64_t value) {
    return fmt::format("{:016x}", value);
}

// Of all that stands before it, so that a report that lost or changed a byte is not merged.
std::string checksum_of(const Json& json) {
    Hasher hasher;
    hasher.text(json.dump(-1, ' ', false, Json::error_handler_t::replace));
    return hex(hasher.value());
}

Json finding_json(const AuditFinding& finding) {
    Json json;
    json["kind"] = info_of(finding.kind).name;
    json["text"] = finding.text;
    json["walker"] = finding.walker;
    json["life"] = finding.life;
    json["tick"] = finding.tick;
    json["position"] = {finding.position.x(), finding.position.y(), finding.position.z()};
    json["amount"] = finding.amount;
    if (finding.face != no_id) json["face"] = finding.face;
    if (finding.other != no_id) json["other"] = finding.other;
    json["hash"] = hex(finding.hash);
    return json;
}

// Faces that saw nothing are left out: [face, visits, lost, stood, stuck, missed ground].
Json heat_json(const std::vector<FaceHeat>& heat) {
    Json json = Json::array();
    for (std::size_t face = 0; face < heat.size(); ++face) {
        const FaceHeat& h = heat[face];
        if (h.visits + h.lost_us + h.stood + h.stuck + h.missed_ground == 0) continue;
        json.push_back({face, h.visits, h.lost_us, h.stood, h.stuck, h.missed_ground});
    }
    return json;
}

// Reads one object; the first thing that is not as expected is kept as the error.
class Reader {
  public:
    Reader(const Json& json, std::string location) : json_(json), location_(std::move(location)) {}

    template <class T>
    T number(const char* key) {
        const Json* value = member(key);
        if (value && value->is_number_unsigned() && std::is_unsigned_v<T> &&
            value->get<std::uint64_t>() <= std::numeric_limits<T>::max())
            return value->get<T>();
        fail(key, fmt::format("a whole number from 0 to {}", std::numeric_limits<T>::max()));
        return {};
    }
    double real(const char* key) {
        const Json* value = member(key);
        if (value && value->is_number()) return value->get<double>();
        fail(key, "a number");
        return 0.0;
    }
    std::string text(const char* key) {
        const Json* value = member(key);
        if (value && value->is_string()) return value->get<std::string>();
        fail(key, "a text");
        return {};
    }
    std::uint64_t hexadecimal(const char* key) {
        const std::string digits = text(key);
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
        if (digits.size() != 16 || error != std::errc() || end != digits.data() + digits.size())
            fail(key, "16 hexadecimal digits");
        return value;
    }
    bool truth(const char* key) {
        const Json* value = member(key);
        if (value && value->is_boolean()) return value->get<bool>();
        fail(key, "true or false");
        return false;
    }
    // The elements of an array of numbers.
    template <class T>
    std::vector<T> list(const char* key) {
        std::vector<T> result;
        const Json* value = member(key);
        if (!value || !value->is_array()) return fail(key, "a list"), result;
        for (const Json& item : *value) {
            const bool fits = std::is_unsigned_v<T> ? item.is_number_unsigned() : item.is_number();
            if (!fits) return fail(key, "a list of numbers"), result;
            result.push_back(item.get<T>());
        }
        return result;
    }
    const Json* member(const char* key) const {
        const auto found = json_.find(key);
        return found == json_.end() ? nullptr : &*found;
    }
    void fail(const char* key, const std::string& expected) {
        if (!error_) error_ = Error{location_ + "/" + key, "expected " + expected};
    }
    const std::optional<Error>& error() const { return error_; }

  private:
    const Json& json_;
    std::string location_;
    std::optional<Error> error_;
};

std::optional<FindingKind> kind_named(std::string_view name) {
    for (std::size_t i = 0; i < finding_kind_count; ++i)
        if (info_of(static_cast<FindingKind>(i)).name == name) return static_cast<FindingKind>(i);
    return std::nullopt;
}

Result<AuditFinding> read_finding(const Json& json, const std::string& location) {
    if (!json.is_object()) return Error{location, "expected an object"};
    Reader reader(json, location);
    AuditFinding finding;
    const std::string kind = reader.text("kind");
    const auto named = kind_named(kind);
    if (named)
        finding.kind = *named;
    else
        reader.fail("kind", "passed_through, left_level, overlap or stuck, found \"" + kind + "\"");
    finding.text = reader.text("text");
    finding.walker = reader.number<std::uint32_t>("walker");
    finding.life = reader.number<std::uint32_t>("life");
    finding.tick = reader.number<std::uint64_t>("tick");
    const std::vector<double> position = reader.list<double>("position");
    if (position.size() == 3)
        finding.position = {position[0], position[1], position[2]};
    else
        reader.fail("position", "three numbers");
    finding.amount = reader.real("amount");
    if (reader.member("face")) finding.face = reader.number<std::uint32_t>("face");
    if (reader.member("other")) finding.other = reader.number<std::uint32_t>("other");
    finding.hash = reader.hexadecimal("hash");
    if (reader.error()) return *reader.error();
    return finding;
}

constexpr std::size_t max_heat_faces = 100'000'000;

Status read_heat(const Json& json, std::size_t faces, const std::string& location,
                 std::vector<FaceHeat>& heat) {
    if (!json.is_array() || faces > max_heat_faces) return Error{location, "expected a list of faces"};
    heat.resize(faces);
    for (const Json& row : json) {
        const bool fits =
            row.is_array() && row.size() == 6 &&
            std::all_of(row.begin(), row.end(), [](const auto& v) { return v.is_number_unsigned(); });
        if (!fits || row[0].get<std::uint64_t>() >= faces)
            return Error{location,
                         fmt::format("expected rows of six whole numbers, the first below {}", faces)};
        heat[row[0].get<std::size_t>()] = {row[1].get<std::uint64_t>(), row[2].get<std::uint64_t>(),
                                           row[3].get<std::uint64_t>(), row[4].get<std::uint64_t>(),
                                           row[5].get<std::uint64_t>()};
    }
    return {};
}

// What two parts do not have in common though parts of one audit must; empty if nothing.
std::string difference(const AuditReport& a, const AuditReport& b) {
    std::string words;
    const auto compare = [&](bool same, const char* what) {
        if (!same) words += words.empty() ? what : std::string(", ") + what;
    };
    compare(a.level_fingerprint == b.level_fingerprint, "geometry");
    compare(a.scene_fingerprint == b.scene_fingerprint,
            "surface types, spawn, platforms, terrain, sectors or fall limit");
    compare(a.settings_hash == b.settings_hash, "settings");
    compare(a.program == b.program, "program");
    compare(a.walkers == b.walkers, "number of walkers");
    compare(a.duration_s == b.duration_s, "duration");
    compare(a.seed == b.seed, "seed");
    compare(a.dt_text == b.dt_text, "seconds per step");
    compare(a.speeds == b.speeds, "speeds");
    compare(a.starts == b.starts && a.starts_hash == b.starts_hash, "starts");
    compare(a.heat.size() == b.heat.size(), "heat");
    return words;
}

}  // namespace

std::string audit_to_json(const AuditReport& report) {
    Json json;
    json["slipface_audit"] = version;
    json["level"] = report.level_name;
    json["fingerprint"] = hex(report.level_fingerprint);
    json["scene"] = hex(report.scene_fingerprint);
    json["settings"] = hex(report.settings_hash);
    json["program"] = report.program;
    json["walkers"] = report.walkers;
    json["duration_s"] = report.duration_s;
    json["seed"] = report.seed;
    json["dt"] = report.dt_text;
    json["speeds"] = report.speeds;
    if (report.starts > 0) {
        json["starts"] = report.starts;
        json["starts_hash"] = hex(report.starts_hash);
    }
    if (!report.shard.whole()) json["shard"] = shard_text(report.shard);
    json["closed"] = report.closed;
    if (report.cancelled) json["cancelled"] = true;
    json["steps"] = report.steps;
    if (report.untried > 0) json["untried"] = report.untried;
    json["lives"] = report.lives;
    json["hazards"] = report.hazards;
    json["crushed"] = report.crushed;
    json["left"] = report.left;
    json["exits"] = Json::array();
    for (const AuditExit& exit : report.exits)
        json["exits"].push_back(
            {exit.face, exit.times, exit.walker, exit.position.x(), exit.position.y(), exit.position.z()});
    json["falls"] = report.falls;
    for (std::size_t kind = 0; kind < finding_kind_count; ++kind)
        json[std::string("count_") + info_of(static_cast<FindingKind>(kind)).name] = report.counts[kind];
    json["hash"] = hex(report.hash);
    json["findings"] = Json::array();
    for (const AuditFinding& finding : report.findings)
        json["findings"].push_back(finding_json(finding));
    if (!report.heat.empty()) {
        json["faces"] = report.heat.size();
        json["heat"] = heat_json(report.heat);
    }
    json["checksum"] = checksum_of(json);
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<AuditReport> audit_from_json(std::string_view text, const std::string& location) {
    Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) return Error{location, "is no complete audit report: expected a JSON object"};
    Reader reader(json, location + ":");
    if (const auto found = reader.number<std::uint32_t>("slipface_audit"); found != version)
        return Error{location, fmt::format("found audit version {}, expected {}", found, version)};
    const std::string checksum = reader.text("checksum");
    Json unsigned_json = json;
    unsigned_json.erase("checksum");
    if (!reader.error() && checksum != checksum_of(unsigned_json))
        return Error{location, "is damaged: its checksum does not match"};
    AuditReport report;
    report.level_name = reader.text("level");
    report.level_fingerprint = reader.hexadecimal("fingerprint");
    report.scene_fingerprint = reader.hexadecimal("scene");
    report.settings_hash = reader.hexadecimal("settings");
    report.program = reader.text("program");
    report.walkers = reader.number<std::uint32_t>("walkers");
    report.duration_s = reader.real("duration_s");
    report.seed = reader.number<std::uint64_t>("seed");
    report.dt_text = reader.text("dt");
    report.speeds = reader.list<double>("speeds");
    if (reader.member("starts")) {
        report.starts = reader.number<std::uint64_t>("starts");
        report.starts_hash = reader.hexadecimal("starts_hash");
    }
    if (reader.member("shard")) {
        const Result<Shard> shard = parse_shard(reader.text("shard"), location + ":/shard");
        if (!shard) return shard.error();
        report.shard = *shard;
    }
    report.closed = reader.truth("closed");
    report.cancelled = reader.member("cancelled") && reader.truth("cancelled");
    report.steps = reader.number<std::uint64_t>("steps");
    if (reader.member("untried")) report.untried = reader.number<std::uint64_t>("untried");
    report.lives = reader.number<std::uint64_t>("lives");
    report.hazards = reader.number<std::uint64_t>("hazards");
    report.crushed = reader.number<std::uint64_t>("crushed");
    report.left = reader.number<std::uint64_t>("left");
    report.falls = reader.number<std::uint64_t>("falls");
    for (std::size_t kind = 0; kind < finding_kind_count; ++kind) {
        const std::string key = std::string("count_") + info_of(static_cast<FindingKind>(kind)).name;
        report.counts[kind] = reader.number<std::uint64_t>(key.c_str());
    }
    report.hash = reader.hexadecimal("hash");
    const Json* findings = reader.member("findings");
    if (!findings || !findings->is_array()) reader.fail("findings", "a list");
    const Json* exits = reader.member("exits");
    if (!exits || !exits->is_array()) reader.fail("exits", "a list");
    if (reader.error()) return *reader.error();
    for (std::size_t i = 0; i < exits->size(); ++i) {
        const Json& one = (*exits)[i];
        const auto is_number = [](const Json& value) { return value.is_number(); };
        const bool whole = one.is_array() && one.size() == 6 &&
                           std::all_of(one.begin(), one.end(), is_number) &&
                           std::all_of(one.begin(), one.begin() + 3,
                                       [](const Json& value) { return value.is_number_unsigned(); });
        if (!whole)
            return Error{fmt::format("{}:/exits/{}", location, i),
                         "found something else, expected [face, times, walker, x, y, z]"};
        report.exits.push_back({one[0].get<FaceId>(),
                                one[1].get<std::uint64_t>(),
                                one[2].get<std::uint32_t>(),
                                {one[3].get<double>(), one[4].get<double>(), one[5].get<double>()}});
    }
    for (std::size_t i = 0; i < findings->size(); ++i) {
        auto finding = read_finding((*findings)[i], fmt::format("{}:/findings/{}", location, i));
        if (!finding) return finding.error();
        report.findings.push_back(std::move(*finding));
    }
    if (const Json* heat = reader.member("heat")) {
        const auto faces = reader.number<std::uint64_t>("faces");
        if (reader.error()) return *reader.error();
        if (Status status = read_heat(*heat, faces, location + ":/heat", report.heat); !status.ok())
            return status.error();
    }
    return report;
}

std::vector<AuditExit> summed_exits(std::vector<AuditExit> exits) {
    std::ranges::stable_sort(exits, {},
                             [](const AuditExit& exit) { return std::pair(exit.face, exit.walker); });
    std::vector<AuditExit> sums;
    for (const AuditExit& exit : exits) {
        if (sums.empty() || sums.back().face != exit.face)
            sums.push_back(exit);
        else
            sums.back().times += exit.times;
    }
    return sums;
}

std::vector<AuditExit> busiest_first(std::vector<AuditExit> exits) {
    std::ranges::stable_sort(exits, std::greater(), &AuditExit::times);
    return exits;
}

std::string exit_text(const AuditExit& exit) {
    return counted(exit.times, "time") +
           (exit.face == no_id ? std::string() : fmt::format(", last from face {}", exit.face));
}

Result<AuditReport> merge_audits(const std::vector<AuditPart>& parts) {
    std::vector<ShardFile> shards;
    for (const auto& [file, report] : parts) {
        const std::string words = difference(parts.front().report, report);
        if (!words.empty())
            return Error{file, fmt::format("is part of another audit than {}: they differ in {}",
                                           parts.front().file, words)};
        shards.push_back({file, report.shard});
    }
    if (Status status = check_shards_complete(shards, "audit merge"); !status) return status.error();
    AuditReport whole = parts.front().report;
    for (const AuditPart& part : std::span(parts).subspan(1)) {
        const AuditReport& report = part.report;
        whole.cancelled |= report.cancelled;
        whole.steps += report.steps;
        whole.untried += report.untried;
        whole.lives += report.lives;
        whole.hazards += report.hazards;
        whole.crushed += report.crushed;
        whole.left += report.left;
        whole.exits.insert(whole.exits.end(), report.exits.begin(), report.exits.end());
        whole.falls += report.falls;
        whole.hash += report.hash;
        for (std::size_t kind = 0; kind < whole.counts.size(); ++kind)
            whole.counts[kind] += report.counts[kind];
        whole.findings.insert(whole.findings.end(), report.findings.begin(), report.findings.end());
        for (std::size_t face = 0; face < whole.heat.size(); ++face)
            whole.heat[face] += report.heat[face];
    }
    // A walker's findings stay in the order in which they happened.
    std::stable_sort(whole.findings.begin(), whole.findings.end(),
                     [](const AuditFinding& a, const AuditFinding& b) { return a.walker < b.walker; });
    whole.exits = summed_exits(std::move(whole.exits));
    whole.shard = {};
    return whole;
}

}  // namespace slipface

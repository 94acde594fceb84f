// An audit's report as JSON, and the parts of an audit as one.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "slipface/sim/audit.h"

namespace slipface {
namespace {

using Json = nlohmann::ordered_json;

constexpr int version = 2;

std::string hex(std::uint64_t value) {
    return fmt::format("{:016x}", value);
}

Json finding_json(const AuditFinding& finding) {
    Json json;
    json["kind"] = finding_names[static_cast<std::size_t>(finding.kind)];
    json["walker"] = finding.walker;
    json["life"] = finding.life;
    json["tick"] = finding.tick;
    json["position"] = {finding.position.x(), finding.position.y(), finding.position.z()};
    json["amount"] = finding.amount;
    if (finding.face != no_id) json["face"] = finding.face;
    json["hash"] = hex(finding.hash);
    return json;
}

// Faces that saw nothing are left out: [face, visited, stuck, missed ground, lost].
Json heat_json(const std::vector<FaceHeat>& heat) {
    Json json = Json::array();
    for (std::size_t face = 0; face < heat.size(); ++face) {
        const FaceHeat& h = heat[face];
        if (h.visited + h.stuck + h.missed_ground + h.lost_mm_s == 0) continue;
        json.push_back({face, h.visited, h.stuck, h.missed_ground, h.lost_mm_s});
    }
    return json;
}

// Reads one object; the first thing that is not as expected is kept as the error.
class Reader {
  public:
    Reader(const nlohmann::json& json, std::string place) : json_(json), place_(std::move(place)) {}

    template <class T>
    T number(const char* key) {
        const nlohmann::json* value = member(key);
        if (value && value->is_number_unsigned() && std::is_unsigned_v<T> &&
            value->get<std::uint64_t>() <= std::numeric_limits<T>::max())
            return value->get<T>();
        fail(key, fmt::format("a whole number from 0 to {}", std::numeric_limits<T>::max()));
        return {};
    }
    double real(const char* key) {
        const nlohmann::json* value = member(key);
        if (value && value->is_number()) return value->get<double>();
        fail(key, "a number");
        return 0.0;
    }
    std::string text(const char* key) {
        const nlohmann::json* value = member(key);
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
        const nlohmann::json* value = member(key);
        if (value && value->is_boolean()) return value->get<bool>();
        fail(key, "true or false");
        return false;
    }
    // The elements of an array of numbers.
    template <class T>
    std::vector<T> list(const char* key) {
        std::vector<T> result;
        const nlohmann::json* value = member(key);
        if (!value || !value->is_array()) return fail(key, "a list"), result;
        for (const nlohmann::json& item : *value) {
            const bool fits = std::is_unsigned_v<T> ? item.is_number_unsigned() : item.is_number();
            if (!fits) return fail(key, "a list of numbers"), result;
            result.push_back(item.get<T>());
        }
        return result;
    }
    const nlohmann::json* member(const char* key) const {
        const auto found = json_.find(key);
        return found == json_.end() ? nullptr : &*found;
    }
    void fail(const char* key, const std::string& expected) {
        if (!error_) error_ = Error{place_ + "/" + key, "expected " + expected};
    }
    const std::optional<Error>& error() const { return error_; }

  private:
    const nlohmann::json& json_;
    std::string place_;
    std::optional<Error> error_;
};

Result<AuditFinding> read_finding(const nlohmann::json& json, const std::string& place) {
    if (!json.is_object()) return Error{place, "expected an object"};
    Reader reader(json, place);
    AuditFinding finding;
    const std::string kind = reader.text("kind");
    const auto name = std::find(finding_names.begin(), finding_names.end(), kind);
    if (name == finding_names.end())
        reader.fail("kind", "escape, overlap or stuck, found \"" + kind + "\"");
    else
        finding.kind = static_cast<FindingKind>(name - finding_names.begin());
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
    finding.hash = reader.hexadecimal("hash");
    if (reader.error()) return *reader.error();
    return finding;
}

constexpr std::size_t max_heat_faces = 100'000'000;

Status read_heat(const nlohmann::json& json, std::size_t faces, const std::string& place,
                 std::vector<FaceHeat>& heat) {
    if (!json.is_array() || faces > max_heat_faces) return Error{place, "expected a list of faces"};
    heat.resize(faces);
    for (const nlohmann::json& row : json) {
        const bool fits =
            row.is_array() && row.size() == 5 &&
            std::all_of(row.begin(), row.end(), [](const auto& v) { return v.is_number_unsigned(); });
        if (!fits || row[0].get<std::uint64_t>() >= faces)
            return Error{place,
                         fmt::format("expected rows of five whole numbers, the first below {}", faces)};
        heat[row[0].get<std::size_t>()] = {row[1].get<std::uint64_t>(), row[2].get<std::uint64_t>(),
                                           row[3].get<std::uint64_t>(), row[4].get<std::uint64_t>()};
    }
    return {};
}

bool same_audit(const AuditReport& a, const AuditReport& b) {
    return a.level_fingerprint == b.level_fingerprint && a.settings_hash == b.settings_hash &&
           a.walkers == b.walkers && a.duration_s == b.duration_s && a.seed == b.seed &&
           a.dt_text == b.dt_text && a.speeds == b.speeds && a.shard_count == b.shard_count &&
           a.heat.size() == b.heat.size();
}

}  // namespace

std::string audit_to_json(const AuditReport& report) {
    Json json;
    json["slipface_audit"] = version;
    json["level"] = report.level_name;
    json["fingerprint"] = hex(report.level_fingerprint);
    json["settings"] = hex(report.settings_hash);
    json["walkers"] = report.walkers;
    json["duration_s"] = report.duration_s;
    json["seed"] = report.seed;
    json["dt"] = report.dt_text;
    json["speeds"] = report.speeds;
    if (report.shards.size() < report.shard_count) {  // a whole audit says nothing of its parts
        json["shard_count"] = report.shard_count;
        json["shards"] = report.shards;
    }
    json["closed"] = report.closed;
    if (report.cancelled) json["cancelled"] = true;
    json["steps"] = report.steps;
    json["lives"] = report.lives;
    json["hazards"] = report.hazards;
    json["crushed"] = report.crushed;
    json["left"] = report.left;
    for (std::size_t kind = 0; kind < finding_names.size(); ++kind)
        json[std::string("count_") + finding_names[kind]] = report.counts[kind];
    json["hash"] = hex(report.hash);
    json["findings"] = Json::array();
    for (const AuditFinding& finding : report.findings)
        json["findings"].push_back(finding_json(finding));
    if (!report.heat.empty()) {
        json["faces"] = report.heat.size();
        json["heat"] = heat_json(report.heat);
    }
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<AuditReport> audit_from_json(std::string_view text, const std::string& place) {
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) return Error{place, "is no audit report: expected a JSON object"};
    Reader reader(json, place + ":");
    if (const auto found = reader.number<std::uint32_t>("slipface_audit"); found != version)
        return Error{place, fmt::format("found audit version {}, expected {}", found, version)};
    AuditReport report;
    report.level_name = reader.text("level");
    report.level_fingerprint = reader.hexadecimal("fingerprint");
    report.settings_hash = reader.hexadecimal("settings");
    report.walkers = reader.number<std::uint32_t>("walkers");
    report.duration_s = reader.real("duration_s");
    report.seed = reader.number<std::uint64_t>("seed");
    report.dt_text = reader.text("dt");
    report.speeds = reader.list<double>("speeds");
    report.shards = {0};
    if (reader.member("shards")) {
        report.shard_count = reader.number<std::uint32_t>("shard_count");
        report.shards = reader.list<std::uint32_t>("shards");
    }
    report.closed = reader.truth("closed");
    report.cancelled = reader.member("cancelled") && reader.truth("cancelled");
    report.steps = reader.number<std::uint64_t>("steps");
    report.lives = reader.number<std::uint64_t>("lives");
    report.hazards = reader.number<std::uint64_t>("hazards");
    report.crushed = reader.number<std::uint64_t>("crushed");
    report.left = reader.number<std::uint64_t>("left");
    for (std::size_t kind = 0; kind < finding_names.size(); ++kind)
        report.counts[kind] =
            reader.number<std::uint64_t>((std::string("count_") + finding_names[kind]).c_str());
    report.hash = reader.hexadecimal("hash");
    const nlohmann::json* findings = reader.member("findings");
    if (!findings || !findings->is_array()) reader.fail("findings", "a list");
    if (reader.error()) return *reader.error();
    for (std::size_t i = 0; i < findings->size(); ++i) {
        auto finding = read_finding((*findings)[i], fmt::format("{}:/findings/{}", place, i));
        if (!finding) return finding.error();
        report.findings.push_back(std::move(*finding));
    }
    if (const nlohmann::json* heat = reader.member("heat")) {
        const auto faces = reader.number<std::uint64_t>("faces");
        if (reader.error()) return *reader.error();
        if (Status status = read_heat(*heat, faces, place + ":/heat", report.heat); !status.ok())
            return status.error();
    }
    return report;
}

Result<AuditReport> merge_audits(const std::vector<AuditReport>& parts) {
    if (parts.empty()) return Error{"audit merge", "expected at least one report"};
    AuditReport whole = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const AuditReport& part = parts[i];
        if (!same_audit(whole, part))
            return Error{"audit merge",
                         fmt::format("report {} is of another audit: level, settings, walkers, "
                                     "duration, seed, step, speeds, shards or heat differ",
                                     i + 1)};
        for (const std::uint32_t shard : part.shards) {
            if (std::find(whole.shards.begin(), whole.shards.end(), shard) != whole.shards.end())
                return Error{"audit merge", fmt::format("shard {} comes twice", shard)};
            whole.shards.push_back(shard);
        }
        whole.cancelled |= part.cancelled;
        whole.steps += part.steps;
        whole.lives += part.lives;
        whole.hazards += part.hazards;
        whole.crushed += part.crushed;
        whole.left += part.left;
        whole.hash += part.hash;
        for (std::size_t kind = 0; kind < whole.counts.size(); ++kind)
            whole.counts[kind] += part.counts[kind];
        whole.findings.insert(whole.findings.end(), part.findings.begin(), part.findings.end());
        for (std::size_t face = 0; face < whole.heat.size(); ++face) {
            whole.heat[face].visited += part.heat[face].visited;
            whole.heat[face].stuck += part.heat[face].stuck;
            whole.heat[face].missed_ground += part.heat[face].missed_ground;
            whole.heat[face].lost_mm_s += part.heat[face].lost_mm_s;
        }
    }
    std::sort(whole.shards.begin(), whole.shards.end());
    // A walker's findings stay in the order in which they happened.
    std::stable_sort(whole.findings.begin(), whole.findings.end(),
                     [](const AuditFinding& a, const AuditFinding& b) { return a.walker < b.walker; });
    if (whole.shards.size() == whole.shard_count) {
        whole.shard_count = 1;
        whole.shards = {0};
    }
    return whole;
}

}  // namespace slipface

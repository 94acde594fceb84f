#include "slipface/sim/probe_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "slipface/base/text.h"
#include "slipface/sim/tape.h"

namespace slipface {
namespace {

// Names stand as one word.
std::string word(std::string name) {
    for (char& c : name)
        if (c == ' ') c = '_';
    return name;
}

// Every value of the enumeration has a name, and the first that has none ends it.
template <class T>
std::optional<T> find_name(const char* (*name)(T), std::string_view text) {
    for (std::uint8_t i = 0; std::string_view(name(static_cast<T>(i))) != "unknown"; ++i)
        if (word(name(static_cast<T>(i))) == text) return static_cast<T>(i);
    return std::nullopt;
}

std::string vector_word(const Vec3& v) {
    return to_text(v.x()) + "," + to_text(v.y()) + "," + to_text(v.z());
}

std::string sweep_line(const ProbeTest::Sweep& sweep) {
    std::string line = "sweep " + word(pass_name(sweep.pass));
    if (!sweep.contact) return line + " free";
    const Contact& contact = *sweep.contact;
    line += fmt::format(" {} face {} triangle {} {} {}", to_text(contact.t), contact.face, contact.triangle,
                        feature_name(contact.feature), vector_word(contact.normal));
    return sweep.rule ? line + " " + word(rule_name(*sweep.rule)) : line;
}

std::vector<std::string_view> words_of_line(std::string_view line) {
    std::vector<std::string_view> words;
    for (const std::string_view part : split(line, ' '))
        if (!trim(part).empty()) words.push_back(trim(part));
    return words;
}

std::optional<std::uint32_t> parse_id(std::string_view text) {
    const auto number = parse_int(text);
    if (!number || *number < 0 || *number > no_id) return std::nullopt;
    return static_cast<std::uint32_t>(*number);
}

std::optional<ProbeTest::Sweep> parse_sweep(const std::vector<std::string_view>& words) {
    if (words.size() < 3) return std::nullopt;
    const auto pass = find_name(pass_name, words[1]);
    if (!pass) return std::nullopt;
    ProbeTest::Sweep sweep{*pass, std::nullopt, std::nullopt};
    if (words.size() == 3 && words[2] == "free") return sweep;
    if (words.size() < 9 || words.size() > 10 || words[3] != "face" || words[5] != "triangle")
        return std::nullopt;
    const auto t = parse_double(words[2]);
    const auto face = parse_id(words[4]), triangle = parse_id(words[6]);
    const auto feature = find_name(feature_name, words[7]);
    const auto normal = parse_vec3(words[8]);
    if (!t || !face || !triangle || !feature || !normal) return std::nullopt;
    sweep.contact = Contact{.t = *t,
                            .normal = *normal,
                            .point = Vec3::Zero(),
                            .triangle = *triangle,
                            .face = *face,
                            .surface = default_surface,
                            .feature = *feature};
    if (words.size() == 10) {
        sweep.rule = find_name(rule_name, words[9]);
        if (!sweep.rule) return std::nullopt;
    }
    return sweep;
}

bool same_contact(const Contact& a, const Contact& b, double tolerance) {
    return std::abs(a.t - b.t) <= tolerance && (a.normal - b.normal).norm() <= tolerance &&
           a.face == b.face && a.triangle == b.triangle && a.feature == b.feature;
}

bool same_sweep(const ProbeTest::Sweep& a, const ProbeTest::Sweep& b, double tolerance) {
    if (a.pass != b.pass || a.rule != b.rule || a.contact.has_value() != b.contact.has_value()) return false;
    return !a.contact || same_contact(*a.contact, *b.contact, tolerance);
}

// Reads the value of one line into the test; false if it is none.
bool read_line(ProbeTest& test, const std::vector<std::string_view>& words, std::string_view line) {
    const auto vector = [&](Vec3& into) {
        const auto value = words.size() == 2 ? parse_vec3(words[1]) : std::nullopt;
        if (value) into = *value;
        return value.has_value();
    };
    if (words[0] == "from") return vector(test.from);
    if (words[0] == "move") return vector(test.move);
    if (words[0] == "end") return vector(test.end);
    if (words[0] == "set") return set_setting(test.settings, trim(line.substr(3))).ok();
    if (words[0] == "tolerance") {
        const auto value = words.size() == 2 ? parse_double(words[1]) : std::nullopt;
        if (value && *value >= 0.0) test.tolerance = *value;
        return value && *value >= 0.0;
    }
    if (words[0] == "level") {
        if (words.size() < 2) return false;
        std::size_t last = words.size();
        std::uint64_t hash = 0;
        const std::string_view end = words.back();
        const auto [stop, error] = std::from_chars(end.data(), end.data() + end.size(), hash, 16);
        if (words.size() > 2 && end.size() == 16 && error == std::errc() && stop == end.data() + end.size()) {
            test.level_fingerprint = hash;
            --last;
        }
        const char* const begin = words[1].data();
        const char* const behind = words[last - 1].data() + words[last - 1].size();
        test.level_name = from_one_line({begin, static_cast<std::size_t>(behind - begin)});
        return true;
    }
    if (words[0] == "sweep") {
        const auto sweep = parse_sweep(words);
        if (sweep) test.sweeps.push_back(*sweep);
        return sweep.has_value();
    }
    return false;
}

}  // namespace

ProbeTest make_probe_test(const MovementScene& scene, const MovementSettings& settings, const Vec3& from,
                          const Vec3& move) {
    ProbeTest test;
    test.settings = settings;
    test.from = from;
    test.move = move;
    TraceRecorder recorder;
    test.end = slide_move(scene, settings, from, move, &recorder).position;
    for (const TraceRecord& record : recorder.records) {
        if (const auto* sweep = std::get_if<SweepRecord>(&record))
            test.sweeps.push_back({sweep->pass, sweep->contact, std::nullopt});
        else if (const auto* response = std::get_if<ResponseRecord>(&record);
                 response && !test.sweeps.empty())
            test.sweeps.back().rule = response->rule;
    }
    return test;
}

std::vector<std::string> run_probe_test(const ProbeTest& test, const MovementScene& scene) {
    const ProbeTest now = make_probe_test(scene, test.settings, test.from, test.move);
    std::vector<std::string> differences;
    for (std::size_t i = 0; i < std::max(now.sweeps.size(), test.sweeps.size()); ++i) {
        const bool found = i < now.sweeps.size(), expected = i < test.sweeps.size();
        if (found && expected && same_sweep(now.sweeps[i], test.sweeps[i], test.tolerance)) continue;
        differences.push_back(fmt::format("sweep {}: found \"{}\", expected \"{}\"", i + 1,
                                          found ? sweep_line(now.sweeps[i]) : "none",
                                          expected ? sweep_line(test.sweeps[i]) : "none"));
    }
    if (!((now.end - test.end).norm() <= test.tolerance)) {
        differences.push_back(
            fmt::format("end: found {}, expected {}", vector_word(now.end), vector_word(test.end)));
    }
    return differences;
}

std::string probe_test_to_text(const ProbeTest& test) {
    std::string text = "slipface-probe 1\n";
    if (!test.level_name.empty()) {
        text += "level " + on_one_line(test.level_name);
        if (test.level_fingerprint) text += fmt::format(" {:016x}", *test.level_fingerprint);
        text += '\n';
    }
    for (const std::string& setting : setting_changes(basic_settings(), test.settings))
        text += "set " + setting + "\n";
    text += "from " + vector_word(test.from) + "\nmove " + vector_word(test.move) + "\ntolerance " +
            to_text(test.tolerance) + "\n";
    for (const ProbeTest::Sweep& sweep : test.sweeps)
        text += sweep_line(sweep) + "\n";
    return text + "end " + vector_word(test.end) + "\n";
}

Result<ProbeTest> parse_probe_test(std::string_view text, const std::string& location) {
    ProbeTest test;
    std::size_t number = 0;
    bool header = false, from = false, move = false, end = false;
    for (const std::string_view raw : split(text, '\n')) {
        ++number;
        const std::string_view line = trim(raw);
        if (line.empty() || line.front() == '#') continue;
        const std::vector<std::string_view> words = words_of_line(line);
        const auto bad = [&](const std::string& expected) {
            return Error{fmt::format("{}:{}", location, number),
                         fmt::format("found \"{}\", expected {}", line.substr(0, 80), expected)};
        };
        if (!header) {
            header = words.size() == 2 && words[0] == "slipface-probe" && words[1] == "1";
            if (!header) return bad("\"slipface-probe 1\" as the first line, the only supported version");
            continue;
        }
        if (!read_line(test, words, line))
            return bad("level, set, from, move, tolerance, sweep or end, as `Copy as a test` writes them");
        from = from || words[0] == "from";
        move = move || words[0] == "move";
        end = end || words[0] == "end";
    }
    if (!header || !from || !move || !end) {
        return Error{fmt::format("{}:{}", location, number),
                     "found the end of the text, expected slipface-probe 1, from, move and end"};
    }
    return test;
}

}  // namespace slipface

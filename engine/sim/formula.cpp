#include "slipface/sim/formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slipface/mesh/mesh.h"
#include "slipface/movement/step.h"

namespace slipface {
namespace {

// Where a hack acted in a tick: its decision, and the response that followed from it.
struct Act {
    const DecisionRecord* decision = nullptr;
    const ResponseRecord* response = nullptr;
    const PushOutRecord* push = nullptr;
    std::optional<Vec3> normal = std::nullopt;
};

std::optional<Act> find_act(const TickTrace& trace, const StoryNames& names, std::uint64_t bit) {
    Act act;
    const SweepRecord* sweep = nullptr;
    for (const TraceRecord& record : trace.records) {
        if (const auto* each = std::get_if<SweepRecord>(&record); each != nullptr && each->contact)
            sweep = each;
        const auto* response = std::get_if<ResponseRecord>(&record);
        // A response stands behind the decision that it follows from, and has the same face.
        if (response != nullptr && act.decision != nullptr && response->face == act.decision->face) {
            act.response = response;
            break;
        }
        if (bit == 0 ? response == nullptr : (hacks_acted(record) & bit) == 0) continue;
        if (response != nullptr) {
            act.response = response;
            if (bit == 0) continue;
            break;
        }
        if (act.decision == nullptr) act.decision = std::get_if<DecisionRecord>(&record);
        if (act.push == nullptr) act.push = std::get_if<PushOutRecord>(&record);
        if (act.decision != nullptr && sweep != nullptr && sweep->contact->face == act.decision->face)
            act.normal = sweep->contact->normal;
    }
    if (act.response != nullptr) act.normal = act.response->normal;
    if (act.decision == nullptr && act.response == nullptr && act.push == nullptr) return std::nullopt;
    const FaceId face = act.decision != nullptr ? act.decision->face : no_id;
    const PlayerState& after = trace.after.stepped;
    if (!act.normal && after.grounded && (face == no_id || face == after.ground_face))
        act.normal = after.ground_normal;
    if (!act.normal && face < names.mesh.face_count()) act.normal = face_normal(*names.mesh, face);
    return act;
}

// What the hack changed: a displacement where the velocity stayed, else the velocity.
struct Change {
    Vec3 before, after;
    const char* unit;
};
Change change_of(const Act& act, const TickTrace& trace) {
    const ResponseRecord* response = act.response;
    if (response == nullptr) return {trace.before.velocity, trace.after.stepped.velocity, "m/s"};
    if (response->velocity_before != response->velocity_after)
        return {response->velocity_before, response->velocity_after, "m/s"};
    return {response->remainder_before, response->remainder_after, "m"};
}

// 0: the setting is no hack.
std::uint64_t bit_of(std::string_view hack) {
    const std::optional<std::size_t> row = hack_row(hack);
    return row ? std::uint64_t{1} << *row : 0;
}

std::string number_of(double value, std::string_view unit) {
    std::string text = fmt::format("{:.2f}", value);
    if (text == "-0.00") text = "0.00";
    return unit.empty() ? text : text + " " + std::string(unit);
}

std::string vector_of(const Vec3& v, std::string_view unit) {
    const std::string text =
        "(" + number_of(v.x(), "") + ", " + number_of(v.y(), "") + ", " + number_of(v.z(), "") + ")";
    return unit.empty() ? text : text + " " + std::string(unit);
}

std::string setting_number(const MovementSettings& settings, const SettingInfo& info) {
    const double value = get_setting(settings, info);
    if (std::string_view(info.unit) == "deg")
        return fmt::format("{:.4g}\u00b0", value * 180.0 / std::numbers::pi);
    const std::string text = fmt::format("{:.4g}", value);
    return *info.unit == '\0' ? text : text + " " + info.unit;
}

// The words of a formula: "V'", "N.V", "max_slope".
std::vector<std::string> words_of(std::string_view formula) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_'.";
    std::vector<std::string> words;
    for (std::size_t begin = formula.find_first_of(letters); begin != std::string_view::npos;) {
        const std::size_t end = std::min(formula.find_first_not_of(letters, begin), formula.size());
        words.emplace_back(formula.substr(begin, end - begin));
        begin = formula.find_first_of(letters, end);
    }
    return words;
}

}  // namespace

std::vector<FormulaNumber> formula_numbers(const FormulaInfo& formula, const TickTrace& trace,
                                           const StoryNames& names) {
    const std::optional<Act> act = find_act(trace, names, bit_of(formula.hack));
    if (!act) return {};

    const auto [before, after, unit] = change_of(*act, trace);
    const std::vector<std::string> words = words_of(formula.text);
    // "Vy" and "V.w" are of V, "N.x" of N.
    const auto has = [&](std::string_view symbol) {
        return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
            if (word == symbol || (symbol.size() > 1 && symbol[1] != '\'')) return word == symbol;
            const bool dash = word.find('\'') != std::string_view::npos, wants_dash = symbol.ends_with('\'');
            if (dash != wants_dash) return false;
            const char next = word.size() > 1 ? word[1] : '.';
            return word[0] == symbol[0] &&
                   (next == '.' || next == '\'' || next == 'x' || next == 'y' || next == 'z');
        });
    };
    std::vector<FormulaNumber> numbers{{"V", vector_of(before, unit)}};
    const auto add = [&](const char* symbol, const std::string& text) {
        if (has(symbol)) numbers.push_back({symbol, text});
    };
    if (act->normal) {
        numbers.push_back({"N", vector_of(*act->normal, "")});
        add("N.y", number_of(act->normal->y(), ""));
        numbers.push_back({"N.V", number_of(act->normal->dot(before), unit)});
    } else {
        numbers.push_back({"N", "no contact"});
    }
    numbers.push_back({"V'", vector_of(after, unit)});
    add("E", vector_of(act->push != nullptr ? act->push->from : trace.from, "m"));
    add("E'", vector_of(act->push != nullptr ? act->push->to : trace.to, "m"));
    if (act->push != nullptr) add("C", vector_of(act->push->to - act->push->from, "m"));
    if (act->response != nullptr && act->response->surface < names.surfaces.size())
        add("e", number_of(names.surfaces[act->response->surface].restitution, ""));
    add("dt", fmt::format("{:.4g} s", trace.dt));
    for (const std::string& word : words)
        if (const SettingInfo* info = find_setting(word); info != nullptr && !is_switch(*info))
            if (std::none_of(numbers.begin(), numbers.end(),
                             [&](const FormulaNumber& n) { return n.symbol == word; }))
                numbers.push_back({word, setting_number(trace.settings, *info)});
    return numbers;
}

std::optional<TickTrace> telling_tick(const TapeRun& run, const TickScene& scene, std::string_view hack,
                                      const MovementSettings& off, StepFunction off_step) {
    const std::uint64_t bit = bit_of(hack);
    const auto acted = [&](const TickSample& sample) {
        return bit == 0 ? sample.contacts > 0 : (sample.acted & bit) != 0;
    };
    if (std::none_of(run.samples().begin(), run.samples().end(), acted)) return std::nullopt;
    std::optional<TickTrace> best;
    double largest = -1.0;  // m
    for (TickTrace& trace : run.traces(scene, 0, run.samples().size() - 1)) {
        if (!acted(run.samples()[trace.tick])) continue;
        const PlayerState without = off_step(scene.at(trace.tick, trace.dt), off, trace.before, trace.input,
                                             trace.dt, nullptr, nullptr)
                                        .state;
        const PlayerState& with = trace.after.stepped;
        const double apart =
            (with.position - without.position).norm() + trace.dt * (with.velocity - without.velocity).norm();
        constexpr double rounding = 1e-9;
        if (apart <= largest + rounding) continue;
        largest = apart;
        best = std::move(trace);
    }
    return best;
}

}  // namespace slipface

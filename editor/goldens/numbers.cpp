#include "goldens/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "goldens/numbers_json.h"
#include "slipface/base/text.h"

namespace slipface {

namespace {

// The first row whose pattern matches a path gives the meaning of the field.
struct FieldRule {
    const char* pattern;
    Cause cause;
    bool decides;
    double tolerance;  // of each number, absolute
};

constexpr std::array field_rules{
    FieldRule{"/renderer*", Cause::renderer, false, 0.0},
    FieldRule{"/widgets*", Cause::ui, false, 0.0},
    FieldRule{"/screen*", Cause::ui, true, 0.0},
    FieldRule{"/pixels", Cause::view, false, 0.0},
    FieldRule{"/inputs*", Cause::level, false, 0.0},
    FieldRule{"/order*", Cause::order, false, 0.0},
    FieldRule{"*/order", Cause::order, false, 0.0},
    FieldRule{"*/packed", Cause::level, false, 0.0},
    FieldRule{"/row*", Cause::view, true, 0.0},
    FieldRule{"/camera*", Cause::view, true, 1e-6},
    FieldRule{"/numbers*", Cause::program, true, 1e-6},
    FieldRule{"/movement/*hash*", Cause::movement, false, 0.0},
    FieldRule{"/movement*", Cause::movement, true, 1e-5},
    FieldRule{"*", Cause::level, true, 0.0},
};

const FieldRule& rule_of(const std::string& path) {
    return *std::find_if(field_rules.begin(), field_rules.end(),
                         [&](const FieldRule& rule) { return glob_match(rule.pattern, path); });
}

bool plain(const Numbers& value) {
    return !value.is_structured();
}

bool list_of_plain(const Numbers& value) {
    return value.is_array() && std::all_of(value.begin(), value.end(), plain);
}

bool equal_within(const Numbers& a, const Numbers& b, double tolerance) {
    if (a.is_number() && b.is_number()) {
        const double difference = std::abs(a.get<double>() - b.get<double>());
        return difference <= tolerance;
    }
    if (list_of_plain(a) && list_of_plain(b) && a.size() == b.size()) {
        for (std::size_t i = 0; i < a.size(); ++i)
            if (!equal_within(a[i], b[i], tolerance)) return false;
        return true;
    }
    return a == b;
}

std::string shown(const Numbers* value) {
    if (value == nullptr) return "nothing";
    std::string text = value->dump(-1, ' ', false, Numbers::error_handler_t::replace);
    if (text.size() > 160) text = text.substr(0, 157) + "...";
    return text;
}

void compare_values(const Numbers* expected, const Numbers* actual, const std::string& path,
                    std::vector<NumberDifference>& out) {
    const auto is = [](const Numbers* value, auto test) { return value == nullptr || test(*value); };
    const auto object = [](const Numbers& value) { return value.is_object(); };
    const auto list = [](const Numbers& value) { return value.is_array() && !list_of_plain(value); };
    if ((expected != nullptr || actual != nullptr) && is(expected, object) && is(actual, object)) {
        std::vector<std::string> keys;
        for (const Numbers* side : {expected, actual}) {
            if (side == nullptr) continue;
            for (const auto& [key, value] : side->items())
                if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
        }
        const auto at = [](const Numbers* side, const std::string& key) -> const Numbers* {
            return side != nullptr && side->contains(key) ? &(*side)[key] : nullptr;
        };
        for (const std::string& key : keys)
            compare_values(at(expected, key), at(actual, key), path + "/" + key, out);
        return;
    }
    if (is(expected, list) && is(actual, list)) {
        const std::size_t maximum = std::max(expected ? expected->size() : 0, actual ? actual->size() : 0);
        const auto at = [](const Numbers* side, std::size_t i) -> const Numbers* {
            return side != nullptr && i < side->size() ? &(*side)[i] : nullptr;
        };
        for (std::size_t i = 0; i < maximum; ++i)
            compare_values(at(expected, i), at(actual, i), fmt::format("{}/{}", path, i), out);
        return;
    }
    const FieldRule& rule = rule_of(path);
    if (expected != nullptr && actual != nullptr && equal_within(*expected, *actual, rule.tolerance)) return;
    out.push_back({path, rule.cause, shown(expected), shown(actual), rule.decides});
}

void append_text(std::string& out, const Numbers& value, std::size_t depth) {
    if (plain(value) || list_of_plain(value) || value.empty()) {
        out += value.dump(-1, ' ', false, Numbers::error_handler_t::replace);
        return;
    }
    const std::string indent(2 * depth + 2, ' ');
    out += value.is_array() ? "[\n" : "{\n";
    bool first = true;
    for (const auto& [key, member] : value.items()) {
        out += (first ? "" : ",\n") + indent;
        if (value.is_object())
            out += Numbers(key).dump(-1, ' ', false, Numbers::error_handler_t::replace) + ": ";
        append_text(out, member, depth + 1);
        first = false;
    }
    out += "\n" + std::string(2 * depth, ' ') + (value.is_array() ? "]" : "}");
}

}  // namespace

const char* cause_name(Cause cause) {
    constexpr std::array<const char*, cause_count> names{"renderer", "view",    "level", "movement",
                                                         "UI",       "program", "order"};
    return names[static_cast<std::size_t>(cause)];
}

std::string numbers_text(const Numbers& numbers) {
    std::string text;
    append_text(text, numbers, 0);
    return text + "\n";
}

std::string numbers_to_text(std::string_view json) {
    return numbers_text(Numbers::parse(json));
}

std::string hex_text(std::uint64_t value) {
    return fmt::format("{:016x}", value);
}

Result<std::vector<NumberDifference>> compare_numbers(std::string_view expected, std::string_view actual,
                                                      const std::string& location) {
    std::vector<NumberDifference> differences;
    if (expected.empty() && actual.empty()) return differences;
    const Numbers golden = expected.empty() ? Numbers::object() : Numbers::parse(expected, nullptr, false);
    const Numbers found = actual.empty() ? Numbers::object() : Numbers::parse(actual, nullptr, false);
    if (!golden.is_object()) return Error{location, "is no JSON object, expected the numbers of a golden"};
    if (!expected.empty() && golden.value("version", Numbers()) != numbers_version)
        return Error{
            location + ":/version",
            fmt::format("found another version than {}; `slipface snapshot approve` writes it again and "
                        "leaves the images that still fit",
                        numbers_version)};
    if (!found.is_object()) return Error{location, "the numbers found are no JSON object"};
    compare_values(&golden, &found, "", differences);
    return differences;
}

bool any_decides(const std::vector<NumberDifference>& differences) {
    return std::any_of(differences.begin(), differences.end(),
                       [](const NumberDifference& difference) { return difference.decides; });
}

}  // namespace slipface

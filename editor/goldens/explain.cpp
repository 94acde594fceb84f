#include "goldens/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "goldens/acts.h"
#include "goldens/drawer.h"
#include "goldens/screen.h"

namespace slipface {

namespace {

constexpr const char* by_program = "no input changed, so the program did: ";

Numbers parsed(const std::string& text) {
    return text.empty() ? Numbers() : Numbers::parse(text, nullptr, false);
}

// "levels/easy" of "inputs/levels/easy".
std::string place_of(const std::string& name) {
    return is_input(name) ? name.substr(input_folder.size()) : name;
}

// What the run of the tape or the probe does otherwise; empty: nothing.
std::string movement_text(const Difference& difference) {
    const Numbers before = parsed(difference.expected_numbers), after = parsed(difference.actual.numbers);
    const Numbers &was = member_of(member_of(before, "movement"), "tape"),
                  &is = member_of(member_of(after, "movement"), "tape");
    const Numbers &old = member_of(was, "samples"), &now = member_of(is, "samples");
    const auto differs = [&](std::string_view prefix) {
        return std::find_if(difference.numbers.begin(), difference.numbers.end(),
                            [&](const NumberDifference& number) {
                                return number.decides && number.path.starts_with(prefix);
                            });
    };
    const auto none = difference.numbers.end();
    std::string text;
    if (differs("/movement/tape/samples") != none || differs("/movement/tape/end") != none ||
        differs("/movement/tape/hashes") != none) {
        std::size_t i = 0;
        while (i < std::min(old.size(), now.size()) && old[i] == now[i])
            ++i;
        const auto tick = [](const Numbers& samples, std::size_t at) {
            return at < samples.size() ? samples[at][0].get<long long>() : -1;
        };
        text = i < std::min(old.size(), now.size()) && i > 0
                   ? fmt::format("the path leaves the approved one between ticks {} and {}", tick(old, i - 1),
                                 tick(old, i))
                   : "the path is another one";
        const double apart = distance_moved(member_of(was, "end"), member_of(is, "end"));
        text +=
            apart < 5e-4 ? " and ends at the same position" : fmt::format(" and ends {:.3g} m away", apart);
    } else if (differs("/movement/tape") != none) {
        text = "the path is the same, but the events on it differ";
    }
    if (const auto probe = differs("/movement/probe"); probe != none)
        text += fmt::format("{}probe: {} was {}, is {}", text.empty() ? "" : "; ", probe->path.substr(15),
                            probe->expected, probe->actual);
    return text;
}

std::size_t changed_pixels(const Difference& difference) {
    const Image &a = difference.expected, &b = difference.actual.image;
    return compare_images(a, b, difference.tolerance).differing;
}

std::string renderer_text(const Numbers& before, const Numbers& after) {
    const std::string text = changed_members(member_of(before, "renderer"), member_of(after, "renderer"));
    return text.empty() ? "" : "another renderer: " + text;
}

// What the program does otherwise: the screen's widgets, the view, the movement or the drawing.
Finding program(const Difference& difference, const std::string& movement,
                const std::vector<Finding>& widgets) {
    Finding finding{Cause::program, changed_pixels(difference), by_program, true};
    const Numbers before = parsed(difference.expected_numbers), after = parsed(difference.actual.numbers);
    const bool screen = after.is_object() && after.contains("widgets");
    const auto number = std::find_if(
        difference.numbers.begin(), difference.numbers.end(),
        [](const NumberDifference& one) { return one.decides && one.path.starts_with("/numbers/"); });
    // A widget that moved says more than what lies behind it, which only looks different.
    const auto find = [&](bool moved) {
        return std::find_if(widgets.begin(), widgets.end(), [&](const Finding& one) {
            return one.text.find("Viewport/View`") == std::string::npos &&
                   !(moved && (!one.text.starts_with('`') || one.text.ends_with("looks different")));
        });
    };
    const auto view = find(true) != widgets.end() ? find(true) : find(false);
    if (!movement.empty())
        finding.text += "movement: " + movement;
    else if (number != difference.numbers.end())
        finding.text += fmt::format("number `{}` was {}, is {}", number->path.substr(9), number->expected,
                                    number->actual);
    else if (screen && view != widgets.end())
        finding.text += "interface: " + view->text;
    else if (member_of(before, "camera") != member_of(after, "camera"))
        finding.text += "view: " + changed_members(member_of(before, "camera"), member_of(after, "camera"));
    else
        finding.text += "drawing";
    return finding;
}

Cause cause_of(const Numbers& facts) {
    const Numbers& kind = member_of(facts, "kind");
    return kind == "tape" ? Cause::movement : kind == "level" ? Cause::level : Cause::view;
}

}  // namespace

std::vector<Finding> explain_input(const InputPair& input) {
    const Numbers before = parsed(input.before), after = parsed(input.after);
    const std::string place = place_of(input.name);
    std::vector<Finding> findings;
    if (!before.is_object() || !after.is_object()) return findings;
    for (const Act& act : acts_between(before, after)) {
        Finding finding{cause_of(after), 0, fmt::format("{} ({})", act.text, place),
                        act.kind != ActKind::effect};
        if (act.kind == ActKind::order) {
            finding.cause = Cause::order;
        } else if (input.same_bytes) {
            finding.cause = Cause::program;
            finding.text = fmt::format("{}reading: {}", by_program, finding.text);
        }
        findings.push_back(std::move(finding));
    }
    // Effects without an act cannot be: what changed is named as it is.
    const bool any = std::any_of(findings.begin(), findings.end(),
                                 [](const Finding& one) { return one.act && one.cause != Cause::order; });
    if (!any && !findings.empty() && findings.front().cause != Cause::order) findings.front().act = true;
    return findings;
}

bool any_input_changed(const std::vector<Finding>& findings) {
    return std::any_of(findings.begin(), findings.end(),
                       [](const Finding& finding) { return finding.act && finding.cause != Cause::order; });
}

std::vector<Finding> explain(const Difference& difference) {
    const Numbers before = parsed(difference.expected_numbers), after = parsed(difference.actual.numbers);
    std::vector<Finding> findings, order, follows;
    Numbers was = member_of(before, "row"), is = member_of(after, "row");
    if (was.is_object() && is.is_object()) {
        for (const Act& act : file_acts(member_of(was, "files"), member_of(is, "files")))
            findings.push_back({Cause::level, 0, act.text, true});
        was.erase("files");
        is.erase("files");
        for (const Act& act : acts_between(was, is))
            findings.push_back({Cause::view, 0, act.text, true});
    }
    for (const InputPair& input : difference.inputs)
        for (Finding& finding : explain_input(input))
            (!finding.act                    ? follows
             : finding.cause == Cause::order ? order
                                             : findings)
                .push_back(std::move(finding));
    const std::string movement = movement_text(difference);
    std::vector<Finding> widgets;
    const Image &a = difference.expected, &b = difference.actual.image;
    const bool sized = a.width == b.width && a.height == b.height;
    if (sized && after.is_object() && after.contains("widgets")) widgets = explain_widgets(difference);
    const std::string renderer = renderer_text(before, after);
    const bool elsewhere = drawn_by(difference.expected_numbers) != drawn_by(difference.actual.numbers);
    // The same libraries on another processor move neither players nor widgets.
    const auto differ = [&](const char* section) {
        return member_of(before, section) != member_of(after, section);
    };
    const bool computed = !movement.empty() || differ("widgets") || differ("numbers");
    if (findings.empty() && order.empty() && !renderer.empty() && (elsewhere || !computed))
        findings.push_back({Cause::renderer, changed_pixels(difference), renderer, true});
    if (findings.empty() && order.empty()) findings.push_back(program(difference, movement, widgets));
    findings.insert(findings.end(), order.begin(), order.end());
    if (findings.front().pixels == 0 && sized) findings.front().pixels = changed_pixels(difference);
    findings.insert(findings.end(), follows.begin(), follows.end());
    if (!movement.empty() && findings.front().cause != Cause::program)
        findings.push_back({Cause::movement, 0, movement, false});
    findings.insert(findings.end(), widgets.begin(), widgets.end());
    return findings;
}

}  // namespace slipface

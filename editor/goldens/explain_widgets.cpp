// Changed pixels of the editor's window, by the widget that drew them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "goldens/numbers_json.h"
#include "goldens/screen.h"

namespace slipface {

namespace {

constexpr std::size_t max_findings = 8;

struct Widget {
    std::string path;
    std::array<int, 4> rect{};  // x, y, width, height
    bool holds(int x, int y) const {
        return x >= rect[0] && y >= rect[1] && x < rect[0] + rect[2] && y < rect[1] + rect[3];
    }
    long long area() const { return static_cast<long long>(rect[2]) * rect[3]; }
};

// Small ones first: the first that contains a pixel drew it.
std::vector<Widget> widgets_of(const std::string& text) {
    std::vector<Widget> widgets;
    const Numbers numbers = Numbers::parse(text, nullptr, false);
    if (!numbers.is_object() || !numbers.contains("widgets")) return widgets;
    for (const auto& [path, rect] : numbers["widgets"].items()) {
        if (!rect.is_array() || rect.size() != 4) continue;
        Widget widget{path, {}};
        for (std::size_t i = 0; i < 4; ++i)
            widget.rect[i] = rect[i].is_number_integer() ? rect[i].get<int>() : 0;
        widgets.push_back(std::move(widget));
    }
    std::stable_sort(widgets.begin(), widgets.end(),
                     [](const Widget& a, const Widget& b) { return a.area() < b.area(); });
    return widgets;
}

const Widget* widget_at(const std::vector<Widget>& widgets, int x, int y) {
    const auto found =
        std::find_if(widgets.begin(), widgets.end(), [&](const Widget& w) { return w.holds(x, y); });
    return found == widgets.end() ? nullptr : &*found;
}

std::string what_happened(const std::string& path, const std::vector<Widget>& before,
                          const std::vector<Widget>& after) {
    const auto find = [&](const std::vector<Widget>& list) {
        const auto found =
            std::find_if(list.begin(), list.end(), [&](const Widget& w) { return w.path == path; });
        return found == list.end() ? nullptr : &*found;
    };
    const Widget *was = find(before), *is = find(after);
    if (was == nullptr) return "is new";
    if (is == nullptr) return "is gone";
    if (was->rect == is->rect) return "looks different";
    if (was->rect[2] != is->rect[2] || was->rect[3] != is->rect[3])
        return fmt::format("is {} x {} instead of {} x {} pixels", is->rect[2], is->rect[3], was->rect[2],
                           was->rect[3]);
    return fmt::format("moved by {}, {} pixels", is->rect[0] - was->rect[0], is->rect[1] - was->rect[1]);
}

}  // namespace

std::vector<Finding> explain_widgets(const Difference& difference) {
    const std::vector<Widget> before = widgets_of(difference.expected_numbers),
                              after = widgets_of(difference.actual.numbers);
    std::map<std::string, std::size_t> pixels;
    const Image &a = difference.expected, &b = difference.actual.image;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            int delta = 0;
            for (int c = 0; c < 4; ++c)
                delta = std::max(delta, std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]));
            if (delta <= difference.tolerance.pixel_delta) continue;
            const Widget* widget = widget_at(after, x, y);
            if (widget == nullptr) widget = widget_at(before, x, y);
            ++pixels[widget == nullptr ? "" : widget->path];
        }
    }
    std::vector<Finding> findings;
    for (const auto& [path, count] : pixels)
        findings.push_back({Cause::ui, count,
                            path.empty() ? std::string("outside all named widgets")
                                         : fmt::format("`{}` {}", path, what_happened(path, before, after))});
    std::stable_sort(findings.begin(), findings.end(),
                     [](const Finding& x, const Finding& y) { return x.pixels > y.pixels; });
    if (findings.size() <= max_findings) return findings;
    std::size_t rest = 0;
    for (std::size_t i = max_findings; i < findings.size(); ++i)
        rest += findings[i].pixels;
    const std::size_t others = findings.size() - max_findings;
    findings.resize(max_findings);
    findings.push_back({Cause::ui, rest, fmt::format("{} other widgets", others)});
    return findings;
}

}  // namespace slipface

#include "slipface/base/line_difference.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::size_t max_tried = 32;  // equal lines of the base that are tried as the begin of a run

}  // namespace

std::string line_difference(std::string_view base, std::string_view text) {
    const std::vector<std::string_view> known = split(base, '\n'), lines = split(text, '\n');
    std::unordered_map<std::string_view, std::vector<std::size_t>> places;
    for (std::size_t i = 0; i < known.size(); ++i)
        places[known[i]].push_back(i);
    std::string difference;
    std::size_t next = 0;  // line of the base behind the last run
    for (std::size_t i = 0; i < lines.size();) {
        std::size_t first = 0, longest = 0, tried = 0;
        const auto try_from = [&](std::size_t at) {
            std::size_t count = 0;
            while (at + count < known.size() && i + count < lines.size() &&
                   known[at + count] == lines[i + count])
                ++count;
            if (count > longest) {
                first = at;
                longest = count;
            }
        };
        try_from(next);
        if (const auto found = places.find(lines[i]); found != places.end())
            for (const std::size_t at : found->second)
                if (++tried <= max_tried) try_from(at);
        if (longest == 0) {
            difference += "+" + std::string(lines[i++]) + "\n";
            continue;
        }
        difference += "=" + std::to_string(first) + " " + std::to_string(longest) + "\n";
        next = first + longest;
        i += longest;
    }
    return difference;
}

std::optional<std::string> apply_line_difference(std::string_view base, std::string_view difference,
                                                 std::size_t max_bytes) {
    const std::vector<std::string_view> known = split(base, '\n');
    if (!difference.ends_with('\n')) return std::nullopt;
    difference.remove_suffix(1);
    std::string text;
    const auto add = [&](std::string_view line) {
        if (text.size() + line.size() >= max_bytes) return false;
        text += line;
        text += '\n';
        return true;
    };
    for (const std::string_view row : split(difference, '\n')) {
        if (row.starts_with('+')) {
            if (!add(row.substr(1))) return std::nullopt;
            continue;
        }
        const std::size_t space = std::min(row.find(' '), row.size());
        const auto first = parse_int(row.substr(std::min<std::size_t>(1, row.size()), space - 1));
        const auto count = parse_int(row.substr(std::min(space + 1, row.size())));
        const auto lines = static_cast<std::int64_t>(known.size());
        if (!row.starts_with('=') || !first || !count || *first < 0 || *count < 1 || *first >= lines ||
            *count > lines - *first)
            return std::nullopt;
        for (std::int64_t i = *first; i < *first + *count; ++i)
            if (!add(known[static_cast<std::size_t>(i)])) return std::nullopt;
    }
    text.pop_back();
    return text;
}

}  // namespace slipface

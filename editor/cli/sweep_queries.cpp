#include "cli/sweep_queries.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "slipface/base/files.h"
#include "slipface/base/text.h"

namespace slipface::cli {
namespace {

constexpr std::uint64_t max_query_bytes = 1ULL << 30;
constexpr std::array<std::string_view, 6> columns{"ox", "oy", "oz", "dx", "dy", "dz"};

std::string excerpt(std::string_view text) {
    constexpr std::size_t longest = 40;
    return text.size() <= longest ? std::string(text) : std::string(text.substr(0, longest)) + "...";
}

// Empty on success, else the error.
std::string read_row(std::string_view line, SweepQuery& query) {
    const auto count = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',') + 1);
    if (count != columns.size()) return fmt::format("found {} values, expected 6 (ox,oy,oz,dx,dy,dz)", count);
    const std::vector<std::string_view> fields = split(line, ',');
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const std::string_view field = trim(fields[i]);
        const std::optional<double> number = parse_double(field);
        if (!number)
            return fmt::format("found \"{}\" for {}, expected a finite number", excerpt(field), columns[i]);
        const auto axis = static_cast<Eigen::Index>(i % 3);
        (i < 3 ? query.from : query.move)[axis] = *number;
    }
    return {};
}

bool is_header(std::string_view line) {
    const std::vector<std::string_view> fields = split(line, ',');
    return std::equal(fields.begin(), fields.end(), columns.begin(), columns.end(),
                      [](std::string_view field, std::string_view column) { return trim(field) == column; });
}

}  // namespace

Result<std::vector<SweepQuery>> parse_sweep_queries(std::string_view text, const std::string& location) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r'))
        text.remove_suffix(1);
    std::vector<SweepQuery> queries;
    std::size_t line_number = 0;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = trim(text.substr(at, end - at));
        const std::string here = fmt::format("{}:{}", location, ++line_number);
        at = end + 1;
        if (line_number == 1) {
            if (is_header(line)) continue;
            return Error{here,
                         fmt::format("found \"{}\", expected the header ox,oy,oz,dx,dy,dz", excerpt(line))};
        }
        SweepQuery query;
        std::string wrong = read_row(line, query);
        if (!wrong.empty()) return Error{here, std::move(wrong)};
        queries.push_back(query);
    }
    return queries;
}

Result<std::vector<SweepQuery>> load_sweep_queries(const std::filesystem::path& path) {
    const Result<std::string> text = read_file(path, max_query_bytes);
    if (!text) return text.error();
    return parse_sweep_queries(*text, path.string());
}

}  // namespace slipface::cli

#include "slipface/base/shard.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "slipface/base/text.h"

namespace slipface {
namespace {

// Lists numbers as "2/4, 3/4 and 7 more".
std::string list_of(const std::vector<std::uint32_t>& numbers, std::uint32_t count) {
    constexpr std::size_t max_shown = 20;
    std::string text;
    for (std::size_t i = 0; i < std::min(numbers.size(), max_shown); ++i)
        text += (i == 0 ? "" : ", ") + shard_text({numbers[i], count});
    if (numbers.size() > max_shown) text += fmt::format(" and {} more", numbers.size() - max_shown);
    return text;
}

}  // namespace

Result<Shard> parse_shard(std::string_view text, const std::string& location) {
    const auto parts = split(text, '/');
    const std::int64_t number = parts.size() == 2 ? parse_int(parts[0]).value_or(-1) : -1;
    const std::int64_t count = parts.size() == 2 ? parse_int(parts[1]).value_or(-1) : -1;
    if (number == 0)
        return Error{location,
                     fmt::format("found {}: parts are counted from 1, so the first of four is 1/4", text)};
    if (number < 1 || number > count || count > max_shards)
        return Error{location, fmt::format("found \"{}\", expected a part such as 2/4, of at most {}", text,
                                           max_shards)};
    return Shard{static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(count)};
}

std::string shard_text(const Shard& shard) {
    return fmt::format("{}/{}", shard.number, shard.count);
}

Status check_shards_complete(std::span<const ShardFile> parts, const std::string& location) {
    if (parts.empty()) return Error{location, "expected at least one report"};
    const std::uint32_t count = parts.front().shard.count;
    std::map<std::uint32_t, const std::string*> files;
    for (const auto& [file, shard] : parts) {
        if (shard.count != count)
            return Error{file, fmt::format("is part {}, but {} is part {}", shard_text(shard),
                                           parts.front().file, shard_text(parts.front().shard))};
        const auto [twin, fresh] = files.try_emplace(shard.number, &file);
        if (!fresh) return Error{file, fmt::format("is part {}, as {} is", shard_text(shard), *twin->second)};
    }
    std::vector<std::uint32_t> missing;
    for (std::uint32_t number = 1; number <= count; ++number)
        if (!files.contains(number)) missing.push_back(number);
    if (missing.empty()) return {};
    return Error{location,
                 fmt::format("{} of {} parts missing: {}", missing.size(), count, list_of(missing, count))};
}

}  // namespace slipface

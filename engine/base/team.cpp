#include "slipface/base/team.h"

#include <fmt/format.h>

#include <cstdint>

#include "slipface/base/bytes.h"

namespace slipface {

std::size_t doer_of(std::size_t item, std::size_t size) {
    const std::uint64_t shift = (item / size * 0x9e3779b97f4a7c15ULL) >> 33;
    return static_cast<std::size_t>((item + shift) % size);
}

Status agree(Team& team, const Status& mine) {
    ByteWriter<std::uint64_t> to;
    if (!mine) {
        to.put_text(mine.error().location);
        to.put_text(mine.error().message);
    }
    const std::vector<std::string> all = team.gather(to.bytes);
    for (std::size_t rank = 0; rank < all.size(); ++rank) {
        if (all[rank].empty()) continue;
        ByteReader<std::uint64_t> from(all[rank]);
        const std::string location = from.get_text(), message = from.get_text();
        return Error{location, fmt::format("{} ({})", message, team.name_of(rank))};
    }
    return {};
}

Status agree_on(Team& team, const std::vector<std::pair<std::string, std::string>>& facts) {
    ByteWriter<std::uint64_t> to;
    for (const auto& [name, value] : facts)
        to.put_text(value);
    const std::vector<std::string> all = team.gather(to.bytes);
    for (std::size_t rank = 1; rank < all.size(); ++rank) {
        ByteReader<std::uint64_t> first(all[0]), other(all[rank]);
        for (const auto& [name, mine] : facts) {
            const std::string expected = first.get_text(), found = other.get_text();
            if (found != expected)
                return Error{team.name_of(rank), fmt::format("has another {} than {}: {} instead of {}", name,
                                                             team.name_of(0), found, expected)};
        }
    }
    return {};
}

}  // namespace slipface

#include "slipface/sim/capsule.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "slipface/base/base64.h"
#include "slipface/base/text.h"
#include "slipface/image/pack.h"

namespace slipface {
namespace {

constexpr std::string_view scheme = "capsule=", first_line = "slipface-capsule 1\n",
                           with_base = "slipface-capsule 2\n";
Error damaged(std::string what) {
    return Error{"link", std::move(what)};
}

// Takes "NAME VALUE\n" from the front; nothing: another line is there.
std::optional<std::string_view> take_line(std::string_view& text, std::string_view name) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos || !text.starts_with(name)) return std::nullopt;
    const std::string_view value = text.substr(name.size(), end - name.size());
    text.remove_prefix(end + 1);
    return value;
}

// The same for a number; -1: there is none.
std::int64_t take_number(std::string_view& text, std::string_view name) {
    const auto value = take_line(text, name);
    return value ? parse_int(*value).value_or(-1) : -1;
}

}  // namespace

std::string capsule_text(const Capsule& capsule) {
    std::string level = capsule.level;
    for (char& c : level)
        if (c == '\n') c = ' ';
    const std::string bytes = fmt::format(
        "{}level {}\ntick {}\ntape {}\n{}{}{}", capsule.base.empty() ? first_line : with_base, level,
        capsule.tick, capsule.tape.size(), capsule.base.empty() ? "" : "base " + capsule.base + "\n",
        capsule.tape, capsule.level_file);
    return fmt::format("{}{}.{}", scheme, bytes.size(),
                       to_base64(pack(bytes, pack_smallest), Base64::address));
}

Result<Capsule> parse_capsule(std::string_view text) {
    if (text.starts_with('#')) text.remove_prefix(1);
    if (!text.starts_with(scheme))
        return damaged("is no capsule; expected text that begins with \"capsule=\"");
    text.remove_prefix(scheme.size());
    const std::size_t dot = text.find('.');
    const auto size = parse_int(text.substr(0, dot));
    if (dot == std::string_view::npos || !size || *size < 0)
        return damaged("has no size; expected capsule=SIZE.DATA");
    if (static_cast<std::uint64_t>(*size) > max_capsule_bytes)
        return damaged(fmt::format("unpacks to {} bytes; at most {} are read", *size, max_capsule_bytes));
    const auto packed = from_base64(text.substr(dot + 1), Base64::address);
    if (!packed) return damaged("has a character that is none of A-Z, a-z, 0-9, - and _");
    const auto bytes = unpack(*packed, static_cast<std::size_t>(*size));
    if (!bytes) return damaged("is cut off or altered; copy all of it");

    std::string_view rest = *bytes;
    const bool has_base = rest.starts_with(with_base);
    if (!has_base && !rest.starts_with(first_line))
        return damaged("is of another version; expected slipface-capsule 1 or 2");
    rest.remove_prefix(first_line.size());
    const auto level = take_line(rest, "level ");
    const std::int64_t tick = take_number(rest, "tick "), tape = take_number(rest, "tape ");
    const auto base = has_base ? take_line(rest, "base ") : std::string_view();
    if (!level || tick < 0 || tape < 0 || !base || has_base == base->empty() ||
        static_cast<std::uint64_t>(tape) > rest.size())
        return damaged("has no valid level, tick, tape and base");
    const auto cut = static_cast<std::size_t>(tape);
    return Capsule{std::string(*level), static_cast<std::size_t>(tick), std::string(rest.substr(0, cut)),
                   std::string(rest.substr(cut)), std::string(*base)};
}

}  // namespace slipface

#include "slipface/image/archive.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

#include "slipface/image/pack.h"

namespace slipface {
namespace {

// A header of POSIX's ustar format: numbers are octal text.
constexpr std::size_t block = 512;
struct Field {
    std::size_t at, size;
};
constexpr Field name_field{0, 100}, mode_field{100, 8}, size_field{124, 12}, sum_field{148, 8},
    kind_field{156, 1}, magic_field{257, 8}, prefix_field{345, 155};
constexpr std::string_view magic{"ustar\00000", 8};

std::size_t padded(std::size_t size) {
    return (size + block - 1) / block * block;
}

void put(std::string& header, Field field, std::string_view text) {
    std::copy(text.begin(), text.end(), header.begin() + static_cast<std::ptrdiff_t>(field.at));
}

std::string octal(std::size_t value, std::size_t digits) {
    std::string text(digits, '0');
    for (; digits-- > 0; value /= 8)
        text[digits] = static_cast<char>('0' + value % 8);
    return text;
}

// The sum of the header's bytes, with spaces in place of the sum.
std::size_t sum_of(std::string_view header) {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < block; ++i) {
        const bool own = i >= sum_field.at && i < sum_field.at + sum_field.size;
        sum += own ? ' ' : static_cast<unsigned char>(header[i]);
    }
    return sum;
}

std::string_view text_of(std::string_view header, Field field) {
    const std::string_view text = header.substr(field.at, field.size);
    return text.substr(0, text.find('\0'));
}

std::optional<std::size_t> number_of(std::string_view header, Field field) {
    std::size_t value = 0, digits = 0;
    for (const char c : text_of(header, field)) {
        if (c == ' ' && digits > 0) break;
        if (c == ' ') continue;
        if (c < '0' || c > '7' || ++digits > 11) return std::nullopt;
        value = value * 8 + static_cast<std::size_t>(c - '0');
    }
    if (digits == 0) return std::nullopt;
    return value;
}

// Whether the name stays in the folder that it is relative to, on any system.
bool is_inside(std::string_view name) {
    if (name.empty() || name.front() == '/' || name.find_first_of(":\\") != std::string_view::npos)
        return false;
    for (std::size_t at = 0; at <= name.size();) {
        const std::size_t end = std::min(name.find('/', at), name.size());
        const std::string_view part = name.substr(at, end - at);
        if (part.empty() || part == "." || part == "..") return false;
        at = end + 1;
    }
    return std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 32; });
}

}  // namespace

Result<std::string> archive_of(std::span<const ArchiveEntry> entries) {
    std::string tar;
    for (const ArchiveEntry& entry : entries) {
        if (entry.name.size() > name_field.size || !is_inside(entry.name))
            return Error{entry.name,
                         "found a name that cannot be in an archive, expected at most 100 bytes "
                         "and no way out of its folder"};
        if (entry.bytes.size() > max_archive_bytes - std::min(tar.size(), max_archive_bytes))
            return Error{entry.name, "the archive would be larger than 1 GiB"};
        std::string header(block, '\0');
        put(header, name_field, entry.name);
        put(header, mode_field, "0000644");
        put(header, {108, 8}, "0000000");
        put(header, {116, 8}, "0000000");
        put(header, size_field, octal(entry.bytes.size(), 11));
        put(header, {136, 12}, "00000000000");
        put(header, kind_field, "0");
        put(header, magic_field, magic);
        put(header, sum_field, octal(sum_of(header), 6) + std::string("\0 ", 2));
        tar += header + entry.bytes;
        tar.resize(padded(tar.size()), '\0');
    }
    tar.append(2 * block, '\0');
    return pack_gzip(tar);
}

Result<std::vector<ArchiveEntry>> read_archive(std::string_view bytes, const std::string& location) {
    const std::optional<std::string> tar = unpack_gzip(bytes, max_archive_bytes + (std::size_t{1} << 20));
    if (!tar) return Error{location, "is no gzip file, or a damaged one, or larger than 1 GiB unpacked"};
    std::vector<ArchiveEntry> entries;
    std::set<std::string, std::less<>> names;
    for (std::size_t at = 0; at + block <= tar->size();) {
        const std::string_view header = std::string_view(*tar).substr(at, block);
        if (header.find_first_not_of('\0') == std::string_view::npos) return entries;
        const auto fail = [&](const std::string& what) {
            return Error{location + ": byte " + std::to_string(at), what};
        };
        const auto sum = number_of(header, sum_field), size = number_of(header, size_field);
        if (!sum || !size || *sum != sum_of(header))
            return fail("found no header of a file in a tar archive");
        if (*size > tar->size() - at - block) return fail("the archive ends inside this file");
        std::string name(text_of(header, name_field));
        const bool extended = header.substr(magic_field.at, 5) == "ustar";
        if (const auto prefix = text_of(header, prefix_field); extended && !prefix.empty())
            name = std::string(prefix) + "/" + name;
        if (name.starts_with("./")) name.erase(0, 2);
        const char kind = header[kind_field.at];
        at += block + padded(*size);
        if (kind == '5') continue;
        if (kind != '0' && kind != '\0') return fail("found an entry that is no file: " + name.substr(0, 60));
        if (!is_inside(name))
            return fail("found the name \"" + name.substr(0, 60) +
                        "\", expected one inside the archive's folder");
        if (!names.insert(name).second) return fail("found the name \"" + name + "\" a second time");
        entries.push_back({std::move(name), tar->substr(at - padded(*size), *size)});
    }
    return Error{location, "the archive ends without its last block"};
}

}  // namespace slipface

#include "obj/obj_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>

#include "slipface/base/text.h"

namespace slipface {
namespace {

bool is_text(unsigned char byte) {
    return byte >= 0x20 || (byte >= '\t' && byte <= '\r');
}

// Bytes of the UTF-8 sequence at the start of `text`; 0 if it is not valid. Overlong forms, surrogates and
// values above U+10FFFF are not valid.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return 0;
    }
    const unsigned char second = byte(1);
    const bool bad = (lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
                     (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F);
    return bad ? 0 : length;
}

// For a number that no double holds: true if it is too small, false if it is too large.
bool is_small(std::string_view word) {
    const std::size_t exponent = word.find_first_of("eE");
    if (exponent != std::string_view::npos) return word.substr(exponent + 1).starts_with('-');
    return word.find('.') < word.find_first_of("123456789");
}

void append_utf8(std::string& text, std::uint32_t code) {
    const auto put = [&](std::uint32_t byte) { text.push_back(static_cast<char>(byte)); };
    if (code < 0x80) return put(code);
    const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    put((0xFF00U >> (more + 1) & 0xFF) | code >> (6 * more));
    for (int i = more; i-- > 0;)
        put(0x80 | (code >> (6 * i) & 0x3F));
}

std::string utf8_of_utf16(std::string_view bytes, bool little_endian) {
    std::string text;
    const auto unit = [&](std::size_t at) -> std::uint32_t {
        if (at + 1 >= bytes.size()) return 0;
        const std::uint32_t first = static_cast<unsigned char>(bytes[at]),
                            second = static_cast<unsigned char>(bytes[at + 1]);
        return little_endian ? first | second << 8U : first << 8U | second;
    };
    for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
        std::uint32_t code = unit(at);
        if (code == 0xFEFF && at == 0) continue;
        const std::uint32_t low = unit(at + 2);
        if (code >= 0xD800 && code < 0xDC00 && low >= 0xDC00 && low < 0xE000) {
            code = 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00);
            at += 2;
        } else if (code >= 0xD800 && code < 0xE000) {
            code = 0xFFFD;
        }
        append_utf8(text, code);
    }
    return text;
}

}  // namespace

std::string text_of_file(std::string bytes) {
    using namespace std::string_view_literals;
    // Two ASCII characters whose other bytes are zero.
    const auto ascii_at = [&](std::size_t first) {
        return bytes.size() > 3 && bytes[1 - first] == '\0' && bytes[3 - first] == '\0' &&
               is_text(static_cast<unsigned char>(bytes[first])) &&
               is_text(static_cast<unsigned char>(bytes[2 + first]));
    };
    const bool little = bytes.starts_with("\xFF\xFE"sv) || ascii_at(0);
    if (little || bytes.starts_with("\xFE\xFF"sv) || ascii_at(1)) bytes = utf8_of_utf16(bytes, little);
    bytes.resize(bytes.find_last_not_of("\0\x1A"sv) + 1);
    return bytes;
}

LineReader::LineReader(std::string& text) : at_(text.data()), end_(text.data() + text.size()) {
    if (text.starts_with("\xEF\xBB\xBF")) at_ += 3;
    if (text.find('\n') == std::string::npos) std::replace(at_, end_, '\r', '\n');
}

bool LineReader::next() {
    if (at_ == end_) return false;
    number_ = next_number_;
    char* const begin = at_;
    const std::string_view rest =
        trim({begin, static_cast<std::size_t>(std::min<std::ptrdiff_t>(end_ - begin, 256))});
    const bool comment = rest.starts_with('#');
    for (;;) {
        auto* const newline =
            static_cast<char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
        char* const line_end = newline != nullptr ? newline : end_;
        at_ = newline != nullptr ? newline + 1 : end_;
        ++next_number_;
        char* last = line_end;
        if (last > begin && last[-1] == '\r') --last;
        if (comment || newline == nullptr || last == begin || last[-1] != '\\') {
            line_ = trim({begin, static_cast<std::size_t>(last - begin)});
            return true;
        }
        std::fill(last - 1, newline + 1, ' ');
    }
}

std::string_view take_word(std::string_view& line) {
    std::size_t begin = 0;
    while (begin < line.size() && is_blank(line[begin]))
        ++begin;
    if (begin == line.size() || line[begin] == '#') {
        line = {};
        return {};
    }
    std::size_t end = begin;
    while (end < line.size() && !is_blank(line[end]))
        ++end;
    const std::string_view word = line.substr(begin, end - begin);
    line.remove_prefix(end);
    return word;
}

std::optional<double> read_number(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
    if (error == std::errc::result_out_of_range) {
        return is_small(word) ? 0.0 : std::numeric_limits<double>::infinity();
    }
    return value;
}

std::size_t find_binary(std::string_view text) {
    // Blocks of a constant size and no branch, so that the compiler can process many bytes at once.
    constexpr std::size_t block = 4096;
    std::size_t begin = 0;
    for (; text.size() - begin >= block; begin += block) {
        std::uint8_t others = 0;
        for (std::size_t i = 0; i < block; ++i)
            others |= std::uint8_t{!is_text(static_cast<unsigned char>(text[begin + i]))};
        if (others != 0) break;
    }
    const auto rest = text.substr(begin);
    const auto found = std::find_if_not(rest.begin(), rest.end(),
                                        [](char c) { return is_text(static_cast<unsigned char>(c)); });
    return found == rest.end() ? std::string_view::npos
                               : begin + static_cast<std::size_t>(found - rest.begin());
}

std::size_t replace_binary(std::string& text) {
    const auto is_binary = [](char c) { return !is_text(static_cast<unsigned char>(c)); };
    const auto count = static_cast<std::size_t>(std::count_if(text.begin(), text.end(), is_binary));
    std::replace_if(text.begin(), text.end(), is_binary, '?');
    return count;
}

std::size_t line_of(std::string_view text, std::size_t position) {
    const std::string_view before = text.substr(0, position);
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::string utf8_name(std::string_view name, bool& converted) {
    bool valid = true;
    for (std::string_view rest = name; !rest.empty() && valid;) {
        const std::size_t length = utf8_length(rest);
        valid = length > 0;
        rest.remove_prefix(length);
    }
    converted = !valid;
    if (valid) return std::string(name);
    std::string result;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            result.push_back(c);
        } else {
            result.push_back(static_cast<char>(0xC0 | byte >> 6));
            result.push_back(static_cast<char>(0x80 | (byte & 0x3F)));
        }
    }
    return result;
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 40;
    bool converted = false;
    if (text.size() <= longest) return fmt::format("'{}'", utf8_name(text, converted));
    // A cut inside a sequence would make the whole text Latin-1.
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
        --end;
    return fmt::format("'{}...'", utf8_name(text.substr(0, end), converted));
}

}  // namespace slipface

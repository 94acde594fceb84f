// The words and numbers of one line of an OBJ file.
#pragma once

#include <assimp/fast_atof.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "obj/obj_text.h"
#include "slipface/base/text.h"

namespace slipface {

inline constexpr double largest_obj_coordinate = 1e7;  // in units of the file

// Assimp's number reader throws this for text that is not a number; read_number() has already excluded that.
struct NoNumber {
    template <class... Parts>
    explicit NoNumber(Parts&&...) {}
};

inline bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

inline bool in_range(std::optional<double> number) {
    return number && std::abs(*number) <= largest_obj_coordinate;
}

// Assimp misreads numbers that begin with a point and cuts off long ones, so those are rewritten for it.
inline float rounded_by_assimp(std::string_view word, double value) {
    constexpr std::size_t longest_copied = 32;
    const std::size_t first_digit = word.starts_with('-') ? 1 : 0;
    const bool copied =
        word.size() > first_digit && word.size() <= longest_copied && is_digit(word[first_digit]);
    return Assimp::fast_atof<NoNumber>((copied ? std::string(word) : to_text(value)).c_str());
}

// Reads the words of one line. A comment ends it.
struct LineCursor {
    const char* at;
    const char* end;

    void skip_blanks() {
        while (at != end && is_blank(*at))
            ++at;
        if (at != end && *at == '#') end = at;
    }
    bool at_end() const { return at == end; }
    bool at_word_end() const { return at == end || is_blank(*at); }
    std::string_view rest() const { return {at, static_cast<std::size_t>(end - at)}; }
    std::string_view word() {
        skip_blanks();
        const char* const begin = at;
        while (!at_word_end())
            ++at;
        return {begin, static_cast<std::size_t>(at - begin)};
    }

    // At most 15 digits, so that a double can hold the value.
    bool digits(std::uint64_t& value, int& count) {
        const char* const begin = at;
        value = 0;
        while (at != end && is_digit(*at))
            value = value * 10 + static_cast<std::uint64_t>(*at++ - '0');
        count = static_cast<int>(at - begin);
        return count > 0 && count <= 15;
    }

    // Reads digits with or without a point among them. Returns false for anything else and stays before it.
    bool plain_number(float& value) {
        skip_blanks();
        const char* const begin = at;
        const bool negative = at != end && *at == '-';
        if (negative) ++at;
        std::uint64_t whole = 0;
        std::uint64_t part = 0;
        int count = 0;
        bool plain = digits(whole, count) && whole < static_cast<std::uint64_t>(largest_obj_coordinate);
        auto sum = static_cast<float>(whole);
        if (plain && at != end && *at == '.') {
            ++at;
            plain = digits(part, count);
            // The same operations as in assimp, in its order: the whole number, the decimals and their sum
            // are rounded.
            if (plain) sum += static_cast<float>(static_cast<double>(part) * Assimp::fast_atof_table[count]);
        }
        if (!plain || !at_word_end()) {
            at = begin;
            return false;
        }
        value = negative ? -sum : sum;
        return true;
    }
};

}  // namespace slipface

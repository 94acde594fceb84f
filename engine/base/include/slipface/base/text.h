// Numbers and names as text, the same in every locale.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/base/types.h"

namespace slipface {

// The shortest text that reads back as the same double ("0.1", "1e-07").
std::string to_text(double value);

// Parses all of `text` as a finite double, or returns nothing. Accepts a leading '+'.
std::optional<double> parse_double(std::string_view text);

// Parses all of `text` as a decimal integer, or returns nothing. Accepts a leading '+'.
std::optional<std::int64_t> parse_int(std::string_view text);

// Parses "x,y,z" as three finite numbers, or returns nothing. White space around each number is allowed.
std::optional<Vec3> parse_vec3(std::string_view text);

// These return views into `text`, so a temporary string is refused.
std::string_view trim(std::string_view text);
std::vector<std::string_view> split(std::string_view text, char separator);
template <std::same_as<std::string> Temporary>
void trim(Temporary&&) = delete;
template <std::same_as<std::string> Temporary>
void split(Temporary&&, char) = delete;

std::string to_lower(std::string_view text);

// Any text as one line, and back: line ends and backslashes are escaped. For names in files of lines.
std::string on_one_line(std::string_view text);
std::string from_one_line(std::string_view line);

// Matches all of `text` against `pattern`: '*' stands for any run of characters, '?' for one. Not recursive;
// takes at most time proportional to the product of both lengths.
bool glob_match(std::string_view pattern, std::string_view text);

}  // namespace slipface

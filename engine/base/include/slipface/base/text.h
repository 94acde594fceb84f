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

// All of `text` as a finite double, or nothing. Accepts a leading '+'.
std::optional<double> parse_double(std::string_view text);

// All of `text` as an integer, or nothing.
std::optional<std::int64_t> parse_int(std::string_view text);

// "x,y,z" as three finite numbers, or nothing.
std::optional<Vec3> parse_vec3(std::string_view text);

// Parts of `text`, which must live as long as they do: not a temporary.
std::string_view trim(std::string_view text);
std::vector<std::string_view> split(std::string_view text, char separator);
template <std::same_as<std::string> Temporary>
void trim(Temporary&&) = delete;
template <std::same_as<std::string> Temporary>
void split(Temporary&&, char) = delete;

std::string to_lower(std::string_view text);

// `text` against a pattern in which '*' stands for any run of characters and '?' for one. Takes time linear
// in the text for a pattern with a bounded number of stars; never recursive.
bool glob_match(std::string_view pattern, std::string_view text);

}  // namespace slipface

// Numbers and vectors in the verbs' output.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <string_view>

#include "slipface/base/types.h"

namespace slipface::cli {

using OutputJson = nlohmann::ordered_json;

OutputJson vector_json(const Vec3& vector);

// Two-space indent; invalid UTF-8 in names becomes U+FFFD.
void print_json(std::ostream& out, const OutputJson& json);

// "name        value"; the values form one column.
void print_row(std::ostream& out, std::string_view name, std::string_view value);

std::string vector_text(const Vec3& vector);   // "1.000  -2.500  0.000"
std::string duration_text(double seconds);     // "1.20 s", "340 ms", "0.12 ms"
std::string bytes_text(std::size_t bytes);     // "1.4 MB"
std::string hash_text(std::uint64_t hash);     // 16 hexadecimal digits
std::string csv_field(std::string_view text);  // quoted if necessary

}  // namespace slipface::cli

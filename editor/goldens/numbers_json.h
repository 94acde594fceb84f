// The numbers as a JSON document, for the files of this module.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "slipface/base/hash.h"
#include "slipface/base/types.h"

namespace slipface {

using Numbers = nlohmann::ordered_json;

inline constexpr int numbers_version = 2;  // "version" in every file of numbers

inline Numbers json_of(const Vec3& v) {
    return Numbers::array({v.x(), v.y(), v.z()});
}

// Two-space indent, lists of plain values on one line, so that a diff shows one row per change.
std::string numbers_text(const Numbers& numbers);

std::string hex_text(std::uint64_t value);  // 16 digits

// What a golden says of an input: the bytes of its files and the facts that they were read as. Empty where an
// input has no files.
inline std::string input_mark(std::string_view facts, const std::string& bytes) {
    Hasher hasher;
    hasher.text(facts);
    return bytes.empty() ? "" : bytes + " " + hex_text(hasher.value());
}

}  // namespace slipface

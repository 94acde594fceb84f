// The numbers as a JSON document, for the files of this module.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "slipface/base/types.h"

namespace slipface {

using Numbers = nlohmann::ordered_json;

inline Numbers json_of(const Vec3& v) {
    return Numbers::array({v.x(), v.y(), v.z()});
}

// Two-space indent, lists of plain values on one line, so that a diff shows one row per change.
std::string numbers_text(const Numbers& numbers);

std::string hex_text(std::uint64_t value);  // 16 digits

}  // namespace slipface

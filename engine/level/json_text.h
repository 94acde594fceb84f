// JSON for level files: strict reading, stable writing, and nothing lost in between.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// One JSON value. Members keep their order and numbers keep their spelling, so a value that Slipface does not
// understand is written back as it was read.
struct Json {
    enum class Kind : std::uint8_t { null, boolean, number, string, array, object };

    Kind kind = Kind::null;
    bool truth = false;             // of a boolean
    std::string text;               // of a string; a number as it was spelled
    std::vector<Json> items;        // elements of an array, values of an object's members
    std::vector<std::string> keys;  // names of an object's members

    const Json* find(std::string_view key) const;  // a member, or null
};

inline constexpr int max_json_depth = 64;
inline constexpr std::size_t max_json_values = 4'000'000;

// Errors: location:line:column for text that is no JSON (cut off, junk after the end, bytes that are no
// UTF-8, a number beyond double); location:/path for a duplicate key, nesting deeper than max_depth, more
// than max_json_values values.
Result<Json> parse_json(std::string_view text, const std::string& location, int max_depth = max_json_depth);

// "a string", "the number 7", "an object", for error messages.
std::string json_kind_text(const Json& value);

// `text` for a message: at most about 240 bytes, with "..." in place of the middle; bytes that are no UTF-8
// become U+FFFD. A key or a string of a hostile file may be as long as the file.
std::string json_excerpt(std::string_view text);

// `text` in quotes and escaped; bytes that are no UTF-8 become U+FFFD.
std::string json_quoted(std::string_view text);

// On one line without spaces.
std::string json_compact(const Json& value);

// Objects and arrays of objects or long text on several lines, two spaces per level; arrays of numbers on one
// line. `indent`: the nesting level of the value; the first line is not indented.
std::string json_pretty(const Json& value, int indent);

Json json_number(double value);
Json json_number(float value);  // with the digits of a float
Json json_number(std::int64_t value);
Json json_string(std::string_view text);
Json json_bool(bool value);
Json json_array(std::vector<Json> items = {});
Json json_object(std::initializer_list<std::pair<const char*, Json>> members = {});
// The array of what `json_of` makes of each element.
template <class Range, class JsonOf>
Json json_array_of(const Range& range, const JsonOf& json_of) {
    Json array = json_array();
    for (const auto& element : range)
        array.items.push_back(json_of(element));
    return array;
}
void json_add(Json& object, std::string_view key, Json value);

}  // namespace slipface

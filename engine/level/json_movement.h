// Movement settings as JSON: one key a settings_table() row.
#pragma once

#include <set>
#include <string_view>

#include "json_reader.h"
#include "slipface/movement/settings.h"

namespace slipface {

std::set<std::string_view> setting_names();
Json settings_json(const MovementSettings& settings);
// What the object does not name stays. Leaves its error in the reader; then `settings` may be half changed.
void read_settings(JsonReader& reader, const Json& json, const std::string& path, MovementSettings& settings);

}  // namespace slipface

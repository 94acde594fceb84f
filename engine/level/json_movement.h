// Movement settings as JSON: one key per settings_table() row.
#pragma once

#include <set>
#include <string_view>

#include "json_reader.h"
#include "slipface/movement/settings.h"

namespace slipface {

std::set<std::string_view> setting_names();
Json settings_json(const MovementSettings& settings);
// Settings that the object does not name keep their values. An error is stored in the reader; then `settings`
// may be partly changed.
void read_settings(JsonReader& reader, const Json& json, const std::string& path, MovementSettings& settings);

}  // namespace slipface

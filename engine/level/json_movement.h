// Movement settings as JSON: one key per settings_table() row.
#pragma once

#include "json_reader.h"
#include "slipface/movement/settings.h"

namespace slipface {

Json settings_json(const MovementSettings& settings);
// Settings that the object does not name keep their values. After an error `settings` may be partly changed.
void read_settings(const JsonNode& node, MovementSettings& settings);

}  // namespace slipface

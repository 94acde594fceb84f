// What nearly every file above the level reads.
#pragma once

#include <nlohmann/json.hpp>

#include "precompiled.h"
#include "slipface/level/level_file.h"
#include "slipface/level/level_scene.h"

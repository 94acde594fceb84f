// What nearly every verb of the command line reads.
#pragma once

#include <CLI/CLI.hpp>

#include "precompiled_level.h"

// What nearly every test above the level reads.
#pragma once

#include "precompiled_level.h"
#include "precompiled_test.h"

// What nearly everything that the editor draws reads.
#pragma once

#include "precompiled_tools.h"
#include "widgets/ui.h"

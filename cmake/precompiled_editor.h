// What nearly everything that the editor draws reads.
#pragma once

#include "precompiled_level.h"
#include "tools/editor.h"
#include "widgets/ui.h"

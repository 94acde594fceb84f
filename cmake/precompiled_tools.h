// What nearly every tool of the editor reads.
#pragma once

#include "precompiled_level.h"
#include "tools/editor.h"

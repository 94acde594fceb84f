// What nearly every test of the editor reads.
#pragma once

#include "precompiled_editor.h"
#include "precompiled_test.h"

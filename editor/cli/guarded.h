// Every verb ends with an exit code, even if a library throws.
#pragma once

#include <exception>
#include <iostream>

#include "cli/verbs.h"

namespace slipface::cli {

// The verb's exit code; bad input for an uncaught exception such as too little memory.
template <class Run>
int guarded(Run run) {
    try {
        return run();
    } catch (const std::exception& error) {
        print_error(std::cerr, {"", error.what()});
        return exit_bad_input;
    }
}

}  // namespace slipface::cli

// The program's exit codes.
#pragma once

namespace slipface::cli {

inline constexpr int exit_fine = 0;
inline constexpr int exit_check_failed = 1;  // the check ran and failed
inline constexpr int exit_bad_input = 2;     // a file or a value in it is wrong
inline constexpr int exit_bad_usage = 64;    // the command line is wrong
inline constexpr const char* exit_codes_help =
    "Exit codes: 0 fine, 1 a check failed, 2 bad input, 64 bad usage.";

}  // namespace slipface::cli

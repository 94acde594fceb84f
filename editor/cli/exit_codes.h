// The program's exit codes.
#pragma once

namespace slipface::cli {

inline constexpr int exit_fine = 0;
inline constexpr int exit_check_failed = 1;  // the check ran and failed
inline constexpr int exit_bad_input = 2;     // a file or a value in it is wrong
inline constexpr int exit_bad_usage = 64;    // the command line is wrong

}  // namespace slipface::cli

// What programs ask of the operating system, and paths as text. engine/base/platform has the answers of each
// system.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace slipface {

// The path that UTF-8 text spells. On Windows names are UTF-16, std::filesystem reads text in another
// encoding there, and what is no UTF-8 becomes U+FFFD; on other systems a name is any bytes, and stays as it
// is.
std::filesystem::path path_of(std::string_view text);

// The first call of main(): its arguments as UTF-8. From here on output has the same bytes on every system,
// and a write that the system refuses (a full disk, a limit on a file's size) fails with a reason instead of
// ending the program.
std::vector<std::string> begin_program(int argument_count, char** arguments);

}  // namespace slipface

#include <csignal>

#include "slipface/base/system.h"

namespace slipface {

std::filesystem::path path_of(std::string_view text) {
    return std::filesystem::path(text);
}

std::vector<std::string> begin_program(int argument_count, char** arguments) {
    std::signal(SIGXFSZ, SIG_IGN);
    // The parent may ignore the end of its children, and a child inherits that: then no wait for a process
    // returns its exit status.
    std::signal(SIGCHLD, SIG_DFL);
    return {arguments, arguments + argument_count};
}

}  // namespace slipface

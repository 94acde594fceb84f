// The pages of docs/ that are generated from tables, so that they always agree with the program.
#pragma once

#include <string>

namespace slipface {

std::string commands_markdown();  // docs/commands.md
std::string settings_markdown();  // docs/settings.md: movement settings and surface type parameters

}  // namespace slipface

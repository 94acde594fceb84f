#pragma once

#include <string>

namespace slipface {

// Opens the editor on the results of a check. Without a display it prints the page that shows the same.
int snapshot_review(const std::string& report_file);

}  // namespace slipface

#pragma once

#include <string>

namespace slipface {

// Opens the editor on what a check found. Without a display names the page that shows the same.
int snapshot_review(const std::string& report_file);

}  // namespace slipface

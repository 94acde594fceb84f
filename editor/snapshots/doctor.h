#pragma once

#include <string>
#include <vector>

namespace slipface {

// Prints what it found; 1 when something is wrong. `pictures` are put through the gate's self-test, too.
int snapshot_doctor(const std::vector<std::string>& images);
// In a process of its own, with one backend: writes FOLDER/first.png, second.png and renderer.txt.
int snapshot_doctor_part(const std::string& folder);

}  // namespace slipface

#pragma once

#include <string>
#include <vector>

namespace slipface {

// Prints its findings; returns 1 if something is wrong. The gate's self-test also runs on `images`.
int snapshot_doctor(const std::vector<std::string>& images);
// Runs in its own process with one backend: writes FOLDER/first.png, second.png and renderer.txt.
int snapshot_doctor_part(const std::string& folder);

}  // namespace slipface

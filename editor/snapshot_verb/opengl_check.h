#pragma once

#include <string>
#include <vector>

namespace slipface {

// Prints its findings; returns 1 if something is wrong. The gate's self-test also runs on `images`.
int check_opengl(const std::vector<std::string>& images);
// Runs in its own process with one backend: writes FOLDER/first.png, second.png and renderer.txt.
int check_opengl_part(const std::string& folder);

}  // namespace slipface

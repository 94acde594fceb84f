// Reading the formats of other programs in a child process.
//
// assimp reads them, and a damaged file can crash it, nest deeper than its stack, take all memory or never
// end. In a child process none of this harms the program: import_mesh() then returns an error that says what
// happened. The program `slipface` does so; a game that loads only its own files need not.
#pragma once

#include <string>
#include <vector>

namespace slipface {

// From now on import_mesh() runs `command` with some arguments more for each file but an OBJ: a
// program that passes these arguments to read_scene_as_child(). Call it before the first import; empty: read
// in this process, as is the default.
void read_scenes_in_child(std::vector<std::string> command);

// The child's part: reads the scene that the arguments name, within their limits of memory and processor
// time, and writes it to the file descriptor 3. Returns the exit code of the process.
int read_scene_as_child(const std::vector<std::string>& arguments);

}  // namespace slipface

#pragma once

#include <string>
#include <string_view>

#include "assimp/imported_soup.h"

struct aiScene;

namespace slipface {

struct SceneFrame {
    FileFrame frame;
    bool root_is_frame = false;  // the root's transformation is a correction by assimp, not from the file
};

// The unit and axes of a file that assimp read: as the file declares (FBX, COLLADA), else as the usual
// writers of its format do. `bytes`: the content of the file, for data that assimp does not pass on.
SceneFrame scene_frame(const aiScene& scene, const std::string& extension, std::string_view bytes);

}  // namespace slipface

#pragma once

#include <string>
#include <string_view>

#include "imported_soup.h"

struct aiScene;

namespace slipface {

struct SceneFrame {
    FileFrame frame;
    bool root_is_frame = false;  // the root's own transformation is assimp's correction, not the file's
};

// The unit and axes of a file that assimp read: what it declares (FBX, COLLADA, glTF), else what the usual
// writers of its format mean. `bytes` are the file's own, for what assimp does not pass on.
SceneFrame scene_frame(const aiScene& scene, const std::string& extension, std::string_view bytes);

}  // namespace slipface

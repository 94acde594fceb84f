// What the readers of single formats hand to import_mesh().
#pragma once

#include <string>
#include <vector>

#include "slipface/mesh/build.h"
#include "slipface/mesh/import.h"
#include "slipface/mesh/upright.h"

namespace slipface {

// What a file says of its coordinates, or what its format's usual writers mean by them.
struct FileFrame {
    double scale = 1.0;  // metres per unit
    ImportSource scale_from = ImportSource::guessed;
    std::string scale_reason = "no unit in the file";
    UpAxis up = UpAxis::y;
    ImportSource up_from = ImportSource::guessed;
    std::string up_reason = "no axis in the file";
    // To +Y up and right-handed. Of a declared frame it may also turn about the vertical, or mirror.
    Eigen::Matrix3f upright = Eigen::Matrix3f::Identity();
};

// A frame whose rotation follows from the axis.
FileFrame frame_of(double scale, ImportSource scale_from, std::string scale_reason, UpAxis up,
                   ImportSource up_from, std::string up_reason);

struct ImportedSoup {
    PolygonSoup soup;  // in the file's own coordinates
    FileFrame frame = {};
    std::vector<FoundSpawn> spawns = {};  // the feet in the file's coordinates
    std::vector<FoundType> types = {};
    std::size_t drawn_faces = no_id;  // the faces from here on are not drawn
    bool through_assimp = false;
};

}  // namespace slipface

// The result of the format readers for import_mesh().
#pragma once

#include <string>
#include <vector>

#include "slipface/mesh/build.h"
#include "slipface/mesh/import.h"
#include "slipface/mesh/upright.h"

namespace slipface {

// The meaning of a file's coordinates: as the file declares, or as the usual writers of its format do.
struct FileFrame {
    double scale = 1.0;  // metres per unit
    ImportSource scale_from = ImportSource::guessed;
    std::string scale_reason = "no unit in the file";
    UpAxis up = UpAxis::y;
    ImportSource up_from = ImportSource::guessed;
    std::string up_reason = "no axis in the file";
    // To +Y up and right-handed. A declared frame may also rotate about the vertical, or mirror.
    Eigen::Matrix3f upright = Eigen::Matrix3f::Identity();
};

// A frame whose rotation follows from the up axis.
FileFrame frame_of(double scale, ImportSource scale_from, std::string scale_reason, UpAxis up,
                   ImportSource up_from, std::string up_reason);

struct ImportedSoup {
    PolygonSoup soup;  // in the file's own coordinates
    FileFrame frame = {};
    std::vector<FoundSpawn> spawns = {};  // feet in coordinates of the file
    std::vector<FoundType> types = {};
    std::string type_table = {};       // as ImportedMesh::type_table
    std::vector<FaceId> undrawn = {};  // likewise
};

}  // namespace slipface

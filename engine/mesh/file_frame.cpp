#include <utility>

#include "assimp/imported_soup.h"

namespace slipface {

Eigen::Matrix3f upright_rotation(UpAxis up) {
    Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
    switch (up) {
        case UpAxis::y: break;
        case UpAxis::z: rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0; break;
        case UpAxis::x: rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1; break;
        case UpAxis::minus_y: rotation << 1, 0, 0, 0, -1, 0, 0, 0, -1; break;
        case UpAxis::minus_z: rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0; break;
        case UpAxis::minus_x: rotation << 0, 1, 0, -1, 0, 0, 0, 0, 1; break;
    }
    return rotation;
}

FileFrame frame_of(double scale, ImportSource scale_from, std::string scale_reason, UpAxis up,
                   ImportSource up_from, std::string up_reason) {
    return {scale,   scale_from,           std::move(scale_reason), up,
            up_from, std::move(up_reason), upright_rotation(up)};
}

}  // namespace slipface

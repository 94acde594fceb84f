#pragma once

#include "slipface/mesh/import.h"

namespace slipface {

// The rotation that makes `up` +Y. For y and z it is that of the usual exporters: (x, z, -y) for z.
Eigen::Matrix3f upright_rotation(UpAxis up);

}  // namespace slipface

#include "boxes.h"

namespace slipface::doctor {

Boxes::Boxes() {
    for (std::size_t lane = 0; lane < lanes; ++lane)
        set(lane, Box());
}

void Boxes::set(std::size_t lane, const Box& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        min[axis][lane] = box.min[static_cast<int>(axis)];
        max[axis][lane] = box.max[static_cast<int>(axis)];
    }
}

}  // namespace slipface::doctor

#include "slipface/movement/heightfield.h"

#include <algorithm>
#include <cmath>

namespace slipface {

Vec3 Heightfield::corner(int column, int row) const {
    return {origin.x() + size.x() * column / (columns - 1), height(column, row),
            origin.z() + size.y() * row / (rows - 1)};
}

std::optional<TerrainPoint> terrain_at(const Heightfield& field, double x, double z) {
    if (field.columns < 2 || field.rows < 2 || !(field.size.minCoeff() > 0.0)) return std::nullopt;
    const double across = (x - field.origin.x()) / field.size.x();
    const double along = (z - field.origin.z()) / field.size.y();
    if (!(across >= 0.0 && across <= 1.0 && along >= 0.0 && along <= 1.0)) return std::nullopt;
    const double u = across * (field.columns - 1);
    const double v = along * (field.rows - 1);
    const int column = std::min(static_cast<int>(u), field.columns - 2);
    const int row = std::min(static_cast<int>(v), field.rows - 2);
    const double du = u - column;
    const double dv = v - row;

    const double near = field.height(column, row);
    const double far = field.height(column + 1, row + 1);
    const double beside = du >= dv ? field.height(column + 1, row) : field.height(column, row + 1);
    const double per_u = du >= dv ? beside - near : far - beside;
    const double per_v = du >= dv ? far - beside : beside - near;
    const Vec3 upward(-per_u * (field.columns - 1) / field.size.x(), 1.0,
                      -per_v * (field.rows - 1) / field.size.y());
    return TerrainPoint{near + per_u * du + per_v * dv, upward / upward.norm()};
}

}  // namespace slipface

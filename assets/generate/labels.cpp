#include "labels.h"

#include <algorithm>
#include <stdexcept>

namespace slipface::generate {

void add_label(Model& model, const std::string& text, const Vec3& from, const Vec3& to) {
    const auto* found = std::find(labels.begin(), labels.end(), text);
    if (found == labels.end()) throw std::logic_error("no sign says " + text);
    const auto cell = static_cast<int>(found - labels.begin());
    const double u0 = static_cast<double>(cell % label_columns) / label_columns;
    const double u1 = u0 + 1.0 / label_columns;
    const double v1 = 1.0 - static_cast<double>(cell / label_columns) / label_rows;
    const double v0 = v1 - 1.0 / label_rows;
    const Vec3 up = 0.5 * (to - from).norm() * Vec3::UnitY();
    model.face_uv("sign_labels",
                  {{from, {u0, v0}}, {to, {u1, v0}}, {to + up, {u1, v1}}, {from + up, {u0, v1}}});
}

}  // namespace slipface::generate

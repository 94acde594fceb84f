#include "slipface/mesh/material_looks.h"

#include <fmt/format.h>

namespace slipface {

MaterialLooks::Look MaterialLooks::look_of(const Material& material) {
    const Vec3f& color = material.diffuse;
    return {material.name, color[0], color[1], color[2], material.texture, material.picture};
}

void MaterialLooks::add(const Material& material) {
    if (taken_.insert(material.name).second) names_.emplace(look_of(material), material.name);
}

void MaterialLooks::name(Material& material) {
    const auto [known, added] = names_.try_emplace(look_of(material), material.name);
    std::string& name = known->second;
    while (added && !taken_.insert(name).second)
        name = fmt::format("{}.{:03}", material.name, ++numbers_[material.name]);
    material.name = name;
}

}  // namespace slipface

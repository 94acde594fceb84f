#include "material_names.h"

#include <filesystem>
#include <map>
#include <tuple>

#include "slipface/mesh/material_looks.h"

namespace slipface {
namespace {

std::string name_of_texture(const std::string& texture) {
    return std::filesystem::path(texture.substr(texture.find_last_of("/\\") + 1)).stem().string();
}

}  // namespace

void name_materials(PolygonSoup& soup) {
    std::vector<bool> used(soup.materials.size(), false);
    for (const std::uint32_t number : soup.face_material)
        if (number < used.size()) used[number] = true;
    MaterialLooks looks;
    std::map<std::tuple<std::string, float, float, float>, std::uint32_t> number_of;
    std::vector<std::uint32_t> numbers;  // [material before]
    std::vector<Material> materials;
    for (std::uint32_t i = 0; i < soup.materials.size(); ++i) {
        Material& material = soup.materials[i];
        if (material.name.empty()) material.name = name_of_texture(material.texture);
        if (!material.name.empty()) looks.name(material);
        // What assimp adds for faces without a material where there are none.
        if (material.name.empty() && !used[i]) {
            numbers.push_back(no_id);
            continue;
        }
        const Vec3f& color = material.diffuse;
        const auto [known, added] = number_of.try_emplace({material.name, color[0], color[1], color[2]},
                                                          static_cast<std::uint32_t>(materials.size()));
        numbers.push_back(known->second);
        if (added) materials.push_back(std::move(material));
    }
    soup.materials = std::move(materials);
    for (std::uint32_t& number : soup.face_material)
        if (number < numbers.size()) number = numbers[number];
}

}  // namespace slipface

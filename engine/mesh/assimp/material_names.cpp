#include "assimp/material_names.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <tuple>

namespace slipface {
namespace {

// The file's name without its folder and its ending.
std::string name_of_texture(const std::string& texture) {
    const std::size_t folder = texture.find_last_of("/\\");
    const std::string file = folder == std::string::npos ? texture : texture.substr(folder + 1);
    const std::size_t ending = file.rfind('.');
    return ending == std::string::npos || ending == 0 ? file : file.substr(0, ending);
}

// Leaves out, too, what assimp adds for faces without a material where there are none.
void join_equal(PolygonSoup& soup) {
    std::vector<bool> used(soup.materials.size(), false);
    for (const std::uint32_t number : soup.face_material)
        if (number < used.size()) used[number] = true;
    using Key = std::tuple<std::string, std::string, const std::string*, float, float, float>;
    std::map<Key, std::uint32_t> number_of;
    std::vector<std::uint32_t> numbers;  // [material before]
    std::vector<Material> materials;
    for (std::uint32_t i = 0; i < soup.materials.size(); ++i) {
        Material& material = soup.materials[i];
        if (material.name.empty() && !used[i]) {
            numbers.push_back(no_id);
            continue;
        }
        const auto& color = material.diffuse;
        const auto [known, added] = number_of.try_emplace(
            Key(material.name, material.texture, material.picture.get(), color[0], color[1], color[2]),
            static_cast<std::uint32_t>(materials.size()));
        numbers.push_back(known->second);
        if (added) materials.push_back(std::move(material));
    }
    soup.materials = std::move(materials);
    for (std::uint32_t& number : soup.face_material)
        if (number < numbers.size()) number = numbers[number];
}

}  // namespace

void name_materials(PolygonSoup& soup) {
    for (Material& material : soup.materials)
        if (material.name.empty()) material.name = name_of_texture(material.texture);
    join_equal(soup);
    std::set<std::string> names;
    for (const Material& material : soup.materials)
        names.insert(material.name);
    std::set<std::string> taken;
    std::map<std::string, int> last;  // number that a name was given
    for (Material& material : soup.materials) {
        if (material.name.empty() || taken.insert(material.name).second) continue;
        const std::string name = material.name;
        do {
            material.name = fmt::format("{}.{:03}", name, ++last[name]);
        } while (names.contains(material.name));
        names.insert(material.name);
        taken.insert(material.name);
    }
}

}  // namespace slipface

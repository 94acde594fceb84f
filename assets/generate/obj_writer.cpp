#include "obj_writer.h"

#include <cstdlib>

namespace slipface::generate {
namespace {

// A number of units of 1e-4 as a decimal without trailing zeros.
std::string decimal(std::int64_t units) {
    const auto per_unit = static_cast<std::int64_t>(grid_per_unit);
    const std::int64_t magnitude = std::abs(units);
    std::string text = units < 0 ? "-" : "";
    text += std::to_string(magnitude / per_unit);
    std::string fraction = std::to_string(per_unit + magnitude % per_unit).substr(1);
    while (!fraction.empty() && fraction.back() == '0') fraction.pop_back();
    return fraction.empty() ? text : text + "." + fraction;
}

}  // namespace

std::string obj_text(const Model& model, const std::string& title, const std::string& mtl_name) {
    std::string text = "# Slipface level: " + title + ". Metres, +Y up. Made by slipface_generate_levels.\n";
    text += "mtllib " + mtl_name + "\n";
    for (const auto& position : model.positions()) {
        text += "v " + decimal(position[0]) + " " + decimal(position[1]) + " " + decimal(position[2]) + "\n";
    }
    for (const auto& uv : model.uvs()) text += "vt " + decimal(uv[0]) + " " + decimal(uv[1]) + "\n";

    for (std::size_t group = 0; group < model.groups().size(); ++group) {
        text += "o " + model.groups()[group] + "\n";
        for (std::size_t material = 0; material < model.materials().size(); ++material) {
            bool named = false;
            for (const ModelFace& face : model.faces()) {
                if (face.group != group || face.material != material) continue;
                if (!named) text += "usemtl " + model.materials()[material].name + "\n";
                named = true;
                text += "f";
                for (std::size_t i = 0; i < face.vertices.size(); ++i) {
                    text += " " + std::to_string(face.vertices[i] + 1) + "/" + std::to_string(face.uvs[i] + 1);
                }
                text += "\n";
            }
        }
    }
    return text;
}

std::string mtl_text(const Model& model, const std::string& title) {
    std::vector<bool> used(model.materials().size());
    for (const ModelFace& face : model.faces()) used[face.material] = true;
    std::string text = "# Materials of the Slipface level: " + title + "\n";
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        const ModelMaterial& material = model.materials()[i];
        text += "\nnewmtl " + material.name + "\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\n";
        text += "map_Kd textures/" + material.texture + ".png\n";
    }
    return text;
}

}  // namespace slipface::generate

#include "obj_writer.h"

#include <fmt/format.h>

#include <cstdlib>
#include <iterator>

namespace slipface::generate {
namespace {

// A number of units of 1e-4 as a decimal without trailing zeros.
std::string decimal(std::int64_t units) {
    const auto per_unit = static_cast<std::int64_t>(grid_per_unit);
    const std::int64_t magnitude = std::abs(units);
    std::string text =
        fmt::format("{}{}.{:04}", units < 0 ? "-" : "", magnitude / per_unit, magnitude % per_unit);
    while (text.back() == '0')
        text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

}  // namespace

std::string obj_text(const Model& model, const std::string& title, const std::string& mtl_name) {
    std::string text =
        fmt::format("# Slipface level: {}. Metres, +Y up. Made by slipface_generate_levels.\nmtllib {}\n",
                    title, mtl_name);
    const auto out = std::back_inserter(text);
    for (const auto& at : model.positions()) {
        fmt::format_to(out, "v {} {} {}\n", decimal(at[0]), decimal(at[1]), decimal(at[2]));
    }
    for (const auto& uv : model.uvs())
        fmt::format_to(out, "vt {} {}\n", decimal(uv[0]), decimal(uv[1]));

    for (std::size_t group = 0; group < model.groups().size(); ++group) {
        fmt::format_to(out, "o {}\n", model.groups()[group]);
        for (std::size_t material = 0; material < model.materials().size(); ++material) {
            bool named = false;
            for (const ModelFace& face : model.faces()) {
                if (face.group != group || face.material != material) continue;
                if (!named) fmt::format_to(out, "usemtl {}\n", model.materials()[material].name);
                named = true;
                text += 'f';
                for (std::size_t i = 0; i < face.vertices.size(); ++i) {
                    fmt::format_to(out, " {}/{}", face.vertices[i] + 1, face.uvs[i] + 1);
                }
                text += '\n';
            }
        }
    }
    return text;
}

std::string mtl_text(const Model& model, const std::string& title) {
    std::vector<bool> used(model.materials().size());
    for (const ModelFace& face : model.faces())
        used[face.material] = true;
    std::string text = fmt::format("# Materials of the Slipface level: {}\n", title);
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        const ModelMaterial& material = model.materials()[i];
        fmt::format_to(std::back_inserter(text),
                       "\nnewmtl {}\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd textures/{}.png\n",
                       material.name, material.texture);
    }
    return text;
}

}  // namespace slipface::generate

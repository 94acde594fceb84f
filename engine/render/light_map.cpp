#include "light_map.h"

#include <algorithm>
#include <array>

#include "slipface/base/named_file.h"
#include "slipface/image/image.h"
#include "slipface/mesh/light_charts.h"

namespace slipface {

namespace {

constexpr std::size_t row_faces = 1024;  // faces in a row of the chart texture
constexpr std::size_t texels_per_face = 3;

using ChartTexels = std::array<std::array<float, 4>, texels_per_face>;

std::array<float, 4> axis_texel(const LightChart& chart, const Vec3& axis, double step, const Vec3& origin) {
    const Vec3 scaled = step > 0.0 ? Vec3(axis / step) : Vec3(Vec3::Zero());
    const Eigen::Vector3f direction = scaled.cast<float>();
    return {direction.x(), direction.y(), direction.z(),
            static_cast<float>(scaled.dot(origin - chart.origin))};
}

ChartTexels chart_texels(const LightChart& chart, const Vec3& origin) {
    const auto last = [](std::uint16_t side) { return static_cast<float>(side > 0 ? side - 1 : 0); };
    return {axis_texel(chart, chart.u, chart.step.x(), origin),
            axis_texel(chart, chart.v, chart.step.y(), origin),
            {static_cast<float>(chart.x) + 0.5f, static_cast<float>(chart.y) + 0.5f, last(chart.width),
             last(chart.height)}};
}

unsigned make_texture(const GladGLContext& gl, GLint filter) {
    unsigned texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    return texture;
}

}  // namespace

Warnings LightMap::load(const Mesh& mesh, std::size_t drawn_faces, const LevelLight& light,
                        const std::filesystem::path& folder, const Vec3& origin) {
    clear();
    if (light.image.empty()) return {};
    const NamedFile file = named_file(light.image, folder);
    if (!file) return {{file.path.string(), file.error().message + "; drawn without baked light"}};
    const std::filesystem::path& path = file.path;
    const auto refused = [&](const std::string& reason) {
        return Warnings{{path.string(), reason + "; drawn without baked light"}};
    };
    const Result<LightCharts> charts = light_charts(mesh, light.texel_m);
    if (!charts) return refused(charts.error().text());
    if (charts->geometry != light.geometry)
        return refused("was baked for other geometry; bake it again with \"slipface bake-light\"");
    const Result<Image> image = load_image(path, max_light_map_side);
    if (!image) return {{path.string(), image.error().message + "; drawn without baked light"}};
    if (image->width != charts->width || image->height != charts->height) {
        return refused("found " + std::to_string(image->width) + " x " + std::to_string(image->height) +
                       " pixels, expected " + std::to_string(charts->width) + " x " +
                       std::to_string(charts->height));
    }
    image_ = make_texture(*gl_, GL_LINEAR);
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image->width, image->height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                    image->rgba.data());

    const std::size_t rows = (std::max(drawn_faces, mesh.face_count()) + row_faces - 1) / row_faces;
    std::vector<ChartTexels> texels(rows * row_faces);
    for (std::size_t face = 0; face < mesh.face_count(); ++face)
        texels[face] = chart_texels(charts->charts[face], origin);
    charts_ = make_texture(*gl_, GL_NEAREST);
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, static_cast<GLsizei>(texels_per_face * row_faces),
                    static_cast<GLsizei>(rows), 0, GL_RGBA, GL_FLOAT, texels.data());
    gl_->BindTexture(GL_TEXTURE_2D, 0);
    return {};
}

void LightMap::clear() {
    for (unsigned* texture : {&image_, &charts_}) {
        if (*texture != 0) gl_->DeleteTextures(1, texture);
        *texture = 0;
    }
}

}  // namespace slipface

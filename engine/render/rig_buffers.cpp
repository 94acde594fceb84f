#include "rig_buffers.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace slipface {
namespace {

constexpr std::size_t texture_width = 1024;  // texels
constexpr int pose_unit = 5, delta_unit = 6;

struct RigVertex {
    std::array<std::uint16_t, Rig::bones_per_corner> bones;
    std::array<float, Rig::bones_per_corner> weights;
    std::uint32_t first_delta, deltas;
};

// `texels`: four numbers each; lengthened to whole rows.
void send_texels(const GladGLContext& gl, unsigned texture, std::vector<float>& texels) {
    const std::size_t rows =
        std::max<std::size_t>(1, (texels.size() / 4 + texture_width - 1) / texture_width);
    texels.resize(4 * rows * texture_width, 0.0F);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, static_cast<GLsizei>(texture_width),
                  static_cast<GLsizei>(rows), 0, GL_RGBA, GL_FLOAT, texels.data());
    gl.BindTexture(GL_TEXTURE_2D, 0);
}

}  // namespace

Mesh before_bones(const Mesh& mesh) {
    Mesh own = mesh;
    own.positions = mesh.rig->corner_position;
    own.corner_vertex.resize(own.positions.size());
    std::iota(own.corner_vertex.begin(), own.corner_vertex.end(), 0U);
    return own;
}

RigBuffers::RigBuffers(GlTable gl, unsigned vertex_array, const Mesh& mesh, const DrawOrder& order)
    : gl_(std::move(gl)), bones_(mesh.rig->bones.size()), weights_(mesh.rig->weights.size()) {
    const Rig& rig = *mesh.rig;
    pose_rig(rig, no_id, 0.0, rest_);
    std::vector<RigVertex> vertices;
    vertices.reserve(3 * order.triangles.size());
    for (const TriangleId triangle : order.triangles) {
        for (const std::uint32_t corner : mesh.triangles[triangle]) {
            const bool morphs = !rig.corner_first_delta.empty();
            const std::uint32_t first = morphs ? rig.corner_first_delta[corner] : 0;
            vertices.push_back({rig.corner_bones[corner], rig.corner_weights[corner], first,
                                morphs ? rig.corner_first_delta[corner + 1] - first : 0});
        }
    }
    gl_->GenBuffers(1, &buffer_);
    gl_->BindVertexArray(vertex_array);
    gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_);
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(RigVertex)),
                    vertices.data(), GL_STATIC_DRAW);
    const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
    constexpr GLsizei stride = sizeof(RigVertex);
    gl_->VertexAttribIPointer(5, 4, GL_UNSIGNED_SHORT, stride, offset(offsetof(RigVertex, bones)));
    gl_->VertexAttribPointer(6, 4, GL_FLOAT, GL_FALSE, stride, offset(offsetof(RigVertex, weights)));
    gl_->VertexAttribIPointer(7, 2, GL_UNSIGNED_INT, stride, offset(offsetof(RigVertex, first_delta)));
    for (unsigned attribute = 5; attribute < 8; ++attribute)
        gl_->EnableVertexAttribArray(attribute);
    gl_->BindVertexArray(0);
    for (unsigned* texture : {&pose_texture_, &delta_texture_}) {
        gl_->GenTextures(1, texture);
        gl_->BindTexture(GL_TEXTURE_2D, *texture);
        gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    std::vector<float> deltas;
    for (const MorphDelta& from : rig.deltas)
        deltas.insert(deltas.end(),
                      {from.delta.x(), from.delta.y(), from.delta.z(), static_cast<float>(from.weight)});
    send_texels(*gl_, delta_texture_, deltas);
}

RigBuffers::~RigBuffers() {
    gl_->DeleteBuffers(1, &buffer_);
    gl_->DeleteTextures(1, &pose_texture_);
    gl_->DeleteTextures(1, &delta_texture_);
}

// Three texels for each bone, the rows of its matrix, and one for each weight.
void RigBuffers::send(std::span<const RigPose* const> poses) {
    texels_.clear();
    for (const RigPose* const given : poses) {
        const RigPose& pose = given == nullptr || given->bones.size() != bones_ ? rest_ : *given;
        for (const Affine& bone : pose.bones)
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 4; ++column)
                    texels_.push_back(bone(row, column));
        for (const float weight : pose.weights)
            texels_.insert(texels_.end(), {weight, 0.0F, 0.0F, 0.0F});
    }
    send_texels(*gl_, pose_texture_, texels_);
}

void RigBuffers::bind(unsigned program, std::size_t pose) const {
    const std::size_t first = pose * (3 * bones_ + weights_);
    set_uniform(*gl_, program, "first_pose", static_cast<int>(first));
    set_uniform(*gl_, program, "first_weight", static_cast<int>(first + 3 * bones_));
    set_uniform(*gl_, program, "poses", pose_unit);
    set_uniform(*gl_, program, "morph_deltas", delta_unit);
    gl_->ActiveTexture(GL_TEXTURE0 + pose_unit);
    gl_->BindTexture(GL_TEXTURE_2D, pose_texture_);
    gl_->ActiveTexture(GL_TEXTURE0 + delta_unit);
    gl_->BindTexture(GL_TEXTURE_2D, delta_texture_);
    gl_->ActiveTexture(GL_TEXTURE0);
}

}  // namespace slipface

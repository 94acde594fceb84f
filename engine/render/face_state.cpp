#include "face_state.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace slipface {

namespace {

constexpr std::size_t row_faces = 4096;

}  // namespace

FaceState::FaceState(GlTable gl) : gl_(std::move(gl)) {
    gl_->GenTextures(1, &texture_);
    gl_->BindTexture(GL_TEXTURE_2D, texture_);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    resize(0);
}

FaceState::~FaceState() {
    gl_->DeleteTextures(1, &texture_);
}

void FaceState::resize(std::size_t faces) {
    const std::size_t rows = std::max<std::size_t>(1, (faces + row_faces - 1) / row_faces);
    faces_ = faces;
    for (std::vector<std::uint8_t>& channel : values_)
        channel.assign(rows * row_faces, 0);
    const std::vector<std::uint8_t> zeros(2 * rows * row_faces, 0);
    gl_->BindTexture(GL_TEXTURE_2D, texture_);
    gl_->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RG8UI, static_cast<GLsizei>(row_faces), static_cast<GLsizei>(rows),
                    0, GL_RG_INTEGER, GL_UNSIGNED_BYTE, zeros.data());
    gl_->BindTexture(GL_TEXTURE_2D, 0);
}

// Uploads, for each row of the texture, the span from the first to the last changed face.
void FaceState::change(std::span<const std::uint8_t> values, Channel channel) {
    std::vector<std::uint8_t>& own = values_[channel == Channel::surface ? 0 : 1];
    const std::size_t faces = std::min(values.size(), faces_);
    gl_->BindTexture(GL_TEXTURE_2D, texture_);
    gl_->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    std::array<std::uint8_t, 2 * row_faces> pairs;
    for (std::size_t begin = 0; begin < faces; begin += row_faces) {
        const std::size_t end = std::min(faces, begin + row_faces);
        if (std::memcmp(&own[begin], &values[begin], end - begin) == 0) continue;
        std::size_t first = begin, last = end - 1;
        while (own[first] == values[first])
            ++first;
        while (own[last] == values[last])
            --last;
        const std::size_t count = last - first + 1;
        std::copy_n(&values[first], count, &own[first]);
        for (std::size_t i = 0; i < count; ++i) {
            pairs[2 * i] = values_[0][first + i];
            pairs[2 * i + 1] = values_[1][first + i];
        }
        gl_->TexSubImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(first - begin),
                           static_cast<GLint>(begin / row_faces), static_cast<GLsizei>(count), 1,
                           GL_RG_INTEGER, GL_UNSIGNED_BYTE, pairs.data());
        bytes_uploaded_ += 2 * count;
    }
    gl_->BindTexture(GL_TEXTURE_2D, 0);
}

}  // namespace slipface

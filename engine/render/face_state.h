// The surface type and the highlight of every face, as a texture that the level's shader reads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gl_util.h"

namespace slipface {

class FaceState {
  public:
    enum class Channel { surface, highlight };

    explicit FaceState(GlTable gl);
    ~FaceState();
    FaceState(const FaceState&) = delete;
    FaceState& operator=(const FaceState&) = delete;

    // Sets the number of faces; all get 0 in both channels.
    void resize(std::size_t faces);
    // Sets one channel of the first values.size() faces, and uploads the changes.
    void change(std::span<const std::uint8_t> values, Channel channel);

    unsigned texture() const { return texture_; }  // red: surface, green: highlight; faces in rows
    std::size_t bytes_uploaded() const { return bytes_uploaded_; }

  private:
    GlTable gl_;
    unsigned texture_ = 0;
    std::size_t faces_ = 0;
    std::array<std::vector<std::uint8_t>, 2> values_;  // [Channel][face]; whole rows
    std::size_t bytes_uploaded_ = 0;
};

}  // namespace slipface

// The 3D view's picture: keeps the GPU's copy of the level up to date and draws only when something shown has
// changed.
#pragma once

#include <memory>

#include "panels/panels.h"

namespace slipface {

class SceneView final : public ViewportServices {
  public:
    SceneView(GlTable gl, Editor& editor);

    // Remembers what is wanted; draw() makes it.
    unsigned render(const Camera& camera, const Overlay& overlay, int width, int height) override;

    void begin_frame() { wanted_ = false; }
    std::uint64_t wanted_hash() const { return wanted_ ? wanted_hash_ : 0; }
    void draw();  // into the texture that render() returned; nothing if it holds that picture already

    Image picture() const { return target_ ? target_->read() : Image{}; }

    const Warnings& texture_warnings() const { return texture_warnings_; }

  private:
    void upload();

    GlTable gl_;
    Editor& editor_;
    LevelRenderer level_;
    OverlayRenderer overlay_renderer_;
    std::unique_ptr<Framebuffer> target_;

    MeshPtr mesh_;  // uploaded
    std::uint64_t face_revision_ = 0, highlights_hash_ = 0;
    std::vector<std::uint8_t> highlights_;
    std::uint64_t uploads_ = 0;  // counts up whenever the GPU's copy changed
    Warnings texture_warnings_;

    Camera camera_;
    Overlay overlay_;
    bool wanted_ = false;
    std::uint64_t wanted_hash_ = 0, drawn_hash_ = 0;
};

}  // namespace slipface

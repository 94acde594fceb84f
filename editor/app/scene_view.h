// The image of the 3D view: updates the GPU's copy of the level and draws only if something visible has
// changed.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "panels/panels.h"
#include "slipface/render/level_renderer.h"

namespace slipface {

class SceneView final : public ViewportServices {
  public:
    // The first image of a level of `draft_from` triangles or more is a draft.
    SceneView(GlTable gl, Editor& editor, std::size_t draft_from);
    ~SceneView() override;

    // Stores the request; draw() draws it.
    unsigned render(std::size_t pane, const Camera& camera, const Overlay& overlay, int width,
                    int height) override;
    unsigned still(int slot, const Image& image, std::uint64_t revision) override;

    void begin_frame();
    std::uint64_t wanted_hash() const;
    // Draws into the textures that render() returned; skips those that are up to date. A draft has one sample
    // per pixel, and the next call draws it in full.
    void draw();
    bool next_is_draft() const { return draft_; }

    const Warnings& texture_warnings() const { return texture_warnings_; }

  private:
    void upload();

    GlTable gl_;
    Editor& editor_;
    LevelRenderer level_;
    OverlayRenderer overlay_renderer_;
    MeshPtr mesh_;                                 // uploaded
    std::shared_ptr<const PlacedGeometry> props_;  // likewise, beside mesh_
    std::optional<LevelLight> light_;
    std::uint64_t face_revision_ = 0, highlights_hash_ = 0, texture_revision_ = 0;
    FaceHighlights highlights_;
    std::vector<Animation> animations_;  // of props_
    std::optional<double> moved_;        // the time of the platforms' positions; nothing: nothing moves
    std::uint64_t uploads_ = 0;          // grows whenever the GPU's copy changed
    std::size_t draft_from_;
    bool draft_ = false;  // the next images are drafts
    Warnings texture_warnings_;

    struct Picture {
        std::unique_ptr<Framebuffer> target;
        Camera camera;
        LevelStyle style;
        Overlay overlay;
        bool wanted = false;
        std::uint64_t wanted_hash = 0, drawn_hash = 0;
    };
    std::array<Picture, Panes::maximum> images_;

    struct Still {
        unsigned texture = 0;
        std::uint64_t revision = 0;
    };
    std::array<Still, 4> stills_;  // [slot]
};

}  // namespace slipface

// The props of a level on the graphics card: each mesh with its texture once, and where it is drawn.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "level_geometry.h"
#include "level_programs.h"
#include "slipface/level/level.h"
#include "slipface/render/level_renderer.h"

namespace slipface {

class LevelProps {
  public:
    LevelProps(GlTable gl, std::shared_ptr<LevelPrograms> programs);
    ~LevelProps();

    // As the functions of LevelRenderer.
    void set(const Level& level, const PropSurfaces& types, Warnings& warnings);
    void highlight(const std::map<std::uint32_t, std::vector<std::uint8_t>>& highlights);
    void move(const std::map<std::uint32_t, Pose>& poses);
    void animate(double time_s) { time_s_ = time_s; }

    // Relative to `origin`, with depth test. Props outside the picture are left out. `surface_table`: the
    // texture of the types.
    void draw_faces(const Camera& camera, int width, int height, const Mat4f& clip, const LevelStyle& style,
                    const Vec3& origin, double extent_around, unsigned surface_table);
    // Borders of all props, if they are not too many; outlines of the first props with the highlight `bit`.
    void add_borders(const Vec3& origin, const std::uint8_t (&color)[4], float width,
                     std::vector<LineInstance>& lines) const;
    void add_outlines(std::uint8_t bit, const Vec3& origin, const std::uint8_t (&color)[4], float width,
                      std::vector<LineInstance>& lines) const;

  private:
    struct Shown;  // a mesh with a texture
    struct Placed;

    Shown* upload(const Level& level, const Prop& prop, Warnings& warnings);
    void send_states();
    Mesh mesh_of(const Placed& prop) const;

    GlTable gl_;
    std::shared_ptr<LevelPrograms> programs_;
    std::vector<std::unique_ptr<Shown>> shown_;
    std::vector<Placed> props_;  // [prop]
    PropSurfaces types_;         // [prop]
    double time_s_ = 0.0;
    std::map<std::uint32_t, std::vector<std::uint8_t>> highlights_;
};

}  // namespace slipface

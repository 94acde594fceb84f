// Lines, points, ellipsoids and arrows drawn over a level: probes, ghosts, contacts, gizmos.
#pragma once

#include <memory>
#include <vector>

#include "slipface/base/types.h"
#include "slipface/render/gl_context.h"
#include "slipface/view/camera.h"

namespace slipface {

struct Color {
    float red = 1, green = 1, blue = 1, alpha = 1;  // sRGB, 0..1
};

// A list of shapes to draw, in world space; cheap to rebuild every frame.
class Overlay {
  public:
    struct Line {
        Vec3 a, b;
        Color color;
        float width;         // pixels
        bool on_top;         // true: drawn over the level; false: parts behind the level are faint
        bool arrow = false;  // a head at b, sized by the width
    };
    struct Ellipsoid {
        Vec3 centre, radii;
        Color fill;     // alpha 0: no fill
        Color outline;  // silhouette and, fainter, three great circles; alpha 0: none
    };
    struct Triangle {
        Vec3 a, b, c;
        Color color;
    };

    void line(const Vec3& a, const Vec3& b, Color color, float width = 2.0f, bool on_top = false);
    void arrow(const Vec3& from, const Vec3& to, Color color, float width = 2.0f,
               bool on_top = true);                                                // head at `to`
    void cross(const Vec3& centre, double size, Color color, float width = 2.0f);  // point marker
    void ellipsoid(const Vec3& centre, const Vec3& radii, Color fill, Color outline);
    void disc(const Vec3& centre, const Vec3& normal, double radius, Color fill,
              Color outline);  // contact plane
    void triangle(const Vec3& a, const Vec3& b, const Vec3& c, Color color);

    std::vector<Line> lines;
    std::vector<Ellipsoid> ellipsoids;
    std::vector<Triangle> triangles;
};

class OverlayRenderer {
  public:
    explicit OverlayRenderer(GlTable gl);
    ~OverlayRenderer();
    OverlayRenderer(const OverlayRenderer&) = delete;
    OverlayRenderer& operator=(const OverlayRenderer&) = delete;

    // Error: the driver refused a shader, and nothing is drawn.
    Status status() const;

    // Draws into the bound framebuffer, whose depth buffer holds the level. `width` and `height` are its size
    // in pixels. Shapes that are not finite are left out.
    void draw(const Overlay& overlay, const Camera& camera, int width, int height);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace slipface

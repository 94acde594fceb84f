// Building blocks. Everything faces outward from the solid that it describes, or towards the space that it
// encloses.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model.h"

namespace slipface::generate {

// Sides of a box, to leave out what nobody sees.
enum Side : unsigned {
    side_east = 1,  // +x
    side_west = 2,
    side_top = 4,
    side_bottom = 8,
    side_south = 16,  // +z
    side_north = 32,
    side_walls = side_east | side_west | side_south | side_north,
    side_all = side_walls | side_top | side_bottom,
    side_standing = side_all & ~unsigned{side_bottom},
};

void box(Model& model, const std::string& material, const Vec3& low, const Vec3& high,
         unsigned sides = side_all);

// Names the material of the cell around a point, or is empty for a hole.
using CellMaterial = std::function<std::string(double x, double z)>;

// Horizontal cells between the given coordinates; ascending lists. Faces up, or down.
void grid_floor(Model& model, const std::vector<double>& xs, const std::vector<double>& zs, double y,
                const CellMaterial& material, bool faces_up = true);

// A rectangle standing on the line from `from` to `to` (seen from the front: left to right), up to `top`.
void wall(Model& model, const std::string& material, const Vec3& from, const Vec3& to, double top);

// A plan polygon (x, z; counter-clockwise seen from above) raised from y0 to y1.
void prism(Model& model, const std::string& material, const std::vector<Vec2>& plan, double y0, double y1,
           const std::string& top_material, bool bottom = false);

// A regular polygon, flat, facing up; the texture covers it once.
void disc(Model& model, const std::string& material, const Vec3& centre, double radius, int sides,
          double first_deg = 0);

// A profile of (radius, y) points turned about the vertical through `centre`, from bottom to top. A radius of
// zero closes it at a point; a last radius above zero is closed by a cap of `cap_material`, or left open if
// that is empty.
void lathe(Model& model, const std::string& material, const Vec3& centre, const std::vector<Vec2>& profile,
           int sides, double first_deg = 0, const std::string& cap_material = {});

// Solid stairs from the floor y0: `count` steps in direction `ahead` (horizontal, unit), the first riser on
// the line from `left` along `across` (horizontal, unit) for `width`.
struct StairShape {
    Vec3 left = Vec3::Zero();  // lower left end of the first riser, seen by who climbs
    Vec3 ahead = -Vec3::UnitZ();
    double width = 2.0;
    int count = 8;
    double rise = 0.25;
    double tread = 0.35;
    double landing = 0.0;  // metres added to the last tread
    bool left_side = true, right_side = true, back = true;
};
void stairs(Model& model, const std::string& tread_material, const std::string& side_material,
            const StairShape& shape);

// A solid ramp in the same terms: `run` metres ahead it has risen by `height`, then `landing` metres of flat.
struct RampShape {
    Vec3 left = Vec3::Zero();
    Vec3 ahead = -Vec3::UnitZ();
    double width = 2.0;
    double run = 4.0;
    double height = 1.0;
    double landing = 0.0;
    bool left_side = true, right_side = true, back = true;
};
void ramp(Model& model, const std::string& top_material, const std::string& side_material,
          const RampShape& shape);

// A wall from y0 to y1 on the line from `from` to `to` (left to right seen from the front) with one arched
// opening in its middle: straight jambs from `sill` to `spring`, then half an ellipse of height `rise`. With
// sill == y0 it is a doorway.
struct ArchShape {
    Vec3 from = Vec3::Zero();
    Vec3 to = Vec3::UnitX();
    double y0 = 0, y1 = 4;
    double half_width = 1;
    double sill = 0, spring = 2, rise = 1;
    int segments = 10;
};
void arch_wall(Model& model, const std::string& material, const ArchShape& shape);

// The inner side of that opening, `depth` metres from the front away; with `jambs` the straight parts and the
// sill too.
void arch_reveal(Model& model, const std::string& material, const ArchShape& shape, double depth, bool jambs);

// What closes the opening, `depth` metres behind the front.
void arch_panel(Model& model, const std::string& material, const ArchShape& shape, double depth);

// A raised or sunken panel: the quad's rim, the sides and the inner quad; positive depth goes away from the
// front. The inner quad shows its texture once.
void coffer(Model& model, const std::string& rim_material, const std::string& inner_material,
            const std::array<Vec3, 4>& quad, double rim, double depth);

}  // namespace slipface::generate

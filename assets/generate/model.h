// A level under construction: polygons with materials, in metres, ready to be written as an OBJ.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "slipface/base/types.h"

namespace slipface::generate {

struct Corner {
    Vec3 position = Vec3::Zero();
    Vec2 uv = Vec2::Zero();
};

// How often a material's texture repeats.
struct ModelMaterial {
    std::string name;
    std::string texture;  // file name in textures/, without ".png"
    double metres_per_tile = 2.0;
};

struct ModelFace {
    std::size_t material = 0;
    std::size_t group = 0;
    std::vector<std::size_t> vertices;  // counter-clockwise seen from the front
    std::vector<std::size_t> uvs;
};

// Positions and texture coordinates are kept in units of 1e-4, so that equal corners are one vertex and the
// text written from them is the same with every compiler.
class Model {
  public:
    explicit Model(std::vector<ModelMaterial> materials);

    void begin_group(std::string name);

    // While on, everything added is reflected to the other side of the plane x = 0, still facing outward.
    void mirror_x(bool on) { mirror_ = on; }

    // A polygon; texture coordinates follow the world, so that neighbours in one plane match.
    void face(const std::string& material, std::vector<Vec3> corners);
    void face_uv(const std::string& material, std::vector<Corner> corners);

    // Inserts into every face the vertices of other faces that lie exactly on its edges.
    void join_edges();

    using Grid3 = std::array<std::int64_t, 3>;
    using Grid2 = std::array<std::int64_t, 2>;
    const std::vector<Grid3>& positions() const { return positions_; }
    const std::vector<Grid2>& uvs() const { return uvs_; }
    const std::vector<ModelFace>& faces() const { return faces_; }
    const std::vector<ModelMaterial>& materials() const { return materials_; }
    const std::vector<std::string>& groups() const { return groups_; }

  private:
    std::size_t add_position(const Vec3& position);
    std::size_t add_uv(const Vec2& uv);

    std::vector<ModelMaterial> materials_;
    std::map<std::string, std::size_t> material_index_;
    std::vector<std::string> groups_;
    std::vector<Grid3> positions_;
    std::vector<Grid2> uvs_;
    std::map<Grid3, std::size_t> position_index_;
    std::map<Grid2, std::size_t> uv_index_;
    std::vector<ModelFace> faces_;
    bool mirror_ = false;
};

inline constexpr double grid_per_unit = 1e4;

// Cosine and sine of an angle in degrees, rounded to 1e-12 so that the last bit of a libm does not matter.
double cos_deg(double degrees);
double sin_deg(double degrees);
double tan_deg(double degrees);

}  // namespace slipface::generate

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "slipface/mesh/build.h"

namespace slipface {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Face = std::vector<Vec3f>;

PolygonSoup soup_of(const std::vector<Face>& faces) {
    PolygonSoup soup;
    soup.face_first_corner.push_back(0);
    for (const Face& face : faces) {
        soup.corner_position.insert(soup.corner_position.end(), face.begin(), face.end());
        soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
    }
    return soup;
}

MeshPtr mesh_of(const std::vector<Face>& faces) {
    auto mesh = build_mesh(soup_of(faces));
    EXPECT_TRUE(mesh) << mesh.error().text();
    return *mesh;
}

std::vector<FaceId> list(std::span<const FaceId> faces) {
    return {faces.begin(), faces.end()};
}

// Cells of `size` m in the x-z plane seen from above, `columns` a row.
std::vector<Face> grid(int columns, int rows) {
    std::vector<Face> faces;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const auto x = static_cast<float>(column);
            const auto z = static_cast<float>(row);
            faces.push_back({{x, 0, z}, {x, 0, z + 1}, {x + 1, 0, z + 1}, {x + 1, 0, z}});
        }
    }
    return faces;
}

TEST(Geometry, OfASquareSeenFromAbove) {
    const MeshPtr mesh = mesh_of({{{0, 1, 0}, {0, 1, 2}, {2, 1, 2}, {2, 1, 0}}});
    EXPECT_EQ(face_normal(*mesh, 0), Vec3(0, 1, 0));
    EXPECT_EQ(face_centroid(*mesh, 0), Vec3(1, 1, 1));
    EXPECT_EQ(face_area(*mesh, 0), 4.0);
}

// An L of three unit squares.
TEST(Geometry, OfAConcaveFace) {
    const MeshPtr mesh = mesh_of({{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}});
    EXPECT_EQ(face_normal(*mesh, 0), Vec3(0, 0, 1));
    EXPECT_EQ(face_area(*mesh, 0), 3.0);
}

// The unit triangle with legs 3 and 4 has area 6, tilted by 30 degrees or not.
TEST(Geometry, OfATiltedTriangle) {
    const auto c = static_cast<float>(std::cos(0.5235987755982988));
    const auto s = static_cast<float>(std::sin(0.5235987755982988));
    const MeshPtr mesh = mesh_of({{{0, 0, 0}, {0, 0, 4}, {3 * c, 3 * s, 0}}});
    EXPECT_NEAR(face_area(*mesh, 0), 6.0, 1e-6);
    EXPECT_TRUE(face_normal(*mesh, 0).isApprox(Vec3(-0.5, std::sqrt(0.75), 0), 1e-6));
    EXPECT_NEAR(face_normal(*mesh, 0).norm(), 1.0, 1e-15);
}

TEST(Geometry, OfFacesWithoutArea) {
    const MeshPtr mesh = mesh_of(
        {{{0.1F, 0.1F, 0.1F}, {0.2F, 0.2F, 0.2F}, {0.4F, 0.4F, 0.4F}}, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}});
    for (FaceId face = 0; face < 2; ++face) {
        EXPECT_EQ(face_normal(*mesh, face), Vec3(0, 0, 0));
        EXPECT_EQ(face_area(*mesh, face), 0.0);
    }
    EXPECT_EQ(face_centroid(*mesh, 1), Vec3(1, 1, 1));
}

TEST(Geometry, TinyAndFarFacesHaveNormals) {
    const MeshPtr mesh = mesh_of({{{0, 0, 0}, {0, 0, 1e-38F}, {1e-38F, 0, 0}},
                                  {{8388608, 0, 8388608}, {8388608, 0, 8388609}, {8388609, 0, 8388608}}});
    EXPECT_EQ(face_normal(*mesh, 0), Vec3(0, 1, 0));
    EXPECT_EQ(face_normal(*mesh, 1), Vec3(0, 1, 0));
    EXPECT_EQ(face_area(*mesh, 1), 0.5);
}

TEST(Neighbours, OfAGrid) {
    const MeshPtr mesh = mesh_of(grid(3, 3));
    EXPECT_EQ(mesh->positions.size(), 16U);
    const FaceNeighbours neighbours = face_neighbours(*mesh);
    EXPECT_THAT(list(neighbours.of(0)), ElementsAre(1, 3));
    EXPECT_THAT(list(neighbours.of(4)), ElementsAre(1, 3, 5, 7));
    EXPECT_THAT(list(neighbours.of(8)), ElementsAre(5, 7));
}

TEST(Neighbours, TouchingInAPointIsNotEnough) {
    const MeshPtr mesh = mesh_of({{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, -1}, {-1, 0, 0}}});
    EXPECT_THAT(list(face_neighbours(*mesh).of(0)), IsEmpty());
}

TEST(Neighbours, EitherDirectionAndTwoCommonEdgesOnce) {
    // The second face runs the same way round and shares two edges with the first.
    const MeshPtr mesh =
        mesh_of({{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, -1}}});
    EXPECT_THAT(list(face_neighbours(*mesh).of(0)), ElementsAre(1));
    EXPECT_THAT(list(face_neighbours(*mesh).of(1)), ElementsAre(0));
}

// A mesh whose faces do not share vertices, as other tools may build one.
TEST(Neighbours, EqualPositionsConnect) {
    Mesh mesh = *mesh_of(grid(2, 1));
    for (std::uint32_t corner = 0; corner < 8; ++corner)
        mesh.corner_vertex[corner] = corner;
    std::vector<Vec3f> own;
    const MeshPtr original = mesh_of(grid(2, 1));
    for (std::uint32_t corner = 0; corner < 8; ++corner)
        own.push_back(original->corner_position(corner));
    mesh.positions = own;
    EXPECT_THAT(list(face_neighbours(mesh).of(0)), ElementsAre(1));
}

TEST(Neighbours, AnEdgeOfManyFacesStaysLinear) {
    constexpr int count = 20'000;
    std::vector<Face> faces;
    for (int i = 0; i < count; ++i)
        faces.push_back({{0, 0, 0}, {0, 1, 0}, {1, static_cast<float>(i), 0}});
    const MeshPtr mesh = mesh_of(faces);
    const FaceNeighbours neighbours = face_neighbours(*mesh);
    EXPECT_EQ(neighbours.of(0).size(), max_linked_faces);
    EXPECT_EQ(neighbours.of(count / 2).size(), 2 * max_linked_faces);
    for (FaceId face = 0; face + 1 < count; ++face) {
        ASSERT_TRUE(std::ranges::binary_search(neighbours.of(face), face + 1)) << "all hang together";
    }
}

TEST(BuildMesh, FillsWhatIsLeftOut) {
    const MeshPtr mesh = mesh_of(grid(2, 2));
    EXPECT_EQ(mesh->face_count(), 4U);
    EXPECT_EQ(mesh->triangle_count(), 8U);
    EXPECT_EQ(mesh->materials.size(), 1U);
    EXPECT_EQ(mesh->groups.size(), 1U);
    EXPECT_EQ(mesh->corner_uv.size(), 16U);
    EXPECT_EQ(mesh->bounds.max, Vec3(2, 0, 2));
}

TEST(BuildMesh, RefusesWhatDoesNotFit) {
    const auto refused = [](PolygonSoup soup, const char* message) {
        const auto mesh = build_mesh(std::move(soup));
        ASSERT_FALSE(mesh) << message;
        EXPECT_THAT(mesh.error().message, HasSubstr(message));
    };
    refused({}, "no faces");
    PolygonSoup soup = soup_of(grid(1, 1));
    soup.face_first_corner = {0, 3};
    refused(soup, "do not match");
    soup.face_first_corner = {0, 2, 4};
    refused(soup, "fewer than three");
    soup.face_first_corner = {0, 5, 4};
    refused(soup, "fewer than three");
    soup = soup_of(grid(1, 1));
    soup.corner_uv.resize(3);
    refused(soup, "differ in length");
    soup = soup_of(grid(1, 1));
    soup.face_material = {1};
    refused(soup, "material 1 of 1");
    soup = soup_of(grid(1, 1));
    soup.face_group = {7};
    refused(soup, "group 7 of 1");
    soup = soup_of(grid(1, 1));
    soup.corner_position[2].y() = std::nanf("");
    refused(soup, "corner 2 is not finite");
}

TEST(BuildMesh, TheFingerprintSeesGeometryFacesAndMaterials) {
    const PolygonSoup plain = soup_of(grid(2, 1));
    const auto fingerprint = [](PolygonSoup soup) { return (*build_mesh(std::move(soup)))->fingerprint; };
    PolygonSoup moved = plain;
    moved.corner_position[0].y() = 1e-30F;
    PolygonSoup turned = plain;
    std::swap(turned.corner_position[0], turned.corner_position[1]);
    PolygonSoup named = plain;
    named.materials.resize(1);
    named.materials[0].name = "ice";
    PolygonSoup merged = plain;
    merged.face_first_corner = {0, 8};
    PolygonSoup recolored = plain;
    recolored.materials.resize(1);
    recolored.materials[0].diffuse = Vec3f(1, 0, 0);
    recolored.groups = {"group"};
    recolored.corner_uv.assign(8, Vec2f(0.5F, 0.5F));
    const std::uint64_t original = fingerprint(plain);
    for (const PolygonSoup& other : {moved, turned, named, merged})
        EXPECT_NE(fingerprint(other), original);
    EXPECT_EQ(fingerprint(plain), original);
    EXPECT_EQ(fingerprint(recolored), original);
}

}  // namespace
}  // namespace slipface

// Quake 3 maps, made here byte by byte.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "mesh/bsp_maker.h"
#include "mesh/mesh_test_tools.h"
#include "slipface/mesh/import.h"

namespace slipface {
namespace {

using bsp_maker::Box;
using bsp_maker::face;
using bsp_maker::Map;
using bsp_maker::u32;
using testing::HasSubstr;

constexpr std::uint32_t solid = 1, playerclip = 0x10000, sky = 0x4, nodraw = 0x80;
constexpr double pi = 3.141592653589793;

// A pentagon, a triangle, and a quarter of a tube.
Map small_map() {
    Map map;
    map.add_texture("textures/base/floor", 0, solid);
    map.add_texture("textures/base/tube", 0, solid);
    map.add_polygon({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}}, 0);
    for (int y = 0; y < 3; ++y)
        map.vertices += bsp_maker::vertex({0, double(y), 5}) + bsp_maker::vertex({1, double(y), 5}) +
                        bsp_maker::vertex({1, double(y), 6});
    const auto first = static_cast<std::uint32_t>(map.indices.size() / 4);
    map.indices += u32(0) + u32(1) + u32(3);
    map.faces += face(0, 3, 0, 5, first, 3) + face(1, 2, 5, 9, 0, 0, 3, 3) + face(0, 4, 0, 0);
    return map;
}

class ImportBsp : public ScratchFolder {
  protected:
    // In the map's own coordinates by default.
    Result<ImportedMesh> import_map(const std::string& bytes,
                                    const ImportTransform& how = {.scale = 1.0, .up = UpAxis::y}) const {
        write("map.bsp", bytes);
        ImportOptions options;
        options.transform = how;
        return import_mesh(folder / "map.bsp", options);
    }
    std::string error_of(const std::string& bytes) const {
        const auto imported = import_map(bytes);
        return imported ? "read" : imported.error().text();
    }
    std::string error_of(const Map& map) const { return error_of(map.bytes()); }
};

// Distance along the ray of the first triangle whose front it meets; infinite for none.
double first_front(const Mesh& mesh, const Vec3& from, const Vec3& direction) {
    double first = std::numeric_limits<double>::infinity();
    for (const auto& triangle : mesh.triangles) {
        const Vec3 a = mesh.corner_position(triangle[0]).cast<double>();
        const Vec3 u = mesh.corner_position(triangle[1]).cast<double>() - a;
        const Vec3 v = mesh.corner_position(triangle[2]).cast<double>() - a;
        const Vec3 p = direction.cross(v), to = from - a, q = to.cross(u);
        const double det = u.dot(p);
        if (!(det > 1e-12)) continue;  // the back, or along it
        const double s = to.dot(p) / det, t = direction.dot(q) / det, at = v.dot(q) / det;
        if (s >= -1e-6 && t >= -1e-6 && s + t <= 1 + 1e-6 && at > 0) first = std::min(first, at);
    }
    return first;
}

// Distance at which the ray enters the box; infinite where it does not.
double enter(const Box& box, const Vec3& from, const Vec3& direction) {
    double begin = 0, end = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.min[axis] - from[axis]) / direction[axis];
        const double b = (box.max[axis] - from[axis]) / direction[axis];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return begin < end ? begin : std::numeric_limits<double>::infinity();
}

double area_of_all(const Mesh& mesh) {
    double area = 0;
    for (FaceId i = 0; i < mesh.face_count(); ++i)
        area += face_area(mesh, i);
    return area;
}

TEST_F(ImportBsp, PolygonsMeshesAndPatchesBecomeFaces) {
    const auto imported = import_map(small_map().bytes());
    ASSERT_TRUE(imported) << imported.error().text();
    const Mesh& mesh = *imported->mesh;
    ASSERT_EQ(mesh.face_count(), 2u + 16u);
    EXPECT_EQ(mesh.face_corner_count(0), 5u);
    EXPECT_EQ(mesh.face_corner_count(1), 3u);
    EXPECT_EQ(mesh.materials[mesh.face_material[0]].name, "textures/base/floor");
    EXPECT_EQ(mesh.materials[mesh.face_material[2]].name, "textures/base/tube");
    EXPECT_NEAR(face_area(mesh, 0), 5.0, 1e-6);
    EXPECT_LT(face_normal(mesh, 0).z(), -0.99) << "counter-clockwise in the file, so turned round here";
    // The middle of the curve: a quarter of each end and half of the control point.
    double nearest = 1;
    for (const Vec3f& p : mesh.positions)
        nearest = std::min(nearest, (p.cast<double>() - Vec3(0.75, 1, 5.25)).norm());
    EXPECT_LT(nearest, 1e-6);
    ASSERT_EQ(imported->warnings.size(), 1u);
    EXPECT_THAT(imported->warnings[0].text(), HasSubstr("1 flares"));
}

TEST_F(ImportBsp, ArrivesUprightAndInMetres) {
    const auto imported = import_map(small_map().bytes(), {});
    ASSERT_TRUE(imported) << imported.error().text();
    EXPECT_TRUE(imported->summary.size.isApprox(Vec3(3, 6, 2) / 32.0));
    EXPECT_EQ(imported->summary.up, UpAxis::z);
    EXPECT_EQ(imported->summary.up_from, ImportSource::declared);
    EXPECT_EQ(imported->summary.scale, 1.0 / 32.0);
    EXPECT_EQ(imported->summary.scale_from, ImportSource::guessed);
    const auto scaled = import_map(small_map().bytes(), {.scale = 0.5, .up = {}});
    ASSERT_TRUE(scaled);
    EXPECT_TRUE(scaled->summary.size.isApprox(Vec3(3, 6, 2) / 2));
    EXPECT_EQ(scaled->summary.scale_from, ImportSource::given);
}

// Vertices in any order, triangles of any polygon: the indices alone say what is drawn.
TEST_F(ImportBsp, FlatFacesFollowTheirIndices) {
    std::mt19937 random(7);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int round = 0; round < 100; ++round) {
        Map map;
        map.add_texture("floor", 0, solid);
        const int corners = 3 + round % 9;
        std::vector<Vec3> outline;
        for (int i = 0; i < corners; ++i) {
            const double angle = (i + number(0.1, 0.9)) * 2 * pi / corners;
            outline.emplace_back(100 * std::cos(angle), 100 * std::sin(angle), 7);
        }
        std::vector<std::uint32_t> order(outline.size());
        for (std::uint32_t i = 0; i < order.size(); ++i)
            order[i] = i;
        std::shuffle(order.begin(), order.end(), random);
        std::vector<Vec3> shuffled(outline.size());
        for (std::size_t i = 0; i < order.size(); ++i)
            shuffled[order[i]] = outline[i];
        for (const Vec3& at : shuffled)
            map.vertices += bsp_maker::vertex(at);
        double area = 0;
        for (std::size_t i = 2; i < outline.size(); ++i) {
            map.indices += u32(order[0]) + u32(order[i - 1]) + u32(order[i]);
            area += 0.5 * (outline[i - 1] - outline[0]).cross(outline[i] - outline[0]).norm();
        }
        const auto count = static_cast<std::uint32_t>(outline.size());
        map.faces = face(0, 1, 0, count, 0, 3 * (count - 2));
        const auto imported = import_map(map.bytes());
        ASSERT_TRUE(imported) << imported.error().text();
        EXPECT_EQ(imported->mesh->face_count(), 1u) << "triangles of one outline are one polygon";
        EXPECT_NEAR(area_of_all(*imported->mesh), area, 1e-3 * area);
    }
}

TEST_F(ImportBsp, AFrameAroundAHoleStaysTriangles) {
    Map map;
    map.add_texture("floor", 0, solid);
    for (const double r : {1.0, 2.0})
        for (const auto& [x, y] : {std::pair(-r, -r), std::pair(r, -r), std::pair(r, r), std::pair(-r, r)})
            map.vertices += bsp_maker::vertex({x, y, 0});
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t next = (i + 1) % 4;
        map.indices += u32(4 + i) + u32(4 + next) + u32(i) + u32(next) + u32(i) + u32(4 + next);
    }
    map.faces = face(0, 1, 0, 8, 0, 24);
    const auto imported = import_map(map.bytes());
    ASSERT_TRUE(imported) << imported.error().text();
    EXPECT_EQ(imported->mesh->face_count(), 8u);
    EXPECT_NEAR(area_of_all(*imported->mesh), 16 - 4, 1e-6);
}

// Compilers leave the sky's surfaces in the map, and the game draws pictures of its own there.
TEST_F(ImportBsp, SkyThatTheMapListsIsUndrawn) {
    Map map;
    map.add_texture("textures/skies/space", sky, solid);
    map.add_texture("textures/base/floor", 0, solid);
    for (const std::uint32_t texture : {0U, 1U, 0U})
        map.add_polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, texture);
    const auto imported = import_map(map.bytes());
    ASSERT_TRUE(imported) << imported.error().text();
    EXPECT_THAT(imported->undrawn, testing::ElementsAre(0, 2));
}

// Of a sealed room nothing is drawn: what faces its inside is all there is.
TEST_F(ImportBsp, ASealedRoomOfCaulkIsClosedAndHasNoOutside) {
    Map map;
    const std::uint32_t caulk = map.add_texture("textures/common/caulk", nodraw, solid);
    const Box inside{{-50, -70, 0}, {150, 30, 90}};
    bsp_maker::add_shell(map, inside, 16, caulk);
    bsp_maker::add_room_tree(map, inside);
    map.add_world();
    const auto imported = import_map(map.bytes());
    ASSERT_TRUE(imported) << imported.error().text();
    EXPECT_EQ(imported->mesh->face_count(), 6u);
    EXPECT_EQ(imported->undrawn.size(), 6u);
    const Vec3 size = inside.max - inside.min;
    EXPECT_NEAR(area_of_all(*imported->mesh),
                2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x()), 1e-6);
    const Vec3 middle = (inside.min + inside.max) / 2;
    for (FaceId i = 0; i < 6; ++i)
        EXPECT_GT(face_normal(*imported->mesh, i).dot(middle - face_centroid(*imported->mesh, i)), 0)
            << "fronts look inside";
}

// Rooms of random boxes that overlap and touch, some drawn and some not: a ray from open space ends where it
// enters the first box, at a front.
TEST_F(ImportBsp, RandomRoomsAreTightWhereTheirBrushesAre) {
    std::mt19937 random(11);
    const auto whole = [&](int low, int high) {
        return static_cast<double>(std::uniform_int_distribution<int>(low, high)(random));
    };
    std::size_t rays = 0;
    for (int round = 0; round < 60; ++round) {
        Map map;
        const std::uint32_t caulk = map.add_texture("textures/common/caulk", nodraw, solid);
        const std::uint32_t clip = map.add_texture("textures/common/clip", nodraw, playerclip);
        const std::uint32_t stone = map.add_texture("textures/base/stone", 0, solid);
        const std::uint32_t water = map.add_texture("textures/liquids/water", 0, 0x20);
        const Box inside{{0, 0, 0}, {whole(10, 40) * 8, whole(10, 40) * 8, whole(6, 20) * 8}};
        bsp_maker::add_shell(map, inside, 16, caulk);
        std::vector<Box> boxes;
        for (int i = 0; i < 6; ++i) {
            boxes.push_back({inside.min - Vec3::Constant(16), inside.max + Vec3::Constant(16)});
            const int axis = i / 2;
            if (i % 2 != 0)
                boxes.back().min[axis] = inside.max[axis];
            else
                boxes.back().max[axis] = inside.min[axis];
        }
        for (int i = 0; i < 1 + round % 12; ++i) {
            Box box;
            for (int axis = 0; axis < 3; ++axis) {
                const double top = inside.max[axis] / 8;
                box.min[axis] = 8 * whole(-1, static_cast<int>(top) - 1);
                box.max[axis] = box.min[axis] + 8 * whole(1, static_cast<int>(top));
            }
            const int what = std::uniform_int_distribution<int>(0, 3)(random);
            map.add_box(box, what == 0 ? caulk : what == 1 ? clip : what == 2 ? stone : water);
            if (what != 3) boxes.push_back(box);
            if (what != 2) continue;
            // All six sides are drawn whole, clockwise seen from outside.
            for (int axis = 0; axis < 3; ++axis) {
                for (const bool high : {false, true}) {
                    std::vector<Vec3> corners;
                    for (const auto& [a, b] :
                         {std::pair(0, 0), std::pair(0, 1), std::pair(1, 1), std::pair(1, 0)}) {
                        Vec3 corner;
                        corner[axis] = (high ? box.max : box.min)[axis];
                        corner[(axis + 1) % 3] = (a != 0 ? box.max : box.min)[(axis + 1) % 3];
                        corner[(axis + 2) % 3] = (b != 0 ? box.max : box.min)[(axis + 2) % 3];
                        corners.push_back(corner);
                    }
                    if (!high) std::reverse(corners.begin(), corners.end());
                    map.add_polygon(corners, stone);
                }
            }
        }
        if (round % 2 != 0) bsp_maker::add_room_tree(map, inside);
        map.add_world();
        const auto imported = import_map(map.bytes());
        ASSERT_TRUE(imported) << imported.error().text();
        for (int i = 0; i < 200; ++i) {
            const auto between = [&](double low, double high) {
                return std::uniform_real_distribution<double>(low, high)(random);
            };
            const Vec3 from(between(0, inside.max.x()), between(0, inside.max.y()),
                            between(0, inside.max.z()));
            const Vec3 direction = Vec3(between(-1, 1), between(-1, 1), between(-1, 1)).normalized();
            double expected = std::numeric_limits<double>::infinity();
            bool within = false;
            for (const Box& box : boxes) {
                within = within || box.contains(from);
                expected = std::min(expected, enter(box, from, direction));
            }
            if (within) continue;
            ++rays;
            ASSERT_NEAR(first_front(*imported->mesh, from, direction), expected, 0.1)
                << "round " << round << " from " << from.transpose() << " along " << direction.transpose();
        }
    }
    EXPECT_GT(rays, 3000u);
}

TEST_F(ImportBsp, SpawnsStandWhereTheirEntitiesAre) {
    Map map = small_map();
    map.entities =
        "{\n\"classname\" \"worldspawn\"\n}\n"
        "{ \"classname\" \"info_player_intermission\" \"origin\" \"1 2 3\" }\n"
        "{ \"origin\" \"64 -32 88\" \"angle\" \"90\" \"classname\" \"info_player_deathmatch\" }\n"
        "{ \"classname\" \"info_player_start\" \"origin\" \"0 0 24\" }\n"
        "{ \"classname\" \"info_player_deathmatch\" \"origin\" \"nan 0 1e99\" }\n";
    const auto imported = import_map(map.bytes(), {});
    ASSERT_TRUE(imported) << imported.error().text();
    ASSERT_EQ(imported->spawns.size(), 3u);
    EXPECT_EQ(imported->spawns[0].name, "info_player_deathmatch 1");
    EXPECT_TRUE(imported->spawns[0].feet.isApprox(Vec3(2, 2, 1)));
    EXPECT_NEAR(imported->spawns[0].yaw, 0.0, 1e-12) << "90 degrees look along +Y there, along -Z here";
    EXPECT_EQ(imported->spawns[1].name, "info_player_start 1");
    EXPECT_NEAR(imported->spawns[1].yaw, -pi / 2, 1e-12) << "0 degrees look along +X";
    EXPECT_TRUE(imported->spawns[2].feet.allFinite());
}

TEST_F(ImportBsp, MovingPartsStandAtTheirOriginAndTriggersStopNobody) {
    Map map;
    const std::uint32_t clip = map.add_texture("textures/common/clip", nodraw, playerclip);
    map.add_box({{0, 0, 0}, {8, 8, 8}}, clip);
    map.add_world();
    map.add_box({{0, 0, 0}, {4, 4, 4}}, clip);
    map.add_box({{0, 0, 0}, {2, 2, 2}}, clip);
    for (std::uint32_t i = 1; i < 3; ++i)
        map.models += std::string(24, '\0') + u32(0) + u32(0) + u32(i) + u32(1);
    map.entities =
        "{ \"classname\" \"func_door\" \"model\" \"*1\" \"origin\" \"100 0 0\" }"
        "{ \"classname\" \"trigger_push\" \"model\" \"*2\" \"origin\" \"200 0 0\" }"
        "{ \"classname\" \"func_door\" \"model\" \"*99999999999999999999\" }";
    const auto imported = import_map(map.bytes());
    ASSERT_TRUE(imported) << imported.error().text();
    EXPECT_EQ(imported->mesh->face_count(), 12u);
    EXPECT_EQ(imported->mesh->bounds.max.x(), 104.0);
}

TEST_F(ImportBsp, FlagsOfTexturesAreTypes) {
    Map map = small_map();
    map.add_texture("ice_floor", 0x2, solid);
    map.add_texture("pool", 0, 0x20);
    const auto imported = import_map(map.bytes());
    ASSERT_TRUE(imported) << imported.error().text();
    EXPECT_THAT(imported->types,
                testing::ElementsAre(FoundType{"ice_floor", "ice"}, FoundType{"pool", "nonsolid"}));
}

TEST_F(ImportBsp, WhatDoesNotFitIsRefused) {
    const std::string good = small_map().bytes();
    for (std::size_t size = 0; size < good.size(); size += 7)
        EXPECT_FALSE(import_map(good.substr(0, size))) << size;
    Map map = small_map();
    map.faces = face(2, 1, 0, 5);
    EXPECT_THAT(error_of(map), HasSubstr("face 0 refers to a missing texture"));
    map.faces = face(0, 1, 0xFFFFFFFF, 5);
    EXPECT_THAT(error_of(map), HasSubstr("face 0 refers to a missing texture"));
    map.faces = face(0, 1, 12, 0xFFFFFFFF);
    EXPECT_THAT(error_of(map), HasSubstr("face 0 refers to a missing texture"));
    map.faces = face(0, 3, 0, 2, 0, 3);
    EXPECT_THAT(error_of(map), HasSubstr("of 2 vertices"));
    map.faces = face(0, 2, 0, 9, 0, 0, 3, 4);
    EXPECT_THAT(error_of(map), HasSubstr("patch of 3 x 4"));
    map.faces = face(0, 2, 0, 9, 0, 0, 0x80000001, 0x80000001);
    EXPECT_THAT(error_of(map), HasSubstr("patch of"));
    map.faces = face(0, 4, 0, 0);
    EXPECT_THAT(error_of(map), HasSubstr("has no faces"));
    map = small_map();
    map.vertices.replace(0, 4, u32(0x7FC00000));
    EXPECT_THAT(error_of(map), HasSubstr("not within"));
}

TEST_F(ImportBsp, AnotherGamesMapIsRefusedByItsVersion) {
    std::string map = small_map().bytes();
    map[4] = 78;
    EXPECT_THAT(error_of(map), HasSubstr("found IBSP of version 78, expected IBSP of version 46"));
    map[0] = 'V';
    EXPECT_THAT(error_of(map), HasSubstr("found VBSP of version 78"));
    EXPECT_THAT(error_of("no map at all" + map), HasSubstr("found another kind of file"));
    EXPECT_THAT(error_of("IBS"), HasSubstr("found 3 bytes"));
}

// Maps of real games have up to 20,000 brushes.
TEST_F(ImportBsp, ThousandsOfBrushesBesideEachOtherAreRead) {
    Map map;
    const std::uint32_t caulk = map.add_texture("caulk", nodraw, solid);
    for (int y = 0; y < 120; ++y)
        for (int z = 0; z < 100; ++z)
            map.add_box({Vec3(-500, 50 * y, 50 * z), Vec3(500, 50 * y + 30, 50 * z + 30)}, caulk);
    map.add_world();
    const auto mesh = import_map(map.bytes());
    ASSERT_TRUE(mesh) << mesh.error().text();
    EXPECT_EQ(mesh->mesh->face_count(), 6u * 12000u);
}

// Thousands of brushes in one place: refused in bounded time, not worked on for hours.
TEST_F(ImportBsp, BrushesThatOverlapWithoutEndAreRefused) {
    Map map;
    const std::uint32_t caulk = map.add_texture("caulk", nodraw, solid);
    for (int i = 0; i < 8000; ++i)
        map.add_box({Vec3::Constant(-100 - i * 0.01), Vec3::Constant(100 + (i % 97) * 0.5)}, caulk);
    map.add_world();
    EXPECT_THAT(error_of(map), HasSubstr("too many overlapping brushes"));
}

// Faces that share their indices again and again: small on disk only.
TEST_F(ImportBsp, FacesThatShareTheirCornersWithoutEndAreRefused) {
    for (const std::uint32_t kind : {1U, 3U}) {
        Map map;
        map.add_texture("floor", 0, solid);
        for (int i = 0; i < 9; ++i)
            map.vertices += bsp_maker::vertex({double(i % 3), double(i / 3), 0});
        for (int i = 0; i < 3000; ++i)
            map.indices += u32(0) + u32(1) + u32(3);
        for (int i = 0; i < 3000; ++i)
            map.faces += face(0, kind, 0, 9, 0, 9000);
        EXPECT_THAT(error_of(map), HasSubstr("has too many faces: more than"));
    }
    Map map;  // a list of indices that many faces have in common is what compilers write
    map.add_texture("floor", 0, solid);
    map.indices = u32(0) + u32(1) + u32(2) + u32(0) + u32(2) + u32(3);
    for (std::uint32_t i = 0; i < 500; ++i) {
        for (const Vec3& corner : {Vec3(0, 0, i), Vec3(1, 0, i), Vec3(1, 1, i), Vec3(0, 1, i)})
            map.vertices += bsp_maker::vertex(corner);
        map.faces += face(0, 1, 4 * i, 4, 0, 6);
    }
    const auto mesh = import_map(map.bytes());
    ASSERT_TRUE(mesh) << mesh.error().text();
    EXPECT_EQ(mesh->mesh->face_count(), 500u);
}

TEST_F(ImportBsp, AnyByteMayBeWrong) {
    std::mt19937 random(23);
    Map map = small_map();
    const std::uint32_t caulk = map.add_texture("caulk", nodraw, solid);
    bsp_maker::add_shell(map, {{0, 0, 0}, {64, 64, 64}}, 8, caulk);
    bsp_maker::add_room_tree(map, {{0, 0, 0}, {64, 64, 64}});
    map.add_world();
    map.entities = "{ \"classname\" \"info_player_start\" \"origin\" \"0 0 24\" }";
    const std::string good = map.bytes();
    ASSERT_TRUE(import_map(good));
    std::size_t read = 0, refused = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string bytes = good;
        if (i % 4 == 0) bytes.resize(std::uniform_int_distribution<std::size_t>(0, good.size())(random));
        for (int k = 0; k < i % 5 && !bytes.empty(); ++k) {
            const std::size_t at = std::uniform_int_distribution<std::size_t>(0, bytes.size() - 1)(random);
            bytes[at] = static_cast<char>(std::uniform_int_distribution<int>(-128, 127)(random));
        }
        const auto imported = import_map(bytes);
        ++(imported ? read : refused);
        if (imported) {
            for (const Vec3f& p : imported->mesh->positions)
                ASSERT_TRUE(p.allFinite());
        } else {
            ASSERT_EQ(imported.error().location, (folder / "map.bsp").string());
        }
    }
    EXPECT_GT(read, 100u);
    EXPECT_GT(refused, 1000u);
}

}  // namespace
}  // namespace slipface

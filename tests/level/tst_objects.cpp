// Parts of objects that lie on, in or beside other objects: edits of all of them mix up no types.
#include "faces.h"

namespace slipface::test {
namespace {

// Flat bars of six objects in one plane, cut into faces of unequal lengths.
Faces crossing_bars(Random& random) {
    Faces bars;
    for (int object = 0; object < 6; ++object) {
        const bool along = object % 2 == 0;
        const auto wide = static_cast<float>(drawn(random, 0.1, 0.4));
        const auto at = static_cast<float>(object / 2) + static_cast<float>(drawn(random, 0, 0.4));
        auto high = static_cast<float>(drawn(random, 0, 0.4));
        for (int i = 0; i < 8; ++i) {
            const float low = high;
            high += static_cast<float>(drawn(random, 0.25, 0.55));
            const auto corner = [&](float a, float b) { return along ? Vec3f(a, 1, b) : Vec3f(b, 1, a); };
            bars.push_back(
                quad(corner(low, at), corner(low, at + wide), corner(high, at + wide), corner(high, at)));
            if (!along) std::reverse(bars.back().corners.begin(), bars.back().corners.end());
            bars.back().painted = drawn_type(random);
            bars.back().object = "bar" + std::to_string(object);
        }
    }
    return bars;
}

// Where bars of two objects cross, a piece lies on faces of both.
TEST(Objects, CutAndDeletedBarsKeepTheirOwnTypes) {
    std::size_t painted = 0, wrong = 0, listed = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Faces before = crossing_bars(random);
        Faces after;
        for (const Face& face : before) {
            if (random() % 6 == 0) continue;
            const std::vector<Vec3f>& c = face.corners;
            after.push_back({{c[0], c[1], c[2]}, face.material, face.painted, face.object});
            after.push_back({{c[2], c[3], c[0]}, face.material, face.painted, face.object});
        }
        const LoadedLevel loaded = rematch(before, after);
        painted += painted_count(after);
        for (const std::size_t face : wrong_faces(after, loaded))
            ++(loaded.level.overrides[face] ? wrong : listed);
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_LE(100 * listed, painted);
}

// A face of a few millimetres that is extruded by half a metre.
TEST(Objects, FacesExtrudedFarAreFound) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        Faces before = random_polygons(60, 200.0f, seed);
        Faces after = before;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const std::vector<Vec3f>& corners = before[i].corners;
            const Vec3f across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            const auto length = static_cast<float>(drawn(random, 3, 12)) * (corners[1] - corners[0]).norm();
            if (before[i].painted >= 0) extrude(after, i, length * across.normalized());
        }
        const LoadedLevel loaded = rematch(before, after);
        EXPECT_TRUE(wrong_faces(after, loaded).empty()) << seed << ": " << loaded.match.text();
    }
}

TEST(Objects, TheBottomOfAPitIsNotItsLostLid) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        Faces before = tiles(5);
        extrude(before, 12, Vec3f(0, -static_cast<float>(drawn(random, 3, 12)), 0));
        Faces after = before;
        before.push_back(tiles(5)[12]);
        before.back().painted = 1;
        const LoadedLevel loaded = rematch(before, after);
        EXPECT_TRUE(wrong_faces(after, loaded).empty()) << seed << ": " << loaded.match.text();
    }
}

// The corner of a box from `low`, `size` large.
Vec3f corner_of(const Vec3f& low, const Vec3f& size, int x, int y, int z) {
    return low + size.cwiseProduct(Vec3(x, y, z).cast<float>());
}

// A box with bevelled edges: each side `width` from its edges, with strips and corners between. Flat sides
// have the types in their order.
Faces bevelled_box(const Vec3f& low, const Vec3f& size, float width, const std::vector<int>& types) {
    Faces faces;
    // The corner of the side across `axis` that was at `corner`.
    const auto at = [&](int axis, const std::array<int, 3>& corner) {
        Vec3f position = corner_of(low, size, corner[0], corner[1], corner[2]);
        for (int other = 0; other < 3; ++other)
            if (other != axis)
                position[other] += (corner[static_cast<std::size_t>(other)] == 0 ? width : -width);
        return position;
    };
    const auto add = [&](Face face) {
        const Vec3f centre = low + 0.5f * size,
                    across = (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[0]);
        if (across.dot(face.corners[0] - centre) < 0) std::reverse(face.corners.begin(), face.corners.end());
        faces.push_back(std::move(face));
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        const auto corner = [&](int a, int b, int c) {
            std::array<int, 3> found{};
            found[axis] = a;
            found[u] = b;
            found[v] = c;
            return found;
        };
        const int number = static_cast<int>(axis);
        for (const int side : {0, 1}) {
            Face face = quad(at(number, corner(side, 0, 0)), at(number, corner(side, 1, 0)),
                             at(number, corner(side, 1, 1)), at(number, corner(side, 0, 1)));
            face.painted = types[2 * axis + static_cast<std::size_t>(side)];
            add(face);
        }
        // The edges along the axis.
        for (const int b : {0, 1})
            for (const int c : {0, 1})
                add(quad(at(static_cast<int>(u), corner(0, b, c)), at(static_cast<int>(u), corner(1, b, c)),
                         at(static_cast<int>(v), corner(1, b, c)), at(static_cast<int>(v), corner(0, b, c))));
    }
    for (int x : {0, 1})
        for (int y : {0, 1})
            for (int z : {0, 1})
                add({{at(0, {x, y, z}), at(1, {x, y, z}), at(2, {x, y, z})}});
    return faces;
}

std::vector<int> drawn_types(Random& random, int first, unsigned count) {
    std::vector<int> types;
    for (int side = 0; side < 6; ++side)
        types.push_back(first + static_cast<int>(random() % count));
    return types;
}

// All in one object: the pieces of a bevelled crate are no rest of the room around it, of whose walls little
// is in its plane any more.
TEST(Objects, BevelledCratesHaveNoTypesOfTheRoom) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        Faces before = bevelled_box(Vec3f(-9, -2, -9), Vec3f(18, 6, 18), 0.0f, drawn_types(random, 3, 2));
        std::erase_if(before, [](const Face& face) { return face.painted < 0; });
        for (Face& wall : before)
            std::reverse(wall.corners.begin(), wall.corners.end());
        Faces after = before;
        for (std::size_t wall = 0; wall < 6; ++wall) {
            std::vector<Vec3f>& corners = after[wall].corners;
            const Vec3f centre = 0.5f * (corners[0] + corners[2]);
            const Vec3f shift =
                Vec3(drawn(random, 0.05, 0.1), drawn(random, 0.05, 0.1), drawn(random, 0.05, 0.1))
                    .cast<float>();
            for (Vec3f& corner : corners)
                corner = wall < 3 ? Vec3f(corner + shift) : Vec3f(centre + 0.97f * (corner - centre));
        }
        const std::size_t walls = before.size();
        for (int crate = 0; crate < 4; ++crate) {
            const Vec3f low(-7.0f + 4.0f * static_cast<float>(crate), -2,
                            static_cast<float>(drawn(random, -7, 5)));
            const Vec3f size(static_cast<float>(drawn(random, 0.5, 1.5)),
                             static_cast<float>(drawn(random, 0.5, 1.5)),
                             static_cast<float>(drawn(random, 0.5, 1.5)));
            const std::vector<int> types = drawn_types(random, 0, 3);
            for (const Face& face : bevelled_box(low, size, 0.0f, types))
                if (face.painted >= 0) before.push_back(face);
            for (const Face& face :
                 bevelled_box(low, size, static_cast<float>(drawn(random, 0.05, 0.15)), types))
                after.push_back(face);
        }
        const LoadedLevel loaded = rematch(before, after);
        for (std::size_t face = walls; face < after.size(); ++face) {
            const auto& type = loaded.level.overrides.at(face);
            EXPECT_TRUE(!type || *type < 3) << seed << ", face " << face;
            EXPECT_TRUE(after[face].painted < 0 || type) << seed << ", face " << face;
        }
    }
}

// A bevel wider than a slab is thick turns its narrow sides over where they are; the wide ones did not turn.
TEST(Objects, ASlabOfWhichNarrowSidesTurnedOverWasNotTurned) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        const Vec3f size(static_cast<float>(drawn(random, 1, 2)),
                         static_cast<float>(drawn(random, 0.02, 0.05)),
                         static_cast<float>(drawn(random, 1, 2)));
        const std::vector<int> types = drawn_types(random, 0, 5);
        Faces before;
        for (const Face& face : bevelled_box(Vec3f::Zero(), size, 0.0f, types))
            if (face.painted >= 0 && before.size() < 5) before.push_back(face);
        Faces after = before;
        for (Face& face : after) {
            const Vec3f across = (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[0]);
            if (std::abs(across.y()) < 0.5f * across.norm()) {
                std::reverse(face.corners.begin(), face.corners.end());
                continue;
            }
            const Vec3f centre =
                0.25f * (face.corners[0] + face.corners[1] + face.corners[2] + face.corners[3]);
            for (Vec3f& corner : face.corners)
                corner = centre + 0.9f * (corner - centre);
        }
        const LoadedLevel loaded = rematch(before, after);
        for (std::size_t face = 2; face < 4; ++face) {
            const auto& type = loaded.level.overrides.at(face);
            EXPECT_TRUE(type && int{*type} == after[face].painted) << seed << ", face " << face;
        }
    }
}

// A box whose sides a bevel made smaller by `width` at each edge: those that are narrower than twice of it
// are turned over. The sides come last.
Faces widely_bevelled_box(const Vec3f& low, const Vec3f& size, float width, const std::vector<int>& types) {
    Faces faces = bevelled_box(low, size, width, types);
    std::erase_if(faces, [](const Face& face) { return face.painted >= 0; });
    for (Face face : bevelled_box(low, size, 0.0f, types)) {
        if (face.painted < 0) continue;
        const Vec3f across = (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[0]);
        for (Vec3f& corner : face.corners)
            for (int axis = 0; axis < 3; ++axis)
                if (std::abs(across[axis]) < 0.5f * across.norm())
                    corner[axis] += corner[axis] < low[axis] + 0.5f * size[axis] ? width : -width;
        faces.push_back(face);
    }
    return faces;
}

// Tiles, and boxes before and after a bevel. Returns how many sides have another type than theirs, and how
// many of those that are wider than the bevel have none.
std::pair<int, int> wrong_and_listed(Random& random, const std::vector<Vec3f>& sizes, float width) {
    Faces before = tiles(5);
    for (Face& tile : before)
        tile.painted = drawn_type(random);
    Faces after = before;
    for (std::size_t box = 0; box < sizes.size(); ++box) {
        const Vec3f low(10, 0, 3.0f * static_cast<float>(box));
        const std::vector<int> types = drawn_types(random, 0, 5);
        for (const Face& face : bevelled_box(low, sizes[box], 0.0f, types))
            if (face.painted >= 0) before.push_back(face);
        for (const Face& face : widely_bevelled_box(low, sizes[box], width, types))
            after.push_back(face);
    }
    const LoadedLevel loaded = rematch(before, after);
    int wrong = 0, listed = 0;
    for (std::size_t face = 0; face < after.size(); ++face) {
        const auto& type = loaded.level.overrides.at(face);
        if (after[face].painted < 0) continue;
        const Vec3f a = after[face].corners[1] - after[face].corners[0];
        const Vec3f b = after[face].corners[2] - after[face].corners[1];
        const bool is_wide = a.norm() > 2.1f * width && b.norm() > 2.1f * width;
        wrong += type && int{*type} != after[face].painted ? 1 : 0;
        listed += is_wide && !type ? 1 : 0;
    }
    return {wrong, listed};
}

// Boards of a few millimetres: their wide sides are there, and the narrow ones turned over in their places.
TEST(Objects, BoardsThinnerThanABevelAreWhereTheyWere) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        std::vector<Vec3f> boards;
        for (int board = 0; board < 4; ++board)
            boards.emplace_back(static_cast<float>(drawn(random, 0.4, 0.5)),
                                static_cast<float>(drawn(random, 0.005, 0.02)),
                                static_cast<float>(drawn(random, 0.4, 0.5)));
        EXPECT_EQ(wrong_and_listed(random, boards, 0.08f), std::pair(0, 0)) << seed;
    }
}

// A cabinet with many small painted parts, of which a bevel leaves spikes: it is where it was, because its
// large sides are.
TEST(Objects, ACabinetThatLostItsSmallFacesStays) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        const Vec3f size(static_cast<float>(drawn(random, 1, 2)), static_cast<float>(drawn(random, 1, 2)),
                         static_cast<float>(drawn(random, 1, 2)));
        const std::vector<int> types = drawn_types(random, 0, 5);
        Faces before;
        for (const Face& face : bevelled_box(Vec3f::Zero(), size, 0.0f, types))
            if (face.painted >= 0) before.push_back(face);
        Faces after = bevelled_box(Vec3f::Zero(), size, 0.1f, types);
        const Vec3f foot = after[0].corners[0];
        // A handle, joined to the cabinet.
        const auto edge = [](int i, float y) {
            return Vec3f(-0.005f * static_cast<float>(i), y, 0.001f * static_cast<float>(i % 3));
        };
        for (int i = 0; i < 20; ++i) {
            before.push_back(quad(edge(i, 0), edge(i, 0.01f), edge(i + 1, 0.01f), edge(i + 1, 0)));
            before.back().painted = drawn_type(random);
        }
        after.push_back({{foot, foot + Vec3f(-0.5f, -0.5f, 0), foot + Vec3f(-0.5f, -0.5f, 0.01f)}});
        const LoadedLevel loaded = rematch(before, after);
        for (std::size_t face = 0; face + 1 < after.size(); ++face) {
            if (after[face].painted < 0) continue;
            const auto& type = loaded.level.overrides.at(face);
            EXPECT_TRUE(type && int{*type} == after[face].painted) << seed << ", face " << face;
        }
    }
}

}  // namespace
}  // namespace slipface::test

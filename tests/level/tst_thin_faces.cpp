// Faces longer than a file's few bytes of outline can say, and with hardly any area: maps are full of them.
#include <cmath>

#include "faces.h"

namespace slipface::test {
namespace {

// A triangle cut into four at the middles of its edges.
void add_quarters(const Face& face, Faces& faces) {
    Vec3f middle[3];
    for (std::size_t c = 0; c < 3; ++c)
        middle[c] = 0.5f * (face.corners[c] + face.corners[(c + 1) % 3]);
    for (std::size_t c = 0; c < 3; ++c)
        faces.push_back({{face.corners[c], middle[c], middle[(c + 2) % 3]}, face.material, face.painted});
    faces.push_back({{middle[0], middle[1], middle[2]}, face.material, face.painted});
}

// Fans of triangles up to 500 times as long as high, as compilers of maps cut walls, in planes of any
// direction.
Faces fans(Random& random) {
    Faces faces;
    for (int fan = 0; fan < 8; ++fan) {
        const Vec3 u = Vec3(drawn(random, -1, 1), drawn(random, -1, 1), drawn(random, -1, 1)).normalized();
        const Vec3 v = u.unitOrthogonal();
        const Vec3 top(10.0 * fan, drawn(random, -5, 5), drawn(random, -5, 5));
        const double length = drawn(random, 3, 20);
        double angle = 0.0;
        Vec3 last = top + length * u;
        for (int i = 0; i < 12; ++i) {
            angle += std::exp(drawn(random, std::log(2e-3), std::log(0.02)));
            const Vec3 side = std::cos(angle) * u + std::sin(angle) * v;
            const Vec3 next = top + drawn(random, 0.7, 1.0) * length * side;
            faces.push_back(
                {{top.cast<float>(), last.cast<float>(), next.cast<float>()}, "stone", drawn_type(random)});
            last = next;
        }
    }
    return faces;
}

TEST(ThinFaces, ASubdividedFanKeepsItsTypes) {
    std::size_t faces = 0, wrong = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        const Faces before = fans(random);
        Faces after;
        for (const Face& face : before)
            add_quarters(face, after);
        faces += after.size();
        wrong += wrong_faces(after, rematch(before, after)).size();
    }
    EXPECT_LE(wrong * 1000, faces);
}

// The two sides of slivers, which lie at one place.
TEST(ThinFaces, ScaledSliversKeepTheirSides) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        Faces before = tiles(6);
        for (Face& face : before)
            face.painted = drawn_type(random);
        for (int i = 0; i < 20; ++i) {
            const Vec3 at(drawn(random, 0, 6), 1.0, drawn(random, -8, -2));
            const Vec3 end = at + Vec3(0, drawn(random, 1, 6), 0);
            const Vec3 side = end + Vec3(0, 1e-5 * drawn(random, 1, 3), drawn(random, 1e-5, 2e-5));
            Face front{
                {at.cast<float>(), end.cast<float>(), side.cast<float>()}, "stone", drawn_type(random)};
            Face back{{side.cast<float>(), end.cast<float>(), at.cast<float>()}, "stone", drawn_type(random)};
            before.push_back(front);
            before.push_back(back);
        }
        Faces after = before;
        for (Face& face : after)
            for (Vec3f& corner : face.corners)
                corner *= 100.0f;
        EXPECT_TRUE(wrong_faces(after, rematch(before, after)).empty()) << seed;
    }
}

// Quads with a corner twice, two of them at each place: a tool makes triangles of them.
TEST(ThinFaces, RepeatedCornersThatAreGoneAreNoDifference) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        Faces before = tiles(6);
        for (Face& face : before)
            face.painted = drawn_type(random);
        Faces after = before;
        for (int i = 0; i < 10; ++i) {
            const Vec3f a = Vec3(drawn(random, 0, 6), 2.0 + i, drawn(random, -8, -2)).cast<float>();
            const Vec3f b = (a.cast<double>() + Vec3(drawn(random, 0.1, 1), 0, 0)).cast<float>();
            const Vec3f c = (a.cast<double>() + Vec3(0, 0, drawn(random, 0.02, 1))).cast<float>();
            for (int copy = 0; copy < 2; ++copy) {
                const int painted = drawn_type(random);
                before.push_back({{a, b, c, c}, "stone", painted});
                after.push_back({{a, b, c}, "stone", painted});
            }
        }
        EXPECT_TRUE(wrong_faces(after, rematch(before, after)).empty()) << seed;
    }
}

// Strips 4 m long and 6 cm wide; one corner of each moves, farther than that but not over the other side.
TEST(ThinFaces, AMovedCornerLeavesAStripItsType) {
    std::size_t faces = 0, wrong = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        const auto strips = [&](const std::vector<Vec3f>& left, const std::vector<int>& types) {
            Faces result;
            for (std::size_t i = 0; i < types.size(); ++i) {
                Face face =
                    quad(left[i], left[i + 1], left[i + 1] + Vec3f(4, 0, 0), left[i] + Vec3f(4, 0, 0));
                face.corners[2] = Vec3f(4, 0, 0.06f * static_cast<float>(i + 1));
                face.corners[3] = Vec3f(4, 0, 0.06f * static_cast<float>(i));
                face.painted = types[i];
                result.push_back(face);
            }
            return result;
        };
        std::vector<Vec3f> left;
        std::vector<int> types;
        for (int i = 0; i <= 40; ++i)
            left.emplace_back(0.0f, 0.0f, 0.06f * static_cast<float>(i));
        for (int i = 0; i < 40; ++i)
            types.push_back(static_cast<int>(random() % 5));
        const Faces before = strips(left, types);
        for (std::size_t i = 0; i < left.size(); i += 2)
            left[i] += Vec3(drawn(random, -0.1, 0.1), drawn(random, -0.1, 0.1), drawn(random, -0.05, 0.05))
                           .cast<float>();
        const Faces after = strips(left, types);
        faces += after.size();
        wrong += wrong_faces(after, rematch(before, after)).size();
    }
    EXPECT_LE(wrong * 100, 3 * faces);
}

}  // namespace
}  // namespace slipface::test

// Maps have torches, roots and leaves of a few millimetres. At a hundredth of their size six decimals are as
// coarse for them as a hair is for a wall.
#include <array>
#include <cmath>
#include <map>

#include "faces.h"

namespace slipface::test {
namespace {

Vec3f at(const Vec3& origin, double x, double y, double z) {
    return (origin + Vec3(x, y, z)).cast<float>();
}

// A ring of sides with caps of triangles, in millimetres, as patches of a map are cut. Some triangles have
// three corners in one line.
void add_torch(Faces& faces, const Vec3& origin, Random& random) {
    const int sides = 5 + static_cast<int>(random() % 6);
    const double radius = drawn(random, 0.005, 0.03), height = drawn(random, 0.01, 0.2);
    const auto corner = [&](int side, double up) {
        const double angle = 6.283185307 * (side % sides) / sides;
        return at(origin, radius * std::cos(angle), up * height, radius * std::sin(angle));
    };
    for (int side = 0; side < sides; ++side) {
        const Vec3f low = corner(side, 0), next = corner(side + 1, 0), top = corner(side + 1, 1),
                    up = corner(side, 1);
        const Vec3f middle =
            (low.cast<double>() + drawn(random, 0.2, 0.8) * (up - low).cast<double>()).cast<float>();
        faces.push_back({{low, next, top}, "torch"});
        faces.push_back({{low, top, up}, "torch"});
        faces.push_back({{at(origin, 0, height, 0), up, top}, "torch"});
        if (side % 3 == 0) faces.push_back({{low, middle, up}, "torch"});
    }
}

// A strip of quads some millimetres wide, which narrow to nothing at some places: a corner is there twice, or
// so nearly that rounding makes it so.
void add_root(Faces& faces, const Vec3& origin, Random& random) {
    const double length = drawn(random, 0.05, 0.3), step = drawn(random, 0.002, 0.004);
    std::vector<Vec3f> left, right;
    for (int i = 0; i < 16; ++i) {
        const double bend = drawn(random, 0, 0.002);
        left.push_back(at(origin, i * step, bend, 0));
        right.push_back(at(origin, i * step + bend, drawn(random, 0, 0.01), length));
        const double joined[] = {0.0, 1e-6, 1e-5, 1e-3};
        if (i > 0 && random() % 2 == 0) {
            right.back() = right[right.size() - 2];
            right.back().x() += static_cast<float>(joined[random() % 4]);
        }
    }
    for (std::size_t i = 1; i < left.size(); ++i)
        faces.push_back({{left[i - 1], left[i], right[i], right[i - 1]}, "root"});
}

// Two faces that cross, of which each has a back.
void add_flame(Faces& faces, const Vec3& origin, Random& random) {
    const double width = drawn(random, 0.02, 0.1), height = drawn(random, 0.02, 0.3);
    for (const Vec3& side : {Vec3(width, 0, 0), Vec3(0, 0, width)}) {
        const Vec3f a = (origin - side).cast<float>(), b = (origin + side).cast<float>();
        const Vec3f up(0, static_cast<float>(height), 0);
        faces.push_back({{a, b, b + up, a + up}, "flame"});
        faces.push_back({{a + up, b + up, b, a}, "flame"});
    }
}

Faces hall_of_torches(Random& random) {
    Faces faces = tiles(8);
    for (int i = 0; i < 12; ++i) {
        const Vec3 origin(drawn(random, -50, 50), drawn(random, 0, 9), drawn(random, -50, 50));
        add_torch(faces, origin, random);
        add_root(faces, origin + Vec3(0, 0.5, 0), random);
        add_flame(faces, origin + Vec3(0, 1, 0), random);
    }
    // In the order of their materials, as tools write them.
    std::stable_sort(faces.begin(), faces.end(),
                     [](const Face& a, const Face& b) { return a.material < b.material; });
    for (Face& face : faces)
        face.painted = drawn_type(random);
    return faces;
}

// A tool takes out a corner that a face has twice when it reads the file; rounding comes after that.
Faces written_by_a_tool(const Faces& faces, const Eigen::Affine3d& motion, bool flipped) {
    Faces written;
    for (Face face : faces) {
        std::vector<Vec3f> corners;
        for (const Vec3f& corner : face.corners)
            if (std::find(corners.begin(), corners.end(), corner) == corners.end()) corners.push_back(corner);
        for (Vec3f& corner : corners)
            corner = (motion * corner.cast<double>()).cast<float>().unaryExpr(&six_decimals);
        // A tool keeps the outside of a mirrored face.
        if (flipped != (motion.linear().determinant() < 0.0)) std::reverse(corners.begin(), corners.end());
        face.corners = corners;
        const auto is_new = [&](const Vec3f& corner) {
            return &*std::find(corners.begin(), corners.end(), corner) == &corner;
        };
        if (std::count_if(corners.begin(), corners.end(), is_new) >= 3)
            written.push_back(face);  // others are no faces to us
    }
    return written;
}

struct Faults {
    std::size_t wrong = 0, unsaid = 0, listed = 0;

    void add(const Faces& after, const LoadedLevel& loaded) {
        ASSERT_EQ(loaded.level.mesh.face_count(), after.size());
        const std::vector<FaceId>& guessed = loaded.level.guessed;
        for (const std::size_t face : wrong_faces(after, loaded)) {
            const bool found = loaded.level.overrides[face].has_value();
            const bool said = std::binary_search(guessed.begin(), guessed.end(), static_cast<FaceId>(face));
            wrong += found ? 1 : 0;
            unsaid += found && !said ? 1 : 0;
            listed += found ? 0 : 1;
        }
    }
};

class SmallFaces : public testing::TestWithParam<double> {};

TEST_P(SmallFaces, KeepTheirTypesScaledAndRounded) {
    Faults faults;
    std::size_t faces = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        Random random(seed);
        const Faces before = hall_of_torches(random);
        Eigen::Affine3d motion(Eigen::Scaling(GetParam()));
        if (seed % 3 == 0) motion = motion * Eigen::AngleAxisd(drawn(random, 0.1, 3), Vec3::UnitY());
        if (seed % 3 == 1) motion = motion * Eigen::Scaling(-1.0, 1.0, 1.0);
        const Faces after = written_by_a_tool(before, motion, false);
        faces += after.size();
        faults.add(after, rematch(before, after));
    }
    // Smaller ones are some of the last decimals apart: what order says of them can be wrong.
    const std::size_t allowed = GetParam() < 0.1 ? faces / 150 : 0;
    EXPECT_LE(faults.unsaid, allowed / 2);
    EXPECT_LE(faults.wrong, allowed);
    EXPECT_LE(faults.listed, allowed);
}

INSTANTIATE_TEST_SUITE_P(Scales, SmallFaces, testing::Values(1.0, 0.1, 0.01, 0.003, 100.0));

// A face with another one at its back looks after it was flipped as if nothing had happened.
TEST(SmallFaces, FlippedWithTheirBacksKeepTheirTypes) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        Random random(seed);
        const Faces before = hall_of_torches(random);
        for (const bool flipped : {false, true}) {
            const Faces after = written_by_a_tool(before, Eigen::Affine3d::Identity(), flipped);
            Faults faults;
            faults.add(after, rematch(before, after));
            EXPECT_EQ(faults.wrong + faults.listed, 0u) << seed << flipped;
        }
        const Faces sorted = shuffled(before, seed);
        EXPECT_TRUE(wrong_faces(sorted, rematch(before, sorted)).empty()) << seed;
    }
}

// A hundred metres from the origin a tool that turns in single precision leaves more than the last decimal.
TEST(RoundedFaces, AreNoGuessFarFromTheOrigin) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        Random random(seed);
        Faces before = tiles(12);
        for (Face& face : before) {
            for (Vec3f& corner : face.corners) {
                const float bump = std::sin(7.0f * corner.x() + 3.0f * corner.z() + static_cast<float>(seed));
                corner += Vec3f(90.0f, 0.3f * bump, -60.0f);
            }
        }
        before = triangulated(before);
        for (Face& face : before)
            face.painted = drawn_type(random);
        const Vec3 centre(96.0, 0.0, -62.0);
        const Eigen::AngleAxisd turn(drawn(random, 0.2, 3.0), Vec3::UnitY());
        std::map<std::array<float, 3>, Vec3f> moved;
        Faces after = before;
        for (Face& face : after) {
            for (Vec3f& corner : face.corners) {
                const auto [at, added] = moved.try_emplace({corner.x(), corner.y(), corner.z()});
                const Vec3 error(drawn(random, -5e-5, 5e-5), drawn(random, -5e-5, 5e-5),
                                 drawn(random, -5e-5, 5e-5));
                if (added)
                    at->second = (centre + turn * (corner.cast<double>() - centre) + error).cast<float>();
                corner = at->second;
            }
        }
        const LoadedLevel loaded = rematch(before, after);
        EXPECT_TRUE(wrong_faces(after, loaded).empty()) << seed;
        EXPECT_TRUE(loaded.level.guessed.empty()) << seed << ": " << loaded.match.text();
    }
}

}  // namespace
}  // namespace slipface::test

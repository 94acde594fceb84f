// What painted faces survive: each thing that a modelling tool does to a level, and what came of the paint.
// The table stands in docs/measurements.md and is compared with it here.
#include <fmt/format.h>

#include <functional>

#include "level/faces.h"
#include "slipface/base/files.h"

namespace slipface::test {
namespace {

constexpr int side = 24;
constexpr SurfaceId types = 8;

// Two floors, a wall between them and a row of long planks, three materials, every third face painted.
Faces painted_hall() {
    Faces faces = tiles(side);
    const Faces upper = tiles(side, 3.1f);
    faces.insert(faces.end(), upper.begin(), upper.end());
    for (int x = 0; x < side; ++x) {
        const Vec3f left = faces[static_cast<std::size_t>(x)].corners[0];
        const Vec3f right = faces[static_cast<std::size_t>(x)].corners[3];
        const Vec3f up(0, 3.0f, 0);
        faces.push_back(quad(left, right, right + up, left + up));
    }
    for (int x = 0; x < side; ++x) {
        const float z = 0.21f * static_cast<float>(x);
        faces.push_back(quad({0, 6, z}, {0, 6, z + 0.21f}, {15, 6, z + 0.21f}, {15, 6, z}));
    }
    const char* const materials[] = {"stone", "Old Wood", "grass"};
    for (std::size_t i = 0; i < faces.size(); ++i) {
        faces[i].material = materials[i / 5 % 3];
        if (i % 3 == 0) faces[i].painted = static_cast<int>(i / 3 % types);
    }
    return faces;
}

Faces sorted_by_material(Faces faces) {
    std::stable_sort(faces.begin(), faces.end(),
                     [](const Face& a, const Face& b) { return a.material < b.material; });
    return faces;
}

Faces renamed(Faces faces) {
    for (Face& face : faces) {
        std::replace(face.material.begin(), face.material.end(), ' ', '_');
        face.material += ".001";
    }
    return faces;
}

// Into four, at the middles of edges and face.
Faces subdivided(const Faces& faces) {
    Faces parts;
    for (const Face& face : faces) {
        Vec3f middle = Vec3f::Zero();
        for (const Vec3f& corner : face.corners)
            middle += corner / static_cast<float>(face.corners.size());
        const std::size_t count = face.corners.size();
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3f& here = face.corners[i];
            const Vec3f next = (here + face.corners[(i + 1) % count]) / 2;
            const Vec3f last = (here + face.corners[(i + count - 1) % count]) / 2;
            parts.push_back({{last, here, next, middle}, face.material, face.painted});
        }
    }
    return parts;
}

// A second hall beside the first, its x turned round: the copies are nobody's.
Faces with_mirrored_copy(Faces faces) {
    const std::size_t count = faces.size();
    for (std::size_t i = 0; i < count; ++i) {
        Face copy = faces[i];
        for (Vec3f& corner : copy.corners)
            corner.x() = 60.0f - corner.x();
        std::reverse(copy.corners.begin(), copy.corners.end());
        copy.painted = -1;
        faces.push_back(copy);
    }
    return faces;
}

// Every tenth floor tile half a metre up, with four new sides.
Faces extruded(Faces faces) {
    const std::size_t floor = static_cast<std::size_t>(side) * side;
    for (std::size_t i = 0; i < floor; i += 10) {
        const std::vector<Vec3f> base = faces[i].corners;
        for (Vec3f& corner : faces[i].corners)
            corner.y() += 0.5f;
        const std::vector<Vec3f> top = faces[i].corners;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t next = (k + 1) % 4;
            Face wall = quad(base[k], base[next], top[next], top[k]);
            wall.material = faces[i].material;
            faces.push_back(wall);
        }
    }
    return faces;
}

// One vertex in the middle of the lower floor, with the four tiles that meet there.
Faces with_moved_vertex(Faces faces) {
    const Vec3f vertex = faces[side * (side / 2) + side / 2].corners[0];
    for (Face& face : faces)
        for (Vec3f& corner : face.corners)
            if (corner == vertex) corner += Vec3f(0.2f, 0.15f, -0.1f);
    return faces;
}

Faces without_every_seventh(const Faces& faces) {
    Faces rest;
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (i % 7 != 0) rest.push_back(faces[i]);
    return rest;
}

struct Tool {
    const char* name;
    bool pure;           // a round trip: nothing may be lost
    std::size_t losses;  // painted faces that are gone, and must be listed as orphans
    std::function<Faces(const Faces&)> apply;
};

std::vector<Tool> tools() {
    return {
        {"nothing", true, 0, [](const Faces& f) { return f; }},
        {"faces sorted by material", true, 0, sorted_by_material},
        {"faces and corners shuffled", true, 0, [](const Faces& f) { return shuffled(f, 1); }},
        {"six decimals", true, 0, [](const Faces& f) { return rounded(f); }},
        {"names ending in .001", true, 0, renamed},
        {"all of these", true, 0, [](const Faces& f) { return renamed(rounded(shuffled(f, 2))); }},
        {"triangulated", true, 0, [](const Faces& f) { return rounded(triangulated(f)); }},
        {"subdivided", true, 0, [](const Faces& f) { return rounded(subdivided(f)); }},
        {"a mirrored copy beside it", true, 0,
         [](const Faces& f) { return shuffled(with_mirrored_copy(f), 3); }},
        {"every tenth tile extruded", false, 0, [](const Faces& f) { return shuffled(extruded(f), 4); }},
        {"a moved vertex", false, 0, [](const Faces& f) { return shuffled(with_moved_vertex(f), 5); }},
        {"every seventh face deleted", false, 58,
         [](const Faces& f) { return shuffled(without_every_seventh(f), 6); }},
    };
}

TEST(Survival, TableOfTheDocumentation) {
    const Faces before = painted_hall();
    std::string table =
        "| what the tool did | painted faces | exact | by plane | by nearest | orphaned | faces with the "
        "wrong "
        "type |\n|---|---|---|---|---|---|---|\n";
    for (const Tool& tool : tools()) {
        SCOPED_TRACE(tool.name);
        const Faces after = tool.apply(before);
        const LoadedLevel loaded = rematch(before, after);
        const std::size_t wrong = wrong_faces(after, loaded).size();
        EXPECT_EQ(wrong, 0u);
        EXPECT_EQ(loaded.match.orphaned, tool.losses);
        EXPECT_EQ(loaded.level.orphans.size(), tool.losses) << "every loss is listed";
        EXPECT_TRUE(!tool.pure || loaded.match.by_nearest == 0) << loaded.match.text();
        table += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", tool.name, painted_count(before),
                             loaded.match.exact, loaded.match.by_plane, loaded.match.by_nearest,
                             loaded.match.orphaned, wrong);
    }
    const Result<std::string> page = read_file(SLIPFACE_SOURCE_DIR "/docs/measurements.md");
    ASSERT_TRUE(page) << page.error().text();
    EXPECT_NE(page->find(table), std::string::npos) << "docs/measurements.md should show\n" << table;
}

}  // namespace
}  // namespace slipface::test

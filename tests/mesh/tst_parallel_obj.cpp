// The reader for ordinary OBJ files gives what assimp gives, bit for bit. A `vp` line, which means nothing
// here, sends the same text through assimp.
#include <gmock/gmock.h>

#include <bit>
#include <random>

#include "mesh/mesh_test_tools.h"

namespace slipface {
namespace {

constexpr const char* rare_line = "vp 0 0\n";

template <class Vectors>
std::vector<std::uint32_t> bits_of(const Vectors& vectors) {
    std::vector<std::uint32_t> bits;
    for (const auto& vector : vectors)
        for (const float part : vector)
            bits.push_back(std::bit_cast<std::uint32_t>(part));
    return bits;
}

void expect_same(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(bits_of(a.positions), bits_of(b.positions));
    EXPECT_EQ(bits_of(a.corner_uv), bits_of(b.corner_uv));
    EXPECT_EQ(a.corner_vertex, b.corner_vertex);
    EXPECT_EQ(a.face_first_corner, b.face_first_corner);
    EXPECT_EQ(a.face_material, b.face_material);
    EXPECT_EQ(a.face_group, b.face_group);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.triangle_face, b.triangle_face);
    EXPECT_EQ(a.groups, b.groups);
    EXPECT_EQ(a.fingerprint, b.fingerprint);
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (std::size_t i = 0; i < a.materials.size(); ++i)
        EXPECT_EQ(a.materials[i].name, b.materials[i].name);
}

class ParallelObj : public ScratchFolder {
  protected:
    void expect_both_readers_agree(const std::string& text) const {
        const auto quick = import(text);
        const auto careful = import(text + rare_line);
        ASSERT_TRUE(quick) << quick.error().text();
        ASSERT_TRUE(careful) << careful.error().text();
        EXPECT_FALSE(quick->through_assimp);
        EXPECT_TRUE(careful->through_assimp);
        expect_same(*quick->mesh, *careful->mesh);
        EXPECT_EQ(quick->warnings, careful->warnings);
    }
};

// Every way of writing a number that tools use, random digits behind them.
std::string random_number(std::mt19937& random) {
    const auto below = [&](unsigned count) { return static_cast<unsigned>(random() % count); };
    std::string text = below(2) == 0 ? "-" : "";
    const auto digits = [&](unsigned least, unsigned maximum) {
        for (unsigned i = 0, count = least + below(maximum - least + 1); i < count; ++i)
            text += static_cast<char>('0' + below(10));
    };
    if (below(20) != 0) digits(1, 6);
    if (text.empty() || !std::isdigit(text.back()) || below(4) != 0) {
        text += '.';
        digits(1, below(8) == 0 ? 19 : 8);
    }
    if (below(10) == 0) {
        text += below(2) == 0 ? "e-" : "E-";
        digits(1, 1);
    }
    return text;
}

TEST_F(ParallelObj, ReadsNumbersAsAssimpDoes) {
    std::mt19937 random(7);
    constexpr int vertices = 6000;
    std::string text;
    for (int i = 0; i < vertices; ++i)
        text +=
            "v " + random_number(random) + " " + random_number(random) + " " + random_number(random) + "\n";
    for (int i = 0; i < vertices; ++i)
        text += "vt " + random_number(random) + " " + random_number(random) + "\n";
    for (int i = 1; i + 2 <= vertices; i += 3)
        text += fmt::format("f {}/{} {}/{} {}/{}\n", i, i, i + 1, i + 1, i + 2, i + 2);
    expect_both_readers_agree(text);
}

// Large enough for several parts, with every statement that is ordinary, on both sides of their borders.
TEST_F(ParallelObj, JoinsItsPartsAsIfTheyWereOne) {
    std::mt19937 random(11);
    std::string text = "\xEF\xBB\xBF# made by a test\r\nmtllib none.mtl\r\n";
    int vertices = 0;
    for (int block = 0; text.size() < (std::size_t{3} << 19); ++block) {
        if (block % 7 == 0) text += fmt::format("o thing {}\n", block % 21);
        if (block % 5 == 0) text += fmt::format("usemtl stone {}\n", block % 15);
        if (block % 11 == 0) text += "g\n\n  # a comment \\\n";
        const int corners = 3 + static_cast<int>(random() % 4);
        for (int i = 0; i < corners; ++i)
            text +=
                fmt::format("v {} {}.25 {}.125 0.5 0.5 0.5\n", random() % 50, random() % 50, random() % 50);
        vertices += corners;
        text += "vt 0.25 0.75\nvn 0 1 0\ns off\n\tf";
        for (int i = 0; i < corners; ++i) {
            const int index = random() % 2 == 0 ? -1 - i : vertices - i;
            const char* forms[] = {" {}", " {}/-1", " {}//-1", " {}/1/1"};
            text += fmt::format(fmt::runtime(forms[random() % 4]), index);
        }
        text += random() % 3 == 0 ? "\r\n" : "  \n";
    }
    expect_both_readers_agree(text);
}

TEST_F(ParallelObj, LeavesWhatIsRareToAssimp) {
    const std::string square = square_vertices + "f 1 2 3 4\n";
    const auto ordinary = import(square);
    ASSERT_TRUE(ordinary);
    EXPECT_FALSE(ordinary->through_assimp);
    for (const char* line :
         {"l 1 2\n", "curv 1\n", "f 1 2 3 # three\n", "f 1 2 2\n", "v 1 \\\n 2 3\n", "usemtl \xE4rger\n"}) {
        const auto rare = import(square + line);
        ASSERT_TRUE(rare) << line << rare.error().text();
        EXPECT_TRUE(rare->through_assimp) << line;
    }
}

TEST_F(ParallelObj, StopsWhenItIsCancelled) {
    write("level.obj", square_vertices + "f 1 2 3 4\n");
    Progress progress;
    progress.cancel();
    ImportOptions options;
    options.progress = &progress;
    const auto imported = import_mesh(folder / "level.obj", options);
    ASSERT_FALSE(imported);
    EXPECT_THAT(imported.error().text(), testing::HasSubstr("cancelled"));
}

TEST_F(ParallelObj, TurnsAndScalesTheFile) {
    write("level.obj", "v 100 0 0\nv 0 200 0\nv 0 0 300\nf 1 2 3\n");
    ImportOptions options;
    options.transform = {.scale = 0.01, .up = UpAxis::z};
    const auto imported = import_mesh(folder / "level.obj", options);
    ASSERT_TRUE(imported) << imported.error().text();
    EXPECT_EQ(imported->mesh->positions[0], Vec3f(1, 0, 0));
    EXPECT_EQ(imported->mesh->positions[1], Vec3f(0, 0, -2)) << "the file's +Y lies behind";
    EXPECT_EQ(imported->mesh->positions[2], Vec3f(0, 3, 0)) << "the file's +Z is up";
}

}  // namespace
}  // namespace slipface

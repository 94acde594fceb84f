#include <gmock/gmock.h>

#include "mesh_test_tools.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class ImportMaterials : public ScratchFolder {
  protected:
    // Imports one triangle of each material, below the given `mtllib` lines.
    std::vector<Material> materials(const std::string& libraries, const std::vector<std::string>& names) {
        std::string text = libraries + square_vertices;
        for (const std::string& name : names)
            text += "usemtl " + name + "\nf 1 2 3\n";
        auto result = import(text);
        if (!result) {
            ADD_FAILURE() << result.error().text();
            return {};
        }
        warnings = result->warnings;
        return result->mesh->materials;
    }

    Warnings warnings;
};

TEST_F(ImportMaterials, ColorsAndTextures) {
    write("a.mtl",
          "# colours\nnewmtl ice\nKa 1 1 1\nKd 0.25 0.5 1\nmap_Kd textures\\blue ice.png\n\n"
          "newmtl grey one\nKd 0.5\nmap_Kd -s 2 2 -o 0.5 -clamp on -mm 0 1 -bm 0.2 wall.png\nNs 10\nnewmtl "
          "plain\n");
    const auto found = materials("mtllib a.mtl\n", {"plain", "ice", "grey one"});
    ASSERT_THAT(found, SizeIs(3));
    EXPECT_EQ(found[0].name, "plain");
    EXPECT_EQ(found[0].diffuse, Vec3f::Constant(0.8F));
    EXPECT_EQ(found[1].name, "ice");
    EXPECT_EQ(found[1].diffuse, Vec3f(0.25F, 0.5F, 1));
    EXPECT_EQ(found[1].texture, "textures/blue ice.png");
    EXPECT_EQ(found[2].diffuse, Vec3f::Constant(0.5F));
    EXPECT_EQ(found[2].texture, "wall.png");
    EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(ImportMaterials, SeveralLibrariesAndNamesWithSpaces) {
    write("a.mtl", "newmtl a\nKd 1 0 0\n");
    write("b.mtl", "newmtl b\nKd 0 1 0\nmap_Kd t.png\n");
    write("sub/my own.mtl", "newmtl c\nKd 0 0 1\nmap_Kd t.png\n");
    const auto found =
        materials("mtllib a.mtl b.mtl\nmtllib sub\\my own.mtl\nmtllib ./a.mtl\n", {"a", "b", "c"});
    ASSERT_THAT(found, SizeIs(3));
    EXPECT_EQ(found[0].diffuse, Vec3f(1, 0, 0));
    EXPECT_EQ(found[1].diffuse, Vec3f(0, 1, 0));
    EXPECT_EQ(found[1].texture, "t.png");
    EXPECT_EQ(found[2].diffuse, Vec3f(0, 0, 1));
    EXPECT_EQ(found[2].texture, "sub/t.png") << "as seen from the level's folder";
    EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(ImportMaterials, AMissingLibraryKeepsTheNamesAndIsSaidOnce) {
    const auto found = materials("mtllib no.mtl\nmtllib no.mtl\n", {"ice__sticky", "mud"});
    ASSERT_THAT(found, SizeIs(2));
    EXPECT_EQ(found[0].name, "ice__sticky");
    EXPECT_EQ(found[1].name, "mud");
    ASSERT_THAT(warnings, SizeIs(1));
    EXPECT_EQ(warnings[0].location, location() + ":1");
    EXPECT_THAT(warnings[0].message, HasSubstr("'no.mtl': no such file"));
}

TEST_F(ImportMaterials, WithoutALibraryNamesAreKeptInSilence) {
    const auto found = materials("", {"ice"});
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_EQ(found[0].name, "ice");
    EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(ImportMaterials, AMaterialThatNoLibraryHasIsSaid) {
    write("a.mtl", "newmtl a\n");
    EXPECT_THAT(materials("mtllib a.mtl\n", {"a", "b"}), SizeIs(2));
    ASSERT_THAT(warnings, SizeIs(1));
    EXPECT_EQ(warnings[0].location, location() + ":8");
    EXPECT_THAT(warnings[0].message, HasSubstr("'b'"));
}

TEST_F(ImportMaterials, LibrariesOutsideTheFolderAreNotRead) {
    write("secret.mtl", "newmtl a\nKd 1 0 0\n");
    write("level/inner.mtl", "newmtl a\nKd 0 1 0\n");
    std::error_code no_links;  // a file that is missing is not read either
    fs::create_symlink(folder / "secret.mtl", folder / "level" / "link.mtl", no_links);
    const std::string rest = square_vertices + "usemtl a\nf 1 2 3\n";
    for (const std::string& name :
         {std::string("../secret.mtl"), (folder / "secret.mtl").string(), std::string("C:\\temp\\secret.mtl"),
          std::string("link.mtl"), std::string("sub/../../secret.mtl")}) {
        write("level/level.obj", "mtllib " + name + "\n" + rest);
        const auto result = import_mesh(folder / "level" / "level.obj");
        ASSERT_TRUE(result) << result.error().text();
        EXPECT_EQ(result->mesh->materials[0].diffuse, Vec3f::Constant(0.8F)) << name;
        EXPECT_FALSE(result->warnings.empty()) << name;
    }
    // The file of that name beside the level is what the author most likely meant.
    write("level/level.obj", "mtllib /home/somebody/inner.mtl\n" + rest);
    EXPECT_EQ(import_mesh(folder / "level" / "level.obj")->mesh->materials[0].diffuse, Vec3f(0, 1, 0));
}

TEST_F(ImportMaterials, BytesThatAreNotTextCostOnlyWhatTheyStandIn) {
    write("a.mtl", std::string("# \x01\nnewmtl a\nKd 1 0 0\nmap_Kd a\0b.png\nnewmtl b\nKd 0 1 0\n\0", 56));
    const auto found = materials("mtllib a.mtl\n", {"a", "b"});
    ASSERT_THAT(found, SizeIs(2));
    EXPECT_EQ(found[0].diffuse, Vec3f(1, 0, 0));
    EXPECT_EQ(found[0].texture, "a?b.png");
    EXPECT_EQ(found[1].diffuse, Vec3f(0, 1, 0));
    ASSERT_THAT(warnings, SizeIs(1));
    EXPECT_EQ(warnings[0].location, (folder / "a.mtl").string() + ":1");
    EXPECT_THAT(warnings[0].message, HasSubstr("not text: read as '?'; 1 more of these"));
}

TEST_F(ImportMaterials, BadLibrariesAreWarnings) {
    write("junk.mtl", std::string("\x89PNG\n\0\1\2", 8));
    write("odd.mtl", "Kd 1 1 1\nnewmtl a\nKd red\nKd nan 0 0\nKd 2 -1 0.5\nnewmtl a\nKd 0 0 0\n");
    fs::create_directory(folder / "folder.mtl");
    const auto found = materials("mtllib junk.mtl\nmtllib folder.mtl\nmtllib odd.mtl\nmtllib\n", {"a"});
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_EQ(found[0].diffuse, Vec3f(1, 0, 0.5F)) << "clamped, and the first definition counts";
    ASSERT_THAT(warnings, SizeIs(6));
    EXPECT_EQ(warnings[0].location, (folder / "junk.mtl").string() + ":2");
    EXPECT_THAT(warnings[0].message, HasSubstr("no text"));
    EXPECT_THAT(warnings[1].message, HasSubstr("directory"));
    EXPECT_EQ(warnings[2].location, (folder / "odd.mtl").string() + ":3");
    EXPECT_EQ(warnings[3].location, (folder / "odd.mtl").string() + ":4");
    EXPECT_THAT(warnings[4].message, HasSubstr("defined twice"));
    EXPECT_THAT(warnings[5].message, HasSubstr("names no file"));
}

}  // namespace
}  // namespace slipface

// Which pictures a level wants from outside its folder; the user is asked before they are read.
#include <gtest/gtest.h>

#include <fstream>

#include "scratch_folder.h"
#include "slipface/mesh/build.h"
#include "slipface/render/level_renderer.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

TEST(OutsideTextures, AreThoseThatAreThereAndNotInTheFolder) {
    const fs::path root = test::make_scratch_folder(), folder = root / "level";
    fs::create_directories(folder / "pictures");
    for (const fs::path& file :
         {root / "secret.png", root / "named.png", folder / "named.png", folder / "pictures" / "stone.png"})
        std::ofstream(file) << "x";
    fs::create_symlink(root / "secret.png", folder / "link.png");

    PolygonSoup soup;
    soup.corner_position = {Vec3f(0, 0, 0), Vec3f(0, 0, 1), Vec3f(1, 0, 0)};
    soup.face_first_corner = {0, 3};
    for (const std::string& texture :
         {std::string("pictures/stone.png"), std::string("../secret.png"), std::string("..\\secret.png"),
          (root / "secret.png").string(), std::string("link.png"), std::string("../missing.png"),
          std::string(), std::string("../named.png"), std::string("../secret.png")}) {
        Material material;
        material.texture = texture;
        soup.materials.push_back(material);
    }
    const Result<MeshPtr> mesh = build_mesh(std::move(soup));
    ASSERT_TRUE(mesh) << mesh.error().text();
    const std::vector<std::string> expected{"../secret.png", "..\\secret.png", (root / "secret.png").string(),
                                            "link.png", "../named.png"};
    EXPECT_EQ(outside_textures(**mesh, folder), expected);
    fs::remove_all(root);
}

}  // namespace
}  // namespace slipface

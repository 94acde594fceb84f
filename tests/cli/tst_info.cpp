#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/verbs.h"
#include "scratch.h"
#include "slipface/image/image.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

class Info : public Scratch {
  protected:
    int run(const std::filesystem::path& path, bool json) {
        out.str("");
        err.str("");
        return cli::run_info({path, json}, out, err);
    }
    std::ostringstream out, err;
};

TEST_F(Info, JsonHoldsTheNumbers) {
    ASSERT_EQ(run(level, true), cli::exit_fine) << err.str();
    const auto json = nlohmann::json::parse(out.str());
    EXPECT_EQ(json["faces"], 2);
    EXPECT_EQ(json["triangles"], 4);
    EXPECT_EQ(json["faces_per_type"]["default"], 1);
    EXPECT_EQ(json["faces_per_type"]["ice"], 1);
    EXPECT_EQ(json["faces_per_type"]["ladder"], 0);
    EXPECT_EQ(json["bounds"]["min"], nlohmann::json::array({-10, 0, -10}));
    EXPECT_EQ(json["bounds"]["max"], nlohmann::json::array({10, 0, 10}));
    EXPECT_GT(json["load_s"].get<double>(), 0.0);
    EXPECT_GE(json["bvh_s"].get<double>(), 0.0);
    EXPECT_GT(json["bvh_bytes"].get<int>(), 0);
    EXPECT_EQ(json["painted_faces"], 0);
    EXPECT_TRUE(json["warnings"].is_array());
}

TEST_F(Info, TextIsARowAFact) {
    ASSERT_EQ(run(level, false), cli::exit_fine) << err.str();
    EXPECT_THAT(out.str(), HasSubstr("faces           2\n"));
    EXPECT_THAT(out.str(), HasSubstr("triangles       4\n"));
    EXPECT_THAT(out.str(), HasSubstr("bounds min      -10.000  0.000  -10.000  m\n"));
    EXPECT_THAT(out.str(),
                HasSubstr("\nfaces per type\n  default               1\n  ice                   1\n"));
    EXPECT_TRUE(err.str().empty());
}

// A map of 32 units per metre as an OBJ: a unit would be a metre.
TEST_F(Info, SaysHowTheFileWasReadAndDoubtsItsSize) {
    write("huge.obj", "v 0 0 0\nv 0 0 1856\nv 1856 0 1856\nv 1856 0 0\nf 1 2 3 4\n");
    ASSERT_EQ(run(level.parent_path() / "huge.obj", true), cli::exit_fine) << err.str();
    const auto json = nlohmann::json::parse(out.str());
    EXPECT_EQ(json["import"]["scale"], 1.0);
    EXPECT_EQ(json["import"]["scale_from"], "guessed");
    EXPECT_EQ(json["import"]["up"], "y");
    EXPECT_EQ(json["import"]["better_scale"], 1.0 / 32);
    EXPECT_EQ(json["import"]["size_m"], nlohmann::json::array({1856, 0, 1856}));
    EXPECT_EQ(json["open_edges"], 4);
    ASSERT_EQ(run(level.parent_path() / "huge.obj", false), cli::exit_fine);
    EXPECT_THAT(out.str(), HasSubstr("too large for a player; a scale of 0.03125 makes it 58 m"));
    EXPECT_THAT(out.str(), HasSubstr("1 m per unit (guessed: OBJ files have no unit: metres)"));
    ASSERT_EQ(run(level, true), cli::exit_fine);
    EXPECT_FALSE(nlohmann::json::parse(out.str())["import"].contains("doubt"));
}

TEST_F(Info, ListsTexturesThatCannotBeUsed) {
    const std::filesystem::path folder = level.parent_path();
    std::filesystem::create_directory(folder / "inner");
    const Image grey = make_image(2, 2, 90, 90, 90);
    ASSERT_TRUE(save_png(folder / "outside.png", grey).ok());
    ASSERT_TRUE(save_png(folder / "inner/here.png", grey).ok());
    write("inner/broken.png", "no picture");
    write("inner/floor.mtl",
          "newmtl stone\nmap_Kd here.png\nnewmtl moss\nmap_Kd gone.png\nnewmtl mud\nmap_Kd broken.png\n"
          "newmtl gravel\nmap_Kd broken.png\nnewmtl secret\nmap_Kd ../outside.png\n");
    std::string text = "mtllib floor.mtl\nv 0 0 0\nv 0 0 1\nv 1 0 1\n";
    for (const char* material : {"stone", "moss", "mud", "gravel", "secret"})
        text += fmt::format("usemtl {}\nf 1 2 3\n", material);
    write("inner/textured.obj", text);
    ASSERT_EQ(run(folder / "inner/textured.obj", true), cli::exit_fine) << err.str();
    std::vector<std::string> found;
    const auto json = nlohmann::json::parse(out.str());
    for (const auto& warning : json["warnings"])
        found.push_back(warning["location"].get<std::string>() + ": " +
                        warning["message"].get<std::string>());
    ASSERT_EQ(found.size(), 3u) << out.str();
    EXPECT_THAT(found[0], testing::StartsWith("material \"moss\": found no texture \"gone.png\" in "));
    EXPECT_THAT(found[1], testing::AllOf(testing::StartsWith("material \"mud\": "), HasSubstr("broken.png")));
    EXPECT_EQ(
        found[2],
        "material \"secret\": the texture \"../outside.png\" lies outside the level's folder: not read");
}

TEST_F(Info, ListsWarningsWithTheirLocation) {
    write("floor.slipface.json", R"({"slipface": 1, "studio": 1})");
    ASSERT_EQ(run(level, true), cli::exit_fine) << err.str();
    bool found = false;
    const auto json = nlohmann::json::parse(out.str());
    for (const auto& warning : json["warnings"]) {
        found |= warning["location"].get<std::string>().ends_with("floor.slipface.json:/studio");
    }
    EXPECT_TRUE(found) << out.str();
    ASSERT_EQ(run(level, false), cli::exit_fine);
    EXPECT_THAT(out.str(), HasSubstr("\nwarnings\n"));
    EXPECT_THAT(out.str(), HasSubstr("floor.slipface.json:/studio: "));
}

TEST_F(Info, BadInputIsNamedOnStandardError) {
    EXPECT_EQ(run(folder / "missing.obj", false), cli::exit_bad_input);
    EXPECT_THAT(err.str(), testing::StartsWith("slipface: " + (folder / "missing.obj").string()));
    EXPECT_TRUE(out.str().empty());
    EXPECT_EQ(run(folder, true), cli::exit_bad_input);
    write("floor.slipface.json", "{\"slipface\": 3}");
    EXPECT_EQ(run(level, true), cli::exit_bad_input);
    EXPECT_THAT(err.str(), HasSubstr("floor.slipface.json:/slipface: found the number 3"));
}

}  // namespace
}  // namespace slipface::test

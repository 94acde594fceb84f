#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/verbs.h"
#include "scratch.h"

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

TEST_F(Info, ListsTexturesThatAreNotThere) {
    write("floor.mtl", "newmtl stone\nmap_Kd here.png\nnewmtl moss\nmap_Kd gone.png\n");
    write("here.png", "");
    write("textured.obj",
          "mtllib floor.mtl\nv 0 0 0\nv 0 0 1\nv 1 0 1\nusemtl stone\nf 1 2 3\nusemtl moss\nf 1 2 3\n");
    ASSERT_EQ(run(level.parent_path() / "textured.obj", false), cli::exit_fine) << err.str();
    EXPECT_THAT(out.str(), HasSubstr("textured.obj: Material moss names gone.png, which is not there\n"));
    EXPECT_THAT(out.str(), testing::Not(HasSubstr("here.png")));
}

TEST_F(Info, ListsWarningsWithTheirPlace) {
    write("floor.slipface.json", R"({"slipface": 1, "studio": 1})");
    ASSERT_EQ(run(level, true), cli::exit_fine) << err.str();
    bool found = false;
    const auto json = nlohmann::json::parse(out.str());
    for (const auto& warning : json["warnings"]) {
        found |= warning["place"].get<std::string>().ends_with("floor.slipface.json:/studio");
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

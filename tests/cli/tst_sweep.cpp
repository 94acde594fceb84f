#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/verbs.h"
#include "scratch.h"
#include "slipface/level/level_file.h"
#include "slipface/sim/probe_test.h"

namespace slipface::test {
namespace {

using cli::SweepFormat;
using testing::HasSubstr;

class Sweep : public Scratch {
  protected:
    int run(cli::SweepOptions options) {
        out.str("");
        err.str("");
        options.level = level;
        options.radii = Vec3(0.4, 0.9, 0.4);
        return cli::run_sweep(options, out, err);
    }
    int run_one(const Vec3& from, const Vec3& move, SweepFormat format) {
        cli::SweepOptions options;
        options.from = from;
        options.move = move;
        options.format = format;
        return run(options);
    }
    int run_queries(const std::string& csv, SweepFormat format) {
        cli::SweepOptions options;
        options.queries = write("q.csv", csv);
        options.format = format;
        return run(options);
    }
    std::vector<std::string> lines() const {
        std::vector<std::string> all;
        std::istringstream stream(out.str());
        for (std::string line; std::getline(stream, line);)
            all.push_back(line);
        return all;
    }
    std::ostringstream out, err;
};

TEST_F(Sweep, JsonHoldsTheContact) {
    // From y = 2.9 by -4: the ellipsoid of half height 0.9 touches y = 0 after 2 of the 4 metres.
    ASSERT_EQ(run_one(Vec3(5, 2.9, 2), Vec3(0, -4, 0), SweepFormat::json), cli::exit_fine) << err.str();
    const auto json = nlohmann::json::parse(out.str());
    EXPECT_EQ(json["hit"], true);
    EXPECT_NEAR(json["t"].get<double>(), 0.5, 1e-12);
    EXPECT_NEAR(json["normal"][1].get<double>(), 1.0, 1e-12);
    EXPECT_NEAR(json["point"][0].get<double>(), 5.0, 1e-9);
    EXPECT_NEAR(json["point"][1].get<double>(), 0.0, 1e-9);
    EXPECT_EQ(json["face"], 1);
    EXPECT_EQ(json["feature"], "interior");
    EXPECT_EQ(json["surface"], "ice");
    EXPECT_GE(json["triangle"].get<int>(), 2);
}

TEST_F(Sweep, AMissIsAnAnswer) {
    ASSERT_EQ(run_one(Vec3(5, 2.9, 2), Vec3(0, 4, 0), SweepFormat::json), cli::exit_fine);
    EXPECT_EQ(nlohmann::json::parse(out.str()), nlohmann::json::parse("{\"hit\": false}"));
    ASSERT_EQ(run_one(Vec3(5, 2.9, 2), Vec3(0, 4, 0), SweepFormat::text), cli::exit_fine);
    EXPECT_EQ(out.str(), "no hit\n");
}

TEST_F(Sweep, TextIsARowAFact) {
    ASSERT_EQ(run_one(Vec3(-5, 2.9, 2), Vec3(0, -4, 0), SweepFormat::text), cli::exit_fine);
    EXPECT_THAT(out.str(), HasSubstr("normal          0.000  1.000  0.000\n"));
    EXPECT_THAT(out.str(), HasSubstr("point           -5.000  0.000  2.000  m\n"));
    EXPECT_THAT(out.str(), HasSubstr("surface         default\n"));
}

TEST_F(Sweep, AnswersOneRowARow) {
    const std::string queries =
        "ox,oy,oz,dx,dy,dz\n5,2.9,2,0,-4,0\n 5 , 2.9 ,2,0,4,0\r\n-5,1.9,2,0,-1e0,+0\n100,2,0,0,-4,0\n\n\n";
    ASSERT_EQ(run_queries(queries, SweepFormat::csv), cli::exit_fine) << err.str();
    const auto rows = lines();
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_EQ(rows[0], "hit,t,nx,ny,nz,px,py,pz,triangle,face,feature,surface");
    EXPECT_THAT(rows[1], testing::MatchesRegex("1,0\\.[45][0-9]*,.*,1,interior,ice"));
    EXPECT_EQ(rows[2], "0,,,,,,,,,,,");
    EXPECT_THAT(rows[3], testing::MatchesRegex("1,(1|0\\.9999).*,0,interior,default"));
    EXPECT_EQ(rows[4], "0,,,,,,,,,,,");
    for (const std::string& row : rows)
        EXPECT_EQ(std::count(row.begin(), row.end(), ','), 11);

    ASSERT_EQ(run_queries(queries, SweepFormat::json), cli::exit_fine);
    const auto json = nlohmann::json::parse(out.str());
    ASSERT_EQ(json.size(), 4u);
    EXPECT_EQ(json[0]["surface"], "ice");
    EXPECT_EQ(json[3]["hit"], false);

    ASSERT_EQ(run_queries(queries, SweepFormat::text), cli::exit_fine);
    EXPECT_EQ(lines().size(), 5u);
    EXPECT_THAT(lines()[2], HasSubstr("no hit"));
}

TEST_F(Sweep, ManyQueriesGiveTheAnswersOfEachAlone) {
    std::string queries = "ox,oy,oz,dx,dy,dz\n";
    for (int i = 0; i < 3000; ++i)
        queries += std::to_string(i % 19 - 9.5) + ",3,0,0.5,-" + std::to_string(1 + i % 4) + ",0\n";
    ASSERT_EQ(run_queries(queries, SweepFormat::csv), cli::exit_fine);
    const auto rows = lines();
    ASSERT_EQ(rows.size(), 3001u);
    // 19 and 4 have no common divisor: row i repeats after 76.
    for (std::size_t i = 1; i + 76 < rows.size(); ++i)
        ASSERT_EQ(rows[i], rows[i + 76]);
}

TEST_F(Sweep, OnlyTheHeaderGivesOnlyTheHeader) {
    ASSERT_EQ(run_queries("ox,oy,oz,dx,dy,dz\n", SweepFormat::csv), cli::exit_fine);
    EXPECT_EQ(lines().size(), 1u);
    ASSERT_EQ(run_queries("ox,oy,oz,dx,dy,dz", SweepFormat::json), cli::exit_fine);
    EXPECT_EQ(nlohmann::json::parse(out.str()).size(), 0u);
}

TEST_F(Sweep, SurfaceNamesAreQuotedWhereCsvNeedsIt) {
    write("floor.slipface.json",
          R"({"slipface": 1, "mesh": "floor.obj", "surfaces": [{"name": "default"}, {"name": "a,\"b\""}],
              "rules": [{"pattern": "*", "type": "a,\"b\""}]})");
    ASSERT_EQ(run_one(Vec3(-5, 2.9, 2), Vec3(0, -4, 0), SweepFormat::csv), cli::exit_fine) << err.str();
    EXPECT_THAT(out.str(), HasSubstr(",\"a,\"\"b\"\"\"\n"));
}

struct BadQueries {
    const char* csv;
    int line;
    const char* expected;
};

TEST_F(Sweep, ABadRowIsNamedAndNothingIsAnswered) {
    const std::string header = "ox,oy,oz,dx,dy,dz\n";
    const std::vector<std::tuple<std::string, int, std::string>> cases{
        {"", 1, "header"},
        {"0,0,0,0,0,0\n", 1, "header"},
        {"ox,oy,oz,dx,dy\n", 1, "header"},
        {header + "1,2,3,4,5,6\n1,2,3,4,5\n", 3, "5 values"},
        {header + "1,2,3,4,5,6,7\n", 2, "7 values"},
        {header + "1,2,x,4,5,6\n", 2, "\"x\" for oz"},
        {header + "1,2,3,4,5,nan\n", 2, "\"nan\" for dz"},
        {header + "1,2,3,1e999,5,6\n", 2, "for dx"},
        {header + "1,2,3,4,5,\n", 2, "\"\" for dz"},
        {header + "1,2,3,4,5,6\n\n1,2,3,4,5,6\n", 3, "1 values"},
        {header + std::string(2'000'000, ','), 2, "2000001 values"},
    };
    for (const auto& [csv, line, expected] : cases) {
        EXPECT_EQ(run_queries(csv, SweepFormat::csv), cli::exit_bad_input);
        EXPECT_THAT(err.str(), testing::StartsWith("slipface: " + (folder / "q.csv").string() + ":" +
                                                   std::to_string(line) + ": "));
        EXPECT_THAT(err.str(), HasSubstr(expected));
        EXPECT_TRUE(out.str().empty());
    }
}

TEST_F(Sweep, BadUsageAndMissingFilesHaveTheirCodes) {
    cli::SweepOptions options;
    EXPECT_EQ(run(options), cli::exit_bad_usage);
    options.from = Vec3(0, 0, 0);
    EXPECT_EQ(run(options), cli::exit_bad_usage);
    options.move = Vec3(0, 0, 0);
    options.queries = "q.csv";
    EXPECT_EQ(run(options), cli::exit_bad_usage);
    options.queries.reset();
    options.level = level;
    options.radii = Vec3(1, 0, 1);
    EXPECT_EQ(cli::run_sweep(options, out, err), cli::exit_bad_usage);
    options.from.reset();
    options.move.reset();
    options.queries = folder / "missing.csv";
    EXPECT_EQ(run(options), cli::exit_bad_input);
    EXPECT_THAT(err.str(), HasSubstr("missing.csv"));
    level = folder / "missing.obj";
    EXPECT_EQ(run_one(Vec3(0, 0, 0), Vec3(0, 1, 0), SweepFormat::json), cli::exit_bad_input);
}

TEST_F(Sweep, ATestOfTheProbeHoldsOrSaysWhatDiffers) {
    const Result<LoadedLevel> loaded = load_level(level);
    ASSERT_TRUE(loaded.ok());
    const Result<CollisionWorld> world = build_collision_world(loaded->level);
    ASSERT_TRUE(world.ok());
    ProbeTest made = make_probe_test({*world, loaded->level.surfaces}, {}, Vec3(-5, 2, 1), Vec3(1, -3, 0));
    const auto test = [&](const std::string& text) {
        out.str("");
        err.str("");
        return cli::run_sweep_test(level, write("a.probe", text), out, err);
    };
    EXPECT_EQ(test(probe_test_to_text(made)), cli::exit_fine) << err.str();
    EXPECT_THAT(out.str(), HasSubstr("passed"));
    made.end.y() += 0.1;
    EXPECT_EQ(test(probe_test_to_text(made)), cli::exit_check_failed);
    EXPECT_THAT(err.str(), HasSubstr("a.probe: end: found"));
    EXPECT_EQ(test("slipface-probe 1\nhop\n"), cli::exit_bad_input);
    EXPECT_THAT(err.str(), HasSubstr("a.probe:2"));
    EXPECT_EQ(cli::run_sweep_test(level, folder / "none.probe", out, err), cli::exit_bad_input);
}

}  // namespace
}  // namespace slipface::test

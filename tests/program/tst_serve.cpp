// `slipface serve` as another program speaks with it (docs/course.md).
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

#include "program/run_program.h"

namespace slipface::test {
namespace {

using Json = nlohmann::ordered_json;

// `slipface serve`, with redirections of its own.
ProgramRun run_serve(const std::string& arguments) {
    return run_program("'" SLIPFACE_PROGRAM " serve " + arguments + "'", 60, "sh -c");
}

// The answers to these lines.
std::vector<Json> serve(const std::string& lines) {
    const ScratchFolder folder;
    const ProgramRun run = run_serve("<" + folder.write("requests", lines));
    EXPECT_EQ(run.exit_code, 0) << run.output;
    std::vector<Json> answers;
    std::istringstream in(run.output);
    for (std::string line; std::getline(in, line);)
        answers.push_back(Json::parse(line));
    return answers;
}

Json floor_mesh() {
    return {{"positions", {{-50, 0, -50}, {-50, 0, 50}, {50, 0, 50}, {50, 0, -50}}},
            {"triangles", {{0, 1, 2}, {0, 2, 3}}}};
}

Json load(const std::string& run) {
    return {{"do", "load"},
            {"run", run},
            {"body", {{"radius", 0.4}, {"height", 1.8}}},
            {"feet", {0, 0.01, 0}},
            {"settings", {{"walk_speed", 5}}},
            {"meshes", {floor_mesh()}}};
}

Json step(const std::string& run, double dt, Json wish) {
    return {{"do", "step"}, {"run", run}, {"dt", dt}, {"wish", std::move(wish)}};
}

std::string line(const Json& json) {
    return json.dump() + "\n";
}

TEST(Serve, WalksAtTheSpeedOfItsSettingsAtEveryRate) {
    for (const int rate : {20, 60, 144}) {
        std::string lines = line(load("a"));
        for (int i = 0; i < 3 * rate; ++i)
            lines += line(step("a", 1.0 / rate, {1, 0}));
        const std::vector<Json> answers = serve(lines);
        // 5 m/s in the last of three seconds, when it has long got under way.
        const auto before = answers[static_cast<std::size_t>(2 * rate)]["feet"][0].get<double>();
        EXPECT_NEAR(answers.back()["feet"][0].get<double>() - before, 5.0, 0.01);
        EXPECT_NEAR(answers.back()["velocity"][0].get<double>(), 5.0, 0.01);
        EXPECT_EQ(answers.back()["grounded"], true);
    }
}

TEST(Serve, ABodyThatMovesCarriesThePlayer) {
    Json request = load("lift");
    request["meshes"][0]["moves"] = true;
    request["meshes"][0]["position"] = {3, 1, 0};
    request["feet"] = {0, 1.01, 0};
    std::string lines = line(request);
    for (int i = 0; i < 20; ++i)
        lines += line(step("lift", 1.0 / 60, {0, 0}));
    for (int i = 1; i <= 60; ++i) {
        Json up = step("lift", 1.0 / 60, {0, 0});
        up["poses"] = {{{"mesh", 0}, {"position", {3 + 0.05 * i, 1 + 0.02 * i, 0}}}};
        lines += line(up);
    }
    const Json feet = serve(lines).back()["feet"];
    EXPECT_NEAR(feet[0].get<double>(), 3.0, 0.1);  // 60 times 0.05 m
    EXPECT_NEAR(feet[1].get<double>(), 2.2, 0.01);
}

TEST(Serve, RunsDoNotDisturbEachOther) {
    std::string alone = line(load("a")), together = line(load("a")) + line(load("b"));
    for (int i = 0; i < 50; ++i) {
        alone += line(step("a", 0.02, {0.6, -0.3}));
        together += line(step("b", 0.011, {-1, 1})) + line(step("a", 0.02, {0.6, -0.3}));
    }
    EXPECT_EQ(serve(alone).back()["feet"], serve(together).back()["feet"]);
}

TEST(Serve, AFileGivesThePositionsOfTheLines) {
    std::string lines = line(load("a"));
    for (int i = 0; i < 40; ++i)
        lines += line(step("a", 0.02, {1, 0}));
    Json request = load("a");
    request.erase("do");
    request.erase("run");
    Json broken = request;
    broken["meshes"][0]["triangles"][0][0] = 99;
    const Json steps = {{{"repeat", 40}, {"dt", 0.02}, {"wish", {1, 0}}}};
    const Json course = {{"slipface_course", 1},
                         {"runs",
                          {{{"run", "broken"}, {"load", broken}, {"steps", steps}},
                           {{"run", "a"}, {"load", request}, {"steps", steps}}}}};
    const ScratchFolder folder;
    const ProgramRun run = run_serve("--file " + folder.write("course.json", course.dump()) + " 2>/dev/null");
    EXPECT_EQ(run.exit_code, 2);  // one of its runs cannot be run
    const Json answer = Json::parse(run.output);
    EXPECT_EQ(answer["runs"]["broken"]["error"]["place"], "/runs/0/load/meshes/0/triangles/0/0");
    ASSERT_EQ(answer["runs"]["a"]["feet"].size(), 40u);
    EXPECT_EQ(answer["runs"]["a"]["feet"].back(), serve(lines).back()["feet"]);
}

TEST(Serve, RefusesWithPlaceFoundAndExpected) {
    const struct {
        std::string line, place;
    } rows[] = {
        {"no JSON\n", "/"},
        {"[1]\n", "/"},
        {"{}\n", "/"},
        {line({{"do", "fly"}}), "/do"},
        {line({{"do", "hello"}, {"protocol", 2}}), "/protocol"},
        {line(step("never", 0.02, {1, 0})), "/run"},
        {line(step("a", -1, {1, 0})), "/dt"},
        {line(step("a", 0.02, {1, 0, 0})), "/wish"},
        {line(step("a", 0.02, {1, "x"})), "/wish/1"},
        {R"({"do":"step","run":"a","dt":0.02,"whish":[1,0]})"
         "\n",
         "/"},
        {R"({"do":"step","run":"a","dt":0.02,"buttons":["fly"]})"
         "\n",
         "/buttons/0"},
        {R"({"do":"step","run":"a","dt":0.02,"poses":[{"mesh":0,"position":[0,0,0]}]})"
         "\n",
         "/poses/0/mesh"},
        {R"({"do":"load","run":"a","body":{"radius":0,"height":1},"feet":[0,0,0],"meshes":[]})"
         "\n",
         "/body/radius"},
        {R"({"do":"load","run":"a","body":{"radius":1,"height":2},"feet":[0,1e99,0],"meshes":[]})"
         "\n",
         "/feet/1"},
        {R"({"do":"load","run":"a","body":{"radius":1,"height":2},"feet":[0,0,0],"meshes":[],"settings":{"own":{"step_up":[[[1]]]}}})"
         "\n",
         "/settings/own/step_up"},
    };
    for (const auto& row : rows) {
        const std::vector<Json> answers = serve(line(load("a")) + row.line + line(step("a", 0.02, {1, 0})));
        ASSERT_EQ(answers.size(), 3u) << row.line;
        ASSERT_TRUE(answers[1].contains("error")) << row.line;
        EXPECT_EQ(answers[1]["error"]["place"], row.place) << row.line;
        EXPECT_EQ(answers[1]["line"], 2) << row.line;
        EXPECT_NE(answers[1]["error"]["expected"], "") << row.line;
        EXPECT_TRUE(answers[2].contains("feet")) << row.line;  // the run is as it was
    }
}

// Whatever comes, each line is answered and the program ends well.
TEST(Serve, AnswersDamagedLines) {
    std::mt19937 random(7);
    std::string lines;
    std::size_t count = 0;
    for (; count < 400; ++count) {
        std::string text = (count % 2 == 0 ? load("a") : step("a", 0.02, {1, 0})).dump();
        for (auto damage = random() % 3; damage-- > 0;) {
            const std::size_t at = random() % text.size();
            const char with = "{}[]\",:-9e"[random() % 10];
            random() % 2 == 0 ? text.erase(at, 1 + random() % 8) : text.insert(at, 1, with);
            if (text.empty()) text = "x";
        }
        lines += text + "\n";
    }
    lines += std::string(100000, '[') + "\n";
    EXPECT_EQ(serve(lines).size(), count + 1);
}

}  // namespace
}  // namespace slipface::test

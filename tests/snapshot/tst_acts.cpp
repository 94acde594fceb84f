// Worlds, their changes and their spellings are drawn from seeds: a change is named by what was done, and
// another order or spelling of the same world is no change.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "goldens/acts.h"
#include "goldens/face_list.h"
#include "goldens/level_facts.h"
#include "slipface/image/image.h"
#include "slipface/level/level_file.h"
#include "snapshots/input_book.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// One generator for all draws; std::*_distribution gives other numbers with other libraries.
struct Draw {
    std::mt19937 bits;
    int below(int n) { return static_cast<int>(bits() % static_cast<unsigned>(n)); }
    double between(double low, double high) { return low + (high - low) * below(10'000) / 10'000.0; }
    template <class T>
    void shuffle(std::vector<T>& list) {
        for (std::size_t i = list.size(); i > 1; --i)
            std::swap(list[i - 1], list[static_cast<std::size_t>(below(static_cast<int>(i)))]);
    }
};

using Corner = std::array<double, 3>;
struct Box {
    std::string name, material;
    std::vector<Corner> corners;          // 8
    std::vector<std::vector<int>> faces;  // of corners
};
struct World {
    std::vector<Box> boxes;
    nlohmann::json file;  // the level file
    std::uint8_t texel = 90;
};

Box box_of(const std::string& name, const std::string& material, const Corner& low, const Corner& high) {
    Box box{name,
            material,
            {},
            {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
    for (const double z : {low[2], high[2]})
        for (const auto& [x, y] : {std::pair(low[0], low[1]), std::pair(high[0], low[1]),
                                   std::pair(high[0], high[1]), std::pair(low[0], high[1])})
            box.corners.push_back({x, y, z});
    return box;
}

World world_of(Draw& draw) {
    World world;
    const int count = 2 + draw.below(5);
    for (int i = 0; i < count; ++i) {
        const double x = 8.0 * i + draw.between(-1, 1), y = draw.between(-1, 1);
        world.boxes.push_back(box_of("box" + std::to_string(i), i % 2 == 0 ? "stone" : "ice_pool",
                                     {x, y, draw.between(-4, -1)},
                                     {x + draw.between(1, 5), y + draw.between(0.2, 2), draw.between(1, 4)}));
    }
    nlohmann::json& file = world.file;
    file = {{"slipface", 2},
            {"mesh", "a.obj"},
            {"spawn", {{"position", {draw.between(0, 3), 3.0, 0.0}}, {"yaw", 0}}}};
    file["rules"] = {{{"pattern", "ice*"}, {"type", "ice"}}};
    file["movement"] = {{"gravity", draw.between(10, 30)}, {"walk_speed", draw.between(3, 9)}};
    file["platforms"] = {
        {{"name", "lift"},
         {"group", "box1"},
         {"path", {{{"offset", {0, 0, 0}}, {"speed", 1.5}}, {{"offset", {0, 2, 0}}, {"speed", 1.5}}}}}};
    file["props"] = nlohmann::json::array();
    const int props = 1 + draw.below(4);
    for (int i = 0; i < props; ++i)
        file["props"].push_back({{"name", "crate" + std::to_string(i)},
                                 {"mesh", "crate.obj"},
                                 {"position", {draw.between(-20, 20), 0.0, draw.between(5, 20)}}});
    file["cameras"] = {{{"name", "gate"}, {"eye", {9, 4, draw.between(5, 15)}}, {"target", {0, 0, 0}}}};
    return world;
}

// The OBJ: the order of objects, faces and first corners is drawn.
std::string obj_of(const World& world, Draw& draw, bool plain) {
    std::string text = "mtllib a.mtl\n", faces;
    std::vector<std::size_t> order(world.boxes.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    if (!plain) draw.shuffle(order);
    int first = 1;
    for (const std::size_t index : order) {
        const Box& box = world.boxes[index];
        faces += "o " + box.name + "\nusemtl " + box.material + "\n";
        std::vector<std::vector<int>> list = box.faces;
        if (!plain) draw.shuffle(list);
        for (std::vector<int>& face : list) {
            if (!plain)
                std::rotate(face.begin(), face.begin() + draw.below(static_cast<int>(face.size())),
                            face.end());
            faces += "f";
            for (const int corner : face)
                faces += fmt::format(" {0}/{0}", first + corner);
            faces += "\n";
        }
        for (const Corner& c : box.corners)
            text += fmt::format("v {} {} {}\nvt {} {}\n", c[0], c[1], c[2], c[0] / 4, c[1] / 4);
        first += static_cast<int>(box.corners.size());
    }
    return text + faces;
}

class Acts : public testing::TestWithParam<unsigned> {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / fmt::format("slipface_acts_{}_{}", ::getpid(), GetParam());
        fs::create_directories(folder_);
        std::ofstream(folder_ / "a.mtl")
            << "newmtl stone\nKd 1 1 1\nmap_Kd stone.png\nnewmtl ice_pool\nKd 0.7 0.8 0.9\nnewmtl other\n";
        std::ofstream(folder_ / "crate.obj") << "o crate\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
        draw_.bits.seed(GetParam());
    }
    void TearDown() override { fs::remove_all(folder_); }

    Numbers facts(const World& world, bool plain = true) {
        std::ofstream(folder_ / "a.obj") << obj_of(world, draw_, plain);
        nlohmann::json file = world.file;
        if (!plain) {
            std::vector<nlohmann::json> props(file["props"].begin(), file["props"].end());
            draw_.shuffle(props);
            file["props"] = props;
        }
        std::ofstream(folder_ / "a.slipface.json") << file.dump(plain ? 1 : -1);
        Image stone = make_image(4, 4, world.texel, 80, 70);
        EXPECT_TRUE(save_png(folder_ / "stone.png", stone, plain ? PngEffort::fast : PngEffort::small).ok());
        const auto level = load_level(folder_ / "a.slipface.json");
        EXPECT_TRUE(level.ok()) << level.error().text();
        return level ? level_facts(level->level, level->warnings) : Numbers();
    }
    std::string first_act(const World& before, const World& after, bool plain = true) {
        const std::vector<Act> acts = acts_between(facts(before), facts(after, plain));
        return acts.empty() || acts.front().kind != ActKind::input ? "" : acts.front().text;
    }

    fs::path folder_;
    Draw draw_;
};

TEST_P(Acts, AnotherOrderIsNoChange) {
    for (int round = 0; round < 4; ++round) {
        const World world = world_of(draw_);
        const Numbers one = facts(world), other = facts(world, false);
        for (const Act& act : acts_between(one, other))
            EXPECT_EQ(act.kind, ActKind::order) << act.text;
        const auto differences = compare_numbers(numbers_text(one), numbers_text(other), "");
        ASSERT_TRUE(differences.ok());
        EXPECT_FALSE(any_decides(*differences)) << differences->front().path;
    }
}

// What is changed, and what its act must say, beside another order of everything.
TEST_P(Acts, AChangeIsNamedByWhatWasDone) {
    const std::vector<std::function<std::string(World&)>> changes{
        [&](World& w) {
            auto& prop =
                w.file["props"]
                      [static_cast<std::size_t>(draw_.below(static_cast<int>(w.file["props"].size())))];
            prop["position"][1] = 2.5;
            return fmt::format("prop `{}` moved 2.5 m", prop["name"].get<std::string>());
        },
        [&](World& w) {
            const auto name = w.file["props"][0]["name"].get<std::string>();
            w.file["props"].erase(0);
            return fmt::format("prop `{}` was removed", name);
        },
        [&](World& w) {
            w.file["props"][0]["name"] = "barrel";
            return std::string("prop `crate0` was renamed `barrel`");
        },
        [&](World& w) {
            for (auto& stop : w.file["platforms"][0]["path"])
                stop["speed"] = 1.2;
            return std::string("platform `lift` is slower: 1.5 to 1.2 m/s");
        },
        [&](World& w) {
            w.file["movement"]["gravity"] = 33;
            return std::string("setting gravity was");
        },
        [&](World& w) {
            w.file["spawn"]["position"][2] = 0.25;
            return std::string("the spawn moved 0.25 m");
        },
        [&](World& w) {
            w.file["cameras"][0]["eye"][0] = 9.5;
            return std::string("camera `gate` moved 0.5 m");
        },
        [&](World& w) {
            w.file["rules"][0]["type"] = "bouncy";
            return std::string("rule `ice*`: type was ice, is bouncy");
        },
        [&](World& w) {
            w.file["fall_limit"] = -30;
            return std::string("the fall limit was not set, is -30");
        },
        [&](World& w) {
            w.texel = 91;
            return std::string("the texture stone.png changed");
        },
        [&](World& w) {
            Box& box = w.boxes[static_cast<std::size_t>(draw_.below(static_cast<int>(w.boxes.size())))];
            box.corners[static_cast<std::size_t>(draw_.below(8))][static_cast<std::size_t>(draw_.below(3))] +=
                0.75;
            return fmt::format("a vertex of `{}` moved 0.75 m", box.name);
        },
        [&](World& w) {
            Box& box = w.boxes[static_cast<std::size_t>(draw_.below(static_cast<int>(w.boxes.size())))];
            for (Corner& corner : box.corners)
                corner[1] += 0.5;
            return fmt::format("object `{}` moved 0.5 m", box.name);
        },
        [&](World& w) {
            Box& box = w.boxes[static_cast<std::size_t>(draw_.below(static_cast<int>(w.boxes.size())))];
            auto& face = box.faces[static_cast<std::size_t>(draw_.below(6))];
            std::reverse(face.begin(), face.end());
            return fmt::format("1 face of `{}` were flipped", box.name);
        },
        [&](World& w) {
            Box& box = w.boxes[static_cast<std::size_t>(draw_.below(static_cast<int>(w.boxes.size())))];
            box.faces.erase(box.faces.begin() + draw_.below(6));
            return fmt::format("1 face of `{}` were removed", box.name);
        },
        [&](World& w) {
            w.boxes[1].name = "shelf";
            return std::string("object `box1` was renamed `shelf`: platform `lift` moves nothing");
        },
        [&](World& w) {
            w.boxes[0].material = "other";
            return std::string("6 faces of `box0` changed material `stone` to `other`");
        },
        [&](World& w) {
            for (Box& box : w.boxes)
                for (Corner& corner : box.corners)
                    for (double& part : corner)
                        part *= 1.25;
            return std::string("the geometry was scaled by 25 %");
        },
    };
    for (std::size_t kind = 0; kind < changes.size(); ++kind) {
        const World before = world_of(draw_);
        World after = before;
        const std::string wanted = changes[kind](after);
        const std::string plain = first_act(before, after), shuffled = first_act(before, after, false);
        EXPECT_EQ(plain.substr(0, wanted.size()), wanted) << "kind " << kind << ", seed " << GetParam();
        EXPECT_EQ(shuffled, plain) << "kind " << kind << ", seed " << GetParam();
    }
}

TEST_P(Acts, ATapeIsItsInputs) {
    const fs::path file = folder_ / "run.tape";
    const auto tape = [&](const std::string& lines) {
        std::ofstream(file) << "slipface-tape 1\nlevel x 0123456789abcdef\ndt 1/60\n" + lines;
        InputBook book(folder_);
        const auto input = book.read(book.add(file));
        EXPECT_TRUE(input.ok()) << input.error().text();
        return input ? Numbers::parse(input->facts) : Numbers();
    };
    std::string lines, split;
    std::vector<int> ticks;
    const int count = 3 + draw_.below(6);
    for (int i = 0; i < count; ++i) {
        const std::string input = i % 3 == 0 ? "\n" : fmt::format(" wish 0,{}\n", (i % 9 + 1) / 10.0);
        const int n = 4 + draw_.below(40), cut = 1 + draw_.below(n - 1);
        ticks.push_back(n);
        lines += std::to_string(n) + input;
        split += std::to_string(cut) + input + "# by hand\n" + std::to_string(n - cut) + input;
    }
    const Numbers whole = tape(lines);
    EXPECT_EQ(whole["hash"], tape(split)["hash"]);
    EXPECT_EQ(whole["lines"][0][0], "dt 1/60");
    EXPECT_EQ(whole["lines"].size(), ticks.size() + 1);
    EXPECT_TRUE(acts_between(whole, tape(split)).empty());
    int before_last = 0;
    for (std::size_t i = 0; i + 1 < ticks.size(); ++i)
        before_last += ticks[i];
    std::string pressed = lines;
    pressed.insert(pressed.size() - 1, " jump");
    const std::vector<Act> acts = acts_between(whole, tape(pressed));
    ASSERT_EQ(acts.size(), 1U);
    EXPECT_EQ(acts[0].text.find(fmt::format("the tape changed: from tick {}: ", before_last)), 0U)
        << acts[0].text;
    const std::vector<Act> longer = acts_between(whole, tape(lines + "2 wish 1,0\n"));
    ASSERT_EQ(longer.size(), 1U);
    EXPECT_NE(longer[0].text.find("it is 2 ticks longer"), std::string::npos) << longer[0].text;
}

TEST_P(Acts, FacesSurviveTheirTextAndDamageIsRefused) {
    FaceList faces;
    const int count = draw_.below(30);
    for (int i = 0; i < count; ++i) {
        FaceFact face{{}, "m" + std::to_string(draw_.below(3)), draw_.below(2) == 0 ? "" : "ice"};
        for (int k = 3 + draw_.below(4); k > 0; --k)
            face.corners.push_back({static_cast<float>(draw_.between(-9, 9)),
                                    static_cast<float>(draw_.between(-9, 9)), 0.0f, 0.5f, 1.0f});
        faces.push_back(face);
    }
    const Numbers json = face_list_json(faces);
    const auto back = face_list_of(json);
    ASSERT_TRUE(back);
    EXPECT_EQ(face_list_json(*back)["hash"], json["hash"]);
    EXPECT_EQ(back->size(), faces.size());
    const auto text = json["packed"].get<std::string>();
    for (int i = 0; i < 200; ++i) {
        std::string damaged = text;
        const auto at = static_cast<std::size_t>(draw_.below(static_cast<int>(damaged.size())));
        if (draw_.below(2) == 0) {
            damaged.resize(at);
        } else {
            damaged[at] = static_cast<char>(draw_.bits() & 0x7fU);
        }
        const auto read = face_list_of({{"packed", damaged}});
        EXPECT_TRUE(!read || *read == *back);
    }
}

TEST(ActsOfRows, AreNamed) {
    const auto act = [](const char* before, const char* after) {
        const std::vector<Act> acts = acts_between(Numbers::parse(before), Numbers::parse(after));
        return acts.empty() ? "" : acts.front().text;
    };
    EXPECT_EQ(act(R"({"masks": [[0,0,10,10]]})", R"({"masks": [[0,0,20,10]]})"),
              "the mask grew: 100 to 200 pixels");
    EXPECT_EQ(act(R"({"masks": []})", R"({"masks": [[0,0,20,10]]})"), "a mask was added");
    EXPECT_EQ(act(R"({"camera": {"eye": [0,0,0]}})", R"({"camera": {"eye": [0,0,2]}})"),
              "the camera of the suite moved 2 m");
    EXPECT_EQ(act(R"({"script": [["a"],["b"]]})", R"({"script": [["a"],["c"],["b"]]})"),
              "the script has another line `c`");
    EXPECT_EQ(act(R"({"style": "plain"})", R"({"style": "plain grid"})"),
              "the row's style: it was plain, is plain grid");
}

INSTANTIATE_TEST_SUITE_P(Seeds, Acts, testing::Range(1U, 13U));

}  // namespace
}  // namespace slipface

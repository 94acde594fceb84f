// Rules from Quake 3, from other levels and from lists.
#include <gmock/gmock.h>

#include "exchange/scratch_level.h"
#include "slipface/exchange/rules.h"

namespace slipface::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Rules : public ScratchLevel {
  protected:
    ImportedRules rules_of(const std::string& name, const std::string& text) const {
        write(name, text);
        Result<ImportedRules> rules = read_rules(path(name));
        if (rules) return std::move(*rules);
        ADD_FAILURE() << rules.error().text();
        return {};
    }
    std::string error_of(const std::string& name, const std::string& text) const {
        write(name, text);
        const Result<ImportedRules> rules = read_rules(path(name));
        return rules ? "read" : rules.error().text();
    }
};

std::string u32(std::uint32_t value) {
    std::string text;
    for (int i = 0; i < 4; ++i)
        text.push_back(static_cast<char>(value >> (8 * i)));
    return text;
}

std::string texture(std::string name, std::uint32_t flags, std::uint32_t contents) {
    name.resize(64, '\0');
    return name + u32(flags) + u32(contents);
}

std::string bsp(const std::string& textures, std::uint32_t begin = 144) {
    std::string lumps = u32(0) + u32(0) + u32(begin) + u32(static_cast<std::uint32_t>(textures.size()));
    lumps.resize(136, '\0');
    return "IBSP" + u32(46) + lumps + textures;
}

TEST_F(Rules, ShadersGiveTypesByTheirSurfaceParameters) {
    const ImportedRules rules =
        rules_of("base.shader",
                 "// ice of the north\ntextures/base/Floor\n{\n\tsurfaceparm SLICK\n\t{ map $lightmap\n "
                 "rgbGen identity }\n}\n"
                 "textures/base/rungs { /* two\nlines */ surfaceparm nomarks surfaceparm ladder }\n"
                 "plain { qer_editorimage x.tga }\n"
                 "ghost { surfaceparm nonsolid surfaceparm trans surfaceparm slick }\n"
                 "odd { surfaceparm wobbly }");
    EXPECT_THAT(rules.rules,
                ElementsAre(MaterialRule{"textures/base/Floor", "ice"}, MaterialRule{"Floor", "ice"},
                            MaterialRule{"textures/base/rungs", "ladder"}, MaterialRule{"rungs", "ladder"},
                            MaterialRule{"ghost", "nonsolid"}));
    ASSERT_EQ(rules.types.size(), 3u);
    EXPECT_EQ(rules.types[2].name, "nonsolid");
    EXPECT_FALSE(rules.types[2].solid);
    ASSERT_EQ(rules.warnings.size(), 1u);
    EXPECT_THAT(rules.warnings[0].text(), HasSubstr("base.shader:12: the surface parameter \"wobbly\""));
}

TEST_F(Rules, BrokenShadersNameTheirLine) {
    EXPECT_THAT(error_of("a.shader", "one {\n two\n"), HasSubstr("a.shader:3: found the end of the file"));
    EXPECT_THAT(error_of("a.shader", "one\n\n two {}"), HasSubstr("a.shader:3: found \"two\", expected '{'"));
    EXPECT_THAT(error_of("a.shader", "}"), HasSubstr("expected a shader's name"));
    EXPECT_THAT(error_of("a.shader", "one { /* for ever"), HasSubstr("end of the file"));
}

TEST_F(Rules, MapsGiveTypesByTheirFlags) {
    const ImportedRules rules =
        rules_of("q.bsp", bsp(texture("textures/ice", 2, 1) + texture("textures/stone", 0x1000, 1) +
                              texture("textures/lava", 2, 8) + texture("", 0x4000, 0)));
    EXPECT_THAT(rules.rules,
                ElementsAre(MaterialRule{"textures/ice", "ice"}, MaterialRule{"textures/lava", "hazard"}));
}

TEST_F(Rules, BrokenMapsAreRefused) {
    const std::string good = bsp(texture("a", 2, 0));
    EXPECT_THAT(error_of("q.bsp", good.substr(0, 100)), HasSubstr("no Quake 3 map"));
    EXPECT_THAT(error_of("q.bsp", good.substr(0, good.size() - 1)), HasSubstr("does not fit"));
    EXPECT_THAT(error_of("q.bsp", bsp(texture("a", 2, 0), 0xFFFFFFF0)), HasSubstr("does not fit"));
    EXPECT_THAT(error_of("q.bsp", bsp("short")), HasSubstr("does not fit"));
}

TEST_F(Rules, ListsAndOtherLevels) {
    EXPECT_THAT(rules_of("r.txt", "# ours\n*ice*   ice\n\nold stone wall\tladder # rungs\n").rules,
                ElementsAre(MaterialRule{"*ice*", "ice"}, MaterialRule{"old stone wall", "ladder"}));
    EXPECT_THAT(error_of("r.txt", "one two\nthree\n"),
                HasSubstr("r.txt:2: found \"three\", expected PATTERN TYPE"));
    Level other = open(grid_obj(2, {"stone"}));
    SurfaceType mud;
    mud.name = "mud";
    other.surfaces.push_back(mud);
    other.rules = {{"mud*", "mud"}};
    ASSERT_TRUE(save_level(other));
    const Result<ImportedRules> rules = read_rules(path("level.slipface.json"));
    ASSERT_TRUE(rules) << rules.error().text();
    EXPECT_THAT(rules->rules, ElementsAre(MaterialRule{"mud*", "mud"}));
    ASSERT_EQ(rules->types.size(), 1u);
    EXPECT_EQ(rules->types[0].name, "mud");
    EXPECT_THAT(error_of("r.obj", ""), HasSubstr("gives no rules"));
}

TEST_F(Rules, AreAddedOnceAndActAtOnce) {
    Level level = open(grid_obj(3, {"textures/base/floor", "wall"}));
    const ImportedRules rules = rules_of("a.shader", "textures/base/floor { surfaceparm slick }");
    const Result<AddedRules> added = add_rules(level, rules);
    ASSERT_TRUE(added);
    EXPECT_EQ(added->rules, 2u);
    EXPECT_EQ(added->types, 0u) << "ice is there already";
    EXPECT_EQ(level.surfaces[resolve_surfaces(level).surface[0]].name, "ice");
    EXPECT_EQ(add_rules(level, rules)->rules, 0u);
    EXPECT_FALSE(add_rules(level, {{}, {{"x", "unheard of"}}, {}}));
    EXPECT_EQ(level.rules.size(), 2u);
}

}  // namespace
}  // namespace slipface::test

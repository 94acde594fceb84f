// Probe tests: written, read again, held and broken.
#include <gmock/gmock.h>

#include "sim/stripes.h"
#include "slipface/sim/probe_test.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

ProbeTest onto_the_floor(const Stripes& stripes) {
    MovementSettings settings = basic_settings();
    settings.keep_energy = false;
    return make_probe_test(stripes.scene(), settings, Vec3(0, 2, 12), Vec3(1, -3, 0.5));
}

TEST(ProbeTest, HoldsAfterBeingWrittenAndRead) {
    const Stripes stripes;
    ProbeTest made = onto_the_floor(stripes);
    made.level_name = "stripes.obj";
    made.level_fingerprint = 0x0123456789abcdefu;
    const Result<ProbeTest> read = parse_probe_test(probe_test_to_text(made), "a.probe");
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_EQ(read->settings, made.settings);
    EXPECT_EQ(read->from, made.from);
    EXPECT_EQ(read->end, made.end);
    EXPECT_EQ(read->level_name, "stripes.obj");
    EXPECT_EQ(read->level_fingerprint, made.level_fingerprint);
    ASSERT_GE(read->sweeps.size(), 2u);
    ASSERT_TRUE(read->sweeps[0].contact);
    EXPECT_EQ(read->sweeps[0].contact->face, 1u);
    EXPECT_EQ(read->sweeps[0].contact->feature, Feature::interior);
    EXPECT_EQ(run_probe_test(*read, stripes.scene()), std::vector<std::string>{});
    EXPECT_EQ(probe_test_to_text(*read), probe_test_to_text(made));
}

TEST(ProbeTest, SaysWhatDiffers) {
    const Stripes stripes;
    ProbeTest test = onto_the_floor(stripes);
    test.sweeps[0].contact->t += 1e-3;
    test.end.x() += 0.5;
    test.sweeps.pop_back();
    const std::vector<std::string> differences = run_probe_test(test, stripes.scene());
    ASSERT_EQ(differences.size(), 3u);
    EXPECT_THAT(differences[0], HasSubstr("sweep 1: found \"sweep "));
    EXPECT_THAT(differences[1], HasSubstr("expected \"none\""));
    EXPECT_THAT(differences[2], HasSubstr("end: found"));
    test = onto_the_floor(stripes);
    test.sweeps[0].contact->face = 7;
    EXPECT_EQ(run_probe_test(test, stripes.scene()).size(), 1u);
}

TEST(ProbeTest, BadTextIsRefusedWithItsLine) {
    const auto error = [](const char* text) {
        const Result<ProbeTest> test = parse_probe_test(text, "a.probe");
        return test ? std::string("fine") : test.error().text();
    };
    EXPECT_THAT(error(""), HasSubstr("a.probe:1"));
    EXPECT_THAT(error("slipface-tape 1\n"), HasSubstr("slipface-probe 1"));
    EXPECT_THAT(error("slipface-probe 1\nfrom 1,2\n"), HasSubstr("a.probe:2"));
    EXPECT_THAT(error("slipface-probe 1\nset gravity=up\n"), HasSubstr("a.probe:2"));
    EXPECT_THAT(error("slipface-probe 1\nsweep slide 0.5 face -1 triangle 2 edge 0,1,0\n"),
                HasSubstr("a.probe:2"));
    EXPECT_THAT(error("slipface-probe 1\nsweep slide 0.5 face 1 triangle 2 middle 0,1,0\n"),
                HasSubstr("a.probe:2"));
    EXPECT_THAT(error("slipface-probe 1\nfrom 1,2,3\nmove 1,2,3\n"),
                HasSubstr("expected slipface-probe 1, from, move"));
    EXPECT_THAT(error("slipface-probe 1\nhop\n"), HasSubstr("hop"));
}

}  // namespace
}  // namespace slipface::test

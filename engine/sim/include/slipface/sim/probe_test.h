// A sweep probe as a test in text form: an ellipsoid, a displacement, and the result of collide-and-slide.
//
//   slipface-probe 1
//   level easy.obj 1f2e3d4c5b6a7988      (name, mesh fingerprint; optional)
//   set max_slope=0.7                    (any number; over the defaults)
//   from 0,1,0
//   move 2,-0.1,0
//   tolerance 1e-06                      (for fractions of the move, normals and metres)
//   sweep horizontal 0.25 face 12 triangle 30 edge 0,1,0 slide
//   sweep horizontal free
//   end 1.9,1,0
#pragma once

#include "slipface/movement/step.h"

namespace slipface {

struct ProbeTest {
    struct Sweep {
        Pass pass = Pass::slide;
        std::optional<Contact> contact;  // only t, normal, triangle, face and feature are compared
        std::optional<Rule> rule;        // the rule that redirected the remainder
    };
    std::string level_name;
    std::optional<std::uint64_t> level_fingerprint;
    MovementSettings settings = basic_settings();
    Vec3 from = Vec3::Zero();
    Vec3 move = Vec3::Zero();
    double tolerance = 1e-6;
    std::vector<Sweep> sweeps;
    Vec3 end = Vec3::Zero();
};

// Runs the probe in `scene` and returns its result as a test, which passes in this scene.
ProbeTest make_probe_test(const MovementScene& scene, const MovementSettings& settings, const Vec3& from,
                          const Vec3& move);
// Runs the test. Returns one line per difference, with the sweep, the value found and the value expected;
// empty: the test passes.
std::vector<std::string> run_probe_test(const ProbeTest& test, const MovementScene& scene);

std::string probe_test_to_text(const ProbeTest& test);
// Errors name the line; `location` names the file in them.
Result<ProbeTest> parse_probe_test(std::string_view text, const std::string& location);

}  // namespace slipface

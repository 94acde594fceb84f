// A sweep probe as a test: an ellipsoid, a displacement, and what collide-and-slide made of it, as text.
//
//   slipface-probe 1
//   level easy.obj 1f2e3d4c5b6a7988      (name, mesh fingerprint; optional)
//   set max_slope=0.7                    (any number; over the defaults)
//   from 0,1,0
//   move 2,-0.1,0
//   tolerance 1e-06                      (of fractions of the move, normals and metres)
//   sweep horizontal 0.25 face 12 triangle 30 edge 0,1,0 slide
//   sweep horizontal free
//   end 1.9,1,0
#pragma once

#include "slipface/movement/step.h"

namespace slipface {

struct ProbeTest {
    struct Sweep {
        Pass pass = Pass::slide;
        std::optional<Contact> contact;  // t, normal, triangle, face and feature count
        std::optional<Rule> rule;        // what turned the remainder
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

// What the probe makes of the scene, as a test that holds.
ProbeTest make_probe_test(const MovementScene& scene, const MovementSettings& settings, const Vec3& from,
                          const Vec3& move);
// What differs now, a line each, naming the sweep, what was found and what was expected; empty: nothing.
std::vector<std::string> run_probe_test(const ProbeTest& test, const MovementScene& scene);

std::string probe_test_to_text(const ProbeTest& test);
// Errors name the line. `place` names the file in them.
Result<ProbeTest> parse_probe_test(std::string_view text, const std::string& location);

}  // namespace slipface

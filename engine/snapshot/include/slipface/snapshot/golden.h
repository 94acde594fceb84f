// Golden pictures: what was approved, what is rendered now, and whether the two are the same.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "slipface/image/compare.h"

namespace slipface {

enum class GoldenState { same, different, missing, unreadable, nondeterministic };

struct GoldenResult {
    std::string name;                 // "scenes/easy-overview"
    GoldenState state = GoldenState::missing;
    Comparison comparison;
    std::string message;              // one line, with numbers and the files written
};

// Compares `actual` with FOLDER/NAME.png. On a difference writes OUT/NAME.expected.png, .actual.png and .difference.png; where the
// golden is missing writes OUT/NAME.actual.png. Never writes into `folder`.
GoldenResult check_golden(const std::filesystem::path& folder, const std::string& name, const Image& actual,
                          const CompareTolerance& tolerance, const std::filesystem::path& out);

// Makes `actual` the golden, unless the gate says that it is the same already.
Status approve_golden(const std::filesystem::path& folder, const std::string& name, const Image& actual,
                      const CompareTolerance& tolerance);

// A picture that can be rendered by name. Suites are lists of these: scenes here, editor screens in the editor.
struct Snapshot {
    std::string name;
    CompareTolerance tolerance;
    std::function<Result<Image>()> render;
};

// Changes that the gate must notice, and noise that it must forgive, applied to a picture. Proves on the spot that the gate is alive.
struct SelfTestCase {
    std::string name;
    bool must_pass = false;
    Image picture;
};
std::vector<SelfTestCase> self_test_cases(const Image& picture);

}  // namespace slipface

// Golden pictures: what was approved, what is rendered now, and whether the two are the same.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/image/compare.h"

namespace slipface {

enum class GoldenState { same, different, missing, unreadable, nondeterministic };

// Whether `name` is a path below a folder in characters that every file system keeps apart: letters, digits,
// '-' and '_', with single '/' or '.' between them.
bool valid_snapshot_name(std::string_view name);

const char* golden_state_name(GoldenState state);

struct GoldenResult {
    std::string name;  // "scenes/easy-overview"
    GoldenState state = GoldenState::missing;
    Comparison comparison;
    std::string message;  // one line, with numbers and the files written
};

// Compares `actual` with FOLDER/NAME.png. On a difference writes OUT/NAME.expected.png, .actual.png and
// .difference.png; where the golden is missing writes OUT/NAME.actual.png. Never writes into `folder`.
GoldenResult check_golden(const std::filesystem::path& folder, const std::string& name, const Image& actual,
                          const CompareTolerance& tolerance, const std::filesystem::path& out);

// Makes `actual` the golden, unless the gate says that it is the same already.
Status approve_golden(const std::filesystem::path& folder, const std::string& name, const Image& actual,
                      const CompareTolerance& tolerance);

// A picture that can be rendered by name. Suites are lists of these: scenes here, editor screens in the
// editor.
struct Snapshot {
    std::string name;
    CompareTolerance tolerance;
    std::function<Result<Image>()> render;
};

// Renders `snapshot` (twice if asked for: unequal bytes make it nondeterministic) and checks it. The error is
// the renderer's.
Result<GoldenResult> check_snapshot(const Snapshot& snapshot, const std::filesystem::path& folder,
                                    const std::filesystem::path& out, bool render_twice = false);

// Names of the PNG files in `folder` that no snapshot makes, ascending.
std::vector<std::string> orphan_goldens(const std::filesystem::path& folder,
                                        const std::vector<Snapshot>& snapshots);

// Changes that the gate must notice, and noise that it must forgive, applied to a picture. Proves on the spot
// that the gate is alive.
struct SelfTestCase {
    std::string name;
    bool must_pass = false;
    Image picture;
};
// None for pictures below 16 x 16 pixels. The picture needs some detail: in a flat one nothing can be seen to
// move.
std::vector<SelfTestCase> self_test_cases(const Image& picture);

struct SelfTestReport {
    bool passed = true;
    std::vector<std::string> lines;  // one a case, with the numbers
};
SelfTestReport run_self_test(const Image& picture, const CompareTolerance& tolerance);

}  // namespace slipface

// Golden pictures: what was approved, what is rendered now, and whether the two are the same.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/image/compare.h"
#include "slipface/snapshot/numbers.h"

namespace slipface {

enum class GoldenState {
    same,
    different,         // the gate or the numbers say so
    missing,           // no NAME.png, or no NAME.json where there are numbers
    unreadable,        // a golden that is no picture, or numbers that are no JSON
    nondeterministic,  // two renderings in a row have different bytes
    failed,            // it could not be rendered
    orphan,            // a golden that no snapshot makes
};
inline constexpr std::size_t golden_state_count = 7;
const char* golden_state_name(GoldenState state);

// Whether `name` is a path below a folder in characters that every file system keeps apart: letters, digits,
// '-', '_' and '@', with single '/' or '.' between them. Names ending in ".altN" are those of alternates.
bool valid_snapshot_name(std::string_view name);

// What a snapshot gives: a picture and the numbers behind it (JSON, see docs/snapshots.md; may be empty).
struct Rendering {
    Image image;
    std::string numbers;
};

// One reason for a difference, in words: "3 faces of `roof` changed ice to default".
struct Finding {
    Cause cause = Cause::renderer;
    std::size_t pixels = 0;  // changed pixels that it explains; 0: numbers only
    std::string text;
};

// What explain() is asked about. Pictures are masked and of equal size.
struct ExplainRequest {
    const Image& expected;
    const Rendering& actual;
    const std::string& expected_numbers;
    const std::vector<NumberDifference>& numbers;
    std::filesystem::path goldens;  // the folder, for attachments
    CompareTolerance tolerance;
};

// A file that goldens share, such as a level's digest.
struct Attachment {
    std::string path;  // below the goldens' folder
    std::string bytes;
};

// A picture that can be rendered by name. Suites are lists of these: scenes here, editor screens in the
// editor.
struct Snapshot {
    std::string name;
    CompareTolerance tolerance;
    std::function<Result<Rendering>()> render;
    std::vector<MaskRect> masks = {};
    std::function<std::vector<Finding>(const ExplainRequest&)> explain = {};  // may be empty
    std::function<Result<Attachment>()> attachment = {};                      // may be empty
};

struct GoldenResult {
    std::string name;  // "scenes/easy-overview"
    GoldenState state = GoldenState::missing;
    Comparison comparison;
    std::vector<NumberDifference> numbers;
    std::vector<Finding> findings;  // most pixels first
    std::array<SweepRow, 8> sweep{};
    std::string matched;  // the alternate that fits, "NAME.alt1"; empty: the golden itself
    std::string message;  // one line, with numbers and the files written
    double seconds = 0.0, drawing_s = 0.0;
};

// Compares `actual` with FOLDER/NAME.png, then with its alternates NAME.alt1.png to NAME.alt9.png, and its
// numbers with NAME.json. On a difference writes OUT/NAME.expected.png, .actual.png, .actual.json and
// .difference.png; where the golden is missing or unreadable writes the actual ones. Never writes into
// `folder`.
GoldenResult check_golden(const std::filesystem::path& folder, const Snapshot& snapshot,
                          const Rendering& actual, const std::filesystem::path& out);

// Renders `snapshot` (twice if asked for: unequal bytes make it nondeterministic) and checks it.
GoldenResult check_snapshot(const Snapshot& snapshot, const std::filesystem::path& folder,
                            const std::filesystem::path& out, bool render_twice = false);

struct ApproveOptions {
    bool force = false;  // rewrite what passes, too
    bool packed = true;  // take the time to pack the picture well
};
// Makes `actual` the golden: picture, numbers and attachment. What the gate calls the same is left alone.
// Returns the files that were written, below `folder`.
Result<std::vector<std::string>> approve_golden(const std::filesystem::path& folder, const Snapshot& snapshot,
                                                const Rendering& actual, const ApproveOptions& options = {});

// Names of the PNG files in `folder` that no snapshot makes, ascending; alternates belong to their golden.
// Folders whose name begins with '.' are left out.
std::vector<std::string> orphan_goldens(const std::filesystem::path& folder,
                                        const std::vector<std::string>& names);

// Attachments in FOLDER/levels that no golden's numbers name, ascending, below `folder`.
std::vector<std::string> unused_attachments(const std::filesystem::path& folder);

// Changes that the gate must notice, and noise that it must forgive, applied to a picture. Proves on the spot
// that the gate is alive.
struct SelfTestCase {
    std::string name;
    bool must_pass = false;
    Image image;
};
// None for pictures below 16 x 16 pixels. The picture needs some detail: in a flat one nothing can be seen to
// move.
std::vector<SelfTestCase> self_test_cases(const Image& image);

struct SelfTestReport {
    bool passed = true;
    std::vector<std::string> lines;  // one a case, with the numbers
};
SelfTestReport run_self_test(const Image& image, const CompareTolerance& tolerance);

}  // namespace slipface

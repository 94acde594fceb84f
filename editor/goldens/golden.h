// Golden images: compares approved renderings with new ones.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "goldens/coverage.h"
#include "goldens/numbers.h"
#include "slipface/image/compare.h"

namespace slipface {

enum class GoldenState {
    same,
    different,         // by the gate or by the numbers
    missing,           // no NAME.png, or no NAME.json where there are numbers
    unreadable,        // a golden that is no image, or numbers that are no JSON
    nondeterministic,  // two renderings in a row differ
    failed,            // rendering failed
    orphan,            // a golden without a snapshot
};
inline constexpr std::size_t golden_state_count = 7;
const char* golden_state_name(GoldenState state);

// Whether `name` is a valid snapshot name, a path below a folder: letters, digits, '-', '_' and '@', with
// single '/' or '.' between them; at most 200 characters. Names ending in ".altN" are those of alternates.
bool valid_snapshot_name(std::string_view name);

// The output of a snapshot: an image and the numbers behind it (JSON, see docs/snapshots.md; may be empty).
struct Rendering {
    Image image;
    std::string numbers;
};

// One cause of a difference, or what follows from one, in words: "3 faces of `roof` changed ice to default".
struct Finding {
    Cause cause = Cause::renderer;
    std::size_t pixels = 0;  // number of changed pixels that it explains; 0: none, or numbers only
    std::string text;
    bool act = false;  // somebody did it, or the program; false: it follows, and says what was seen
};

// What a snapshot is made from: a level, a tape. Its facts (JSON, goldens/level_facts.h) are by meaning;
// `bytes` is a hash of its files, empty where there are none.
struct Input {
    std::string facts, bytes;
};

// An image that can be rendered by name. Suites are lists of these: scenes in this module, screens in the
// editor. An input is a snapshot without an image, whose numbers are its facts: inputs/levels/easy.
struct Snapshot {
    std::string name;
    CompareTolerance tolerance;
    std::function<Result<Rendering>()> render;
    std::vector<MaskRect> masks = {};
    CoarseTolerance elsewhere = {};        // where other releases of the drawing libraries drew the golden
    std::vector<std::string> inputs = {};  // names of the snapshots that are its inputs
    std::function<Result<Input>(const std::string& name)> input = {};  // as they are now; may be empty
};

inline constexpr std::string_view input_folder = "inputs/";
inline bool is_input(std::string_view name) {
    return name.starts_with(input_folder);
}

struct GoldenResult {
    std::string name;  // "scenes/easy-overview"
    GoldenState state = GoldenState::missing;
    Comparison comparison;
    std::vector<NumberDifference> numbers;
    std::vector<Finding> findings;    // acts before what follows from them
    std::array<SweepRow, 8> sweep{};  // differing pixels at other thresholds
    // What matches instead of the golden: the alternate "NAME.alt1", the drawer's own "renderers/.../NAME",
    // or the golden of another drawer, coarsely. Empty: none was needed or none matches.
    std::string matched;
    std::string message;                    // one line, with numbers and the files written
    double seconds = 0.0, drawing_s = 0.0;  // whole check; drawing alone
    std::vector<std::string> history;  // its last commits, newest first: "1a2b3c4 2026-11-29 Raise the roof"
    Coverage coverage;                 // what no entry before it in its process had
};

// Compares `actual` with FOLDER/NAME.png, then with the alternates NAME.alt1.png to NAME.alt9.png, and its
// numbers with NAME.json. Where other libraries drew the golden (drawn_by), then with what was approved for
// those that drew `actual`, or if there is nothing, with the golden coarsely. If they differ, writes
// OUT/NAME.expected.png, .actual.png, .actual.json and .difference.png; if the golden is missing or
// unreadable, only the actual files. Never writes into `folder`.
GoldenResult check_golden(const std::filesystem::path& folder, const Snapshot& snapshot,
                          const Rendering& actual, const std::filesystem::path& out);

// Renders `snapshot` and checks it. With `render_twice`, two renderings that differ in any byte make it
// nondeterministic. What is not the same is rendered a second time in any case, so that nobody reviews or
// approves an image that differs from run to run.
GoldenResult check_snapshot(const Snapshot& snapshot, const std::filesystem::path& folder,
                            const std::filesystem::path& out, bool render_twice = false);

// What differs between two renderings of one snapshot outside its masks; empty: nothing.
std::string what_repeats_otherwise(const Snapshot& snapshot, const Rendering& first, const Rendering& second);

struct ApproveOptions {
    bool force = false;  // also rewrite goldens that match
    bool packed = true;  // spend more time for a smaller PNG
    bool here = false;   // where other libraries drew the golden, leave it, and write one for these
};
// Makes `actual` the golden: image and numbers. An image that passes is not rewritten, nor are equal numbers.
// Returns the paths of the written files, relative to `folder`.
Result<std::vector<std::string>> approve_golden(const std::filesystem::path& folder, const Snapshot& snapshot,
                                                const Rendering& actual, const ApproveOptions& options = {});

// Names of the PNG files below `folder`, and of the facts below its inputs, that are neither one of `names`
// nor an alternate of one, ascending. Folders whose name begins with '.' are skipped. A golden of one drawer
// is that of its name.
std::vector<std::string> orphan_goldens(const std::filesystem::path& folder,
                                        const std::vector<std::string>& names);

// Whether a golden below `folder` was approved with this mark of the input: the bytes of its files, and the
// facts that they were read as.
bool bytes_were_approved(const std::filesystem::path& folder, const std::string& input,
                         const std::string& mark);

// An image with a change that the gate must detect, or with noise that it must accept. These cases prove that
// the gate works.
struct SelfTestCase {
    std::string name;
    bool must_pass = false;
    Image image;
};
// None for images below 16 x 16 pixels. The image needs some detail: in a flat one no motion is visible.
std::vector<SelfTestCase> self_test_cases(const Image& image);

struct SelfTestReport {
    bool passed = true;
    std::vector<std::string> lines;  // one per case, with the measured values
};
SelfTestReport run_self_test(const Image& image, const CompareTolerance& tolerance);

}  // namespace slipface

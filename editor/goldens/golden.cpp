#include "goldens/golden.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <string_view>

#include "goldens/acts.h"
#include "goldens/drawer.h"
#include "goldens/explain.h"
#include "goldens/numbers_json.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

fs::path png_path(const fs::path& folder, const std::string& name, const char* ending) {
    return folder / (name + ending);
}

Status create_folder_of(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) return Error{path.parent_path().string(), "cannot create the folder: " + error.message()};
    return {};
}

Status write_image_file(const fs::path& path, const Image& image, PngEffort effort = PngEffort::fast) {
    if (Status status = create_folder_of(path); !status) return status;
    return save_png(path, image, effort);
}

// Git LFS leaves a small text file instead of an image that was not fetched.
bool is_lfs_pointer(const fs::path& path) {
    const Result<std::string> bytes = read_file(path);
    return bytes && bytes->starts_with("version https://git-lfs");
}

Result<Image> load_golden(const fs::path& path) {
    if (is_lfs_pointer(path)) {
        return Error{path.string(), "found a Git LFS pointer, expected a PNG; run `git lfs pull`"};
    }
    return load_image(path);
}

// Appends the path of the written file, or the error, to `message`.
void write_and_report(const fs::path& path, const Image& image, std::string& message) {
    const Status status = write_image_file(path, image);
    message += status ? fmt::format("; wrote {}", path.string()) : fmt::format("; {}", status.error().text());
}

constexpr int max_alternates = 9;

constexpr std::uint64_t largest_numbers = std::uint64_t{256} << 20U;

const char* const name_rule = "expected letters, digits, '-', '_', '@' and '/'";

bool on_disk(const fs::path& path) {
    std::error_code error;
    return fs::exists(fs::symlink_status(path, error));
}

// Removes the files of an earlier check, which would look like this check's.
void forget_images(const fs::path& out, const std::string& name) {
    if (!valid_snapshot_name(name)) return;
    for (const char* ending :
         {".expected.png", ".actual.png", ".difference.png", ".first.png", ".second.png", ".actual.json"}) {
        std::error_code error;
        fs::remove(png_path(out, name, ending), error);
    }
}

struct Pair {
    const Snapshot& snapshot;
    const Rendering& actual;
    const fs::path& folder;
    const fs::path& out;
};

void write_actual(const Pair& pair, std::string& message) {
    if (!is_input(pair.snapshot.name))
        write_and_report(png_path(pair.out, pair.snapshot.name, ".actual.png"), pair.actual.image, message);
    if (pair.actual.numbers.empty()) return;
    const fs::path path = png_path(pair.out, pair.snapshot.name, ".actual.json");
    Status status = create_folder_of(path);
    if (status) status = write_file_atomic(path, pair.actual.numbers);
    if (!status) message += "; " + status.error().text();
}

GoldenResult without_golden(const Pair& pair, GoldenState state, const std::string& why) {
    GoldenResult result;
    result.name = pair.snapshot.name;
    result.state = state;
    result.message = why;
    write_actual(pair, result.message);
    return result;
}

fs::path own_golden(const fs::path& folder, const std::string& name, const std::string& drawer) {
    return png_path(folder / drawers_folder(drawer), name, ".png");
}

// Compares with the golden, then with its alternates until the gate calls one the same, then with what other
// libraries need.
void compare_image_files(const Pair& pair, const Image& golden, const std::string& golden_numbers,
                         GoldenResult& result) {
    const Snapshot& snapshot = pair.snapshot;
    const auto compare = [&](const Image& expected) {
        const Image& actual = pair.actual.image;
        return snapshot.masks.empty()
                   ? compare_images(expected, actual, snapshot.tolerance)
                   : compare_images(expected, masked(expected, actual, snapshot.masks), snapshot.tolerance);
    };
    result.comparison = compare(golden);
    for (int i = 1; i <= max_alternates && !result.comparison.same; ++i) {
        const std::string name = fmt::format("{}.alt{}", snapshot.name, i);
        const fs::path path = png_path(pair.folder, name, ".png");
        if (!on_disk(path)) break;
        const Result<Image> alternate = load_golden(path);
        if (!alternate) continue;
        const Comparison comparison = compare(*alternate);
        if (!comparison.same) continue;
        result.comparison = comparison;
        result.matched = name;
    }
    const std::string drawer = drawn_by(pair.actual.numbers), other = drawn_by(golden_numbers);
    if (result.comparison.same || drawer.empty() || drawer == other) return;
    const fs::path own = own_golden(pair.folder, snapshot.name, drawer);
    if (on_disk(own)) {
        const Result<Image> image = load_golden(own);
        if (!image) return;
        result.comparison = compare(*image);
        result.matched = own.lexically_relative(pair.folder).replace_extension().generic_string();
        return;
    }
    result.comparison =
        compare_coarsely(golden, masked(golden, pair.actual.image, snapshot.masks), snapshot.elsewhere);
    result.matched = fmt::format("the golden, drawn by {}, coarsely", other);
    // A widget that is there on one side only is no matter of pixels, unless the image's lower border cuts
    // it.
    for (NumberDifference& number : result.numbers) {
        const bool gone = number.actual == "nothing";
        if (number.cause != Cause::ui || (!gone && number.expected != "nothing")) continue;
        const Numbers place = Numbers::parse(gone ? number.expected : number.actual, nullptr, false);
        const bool cut = place.is_array() && place.size() == 4 && place[1].is_number_integer() &&
                         place[3].is_number_integer() &&
                         place[1].get<int>() + place[3].get<int>() > golden.height;
        number.decides = !cut;
    }
}

// The snapshot's inputs as they were approved and as they are.
std::vector<InputPair> input_pairs(const Pair& pair, const std::string& golden_numbers) {
    std::vector<InputPair> pairs;
    const Numbers golden =
        golden_numbers.empty() ? Numbers() : Numbers::parse(golden_numbers, nullptr, false);
    const Numbers& approved = member_of(golden, "inputs");
    for (const std::string& name : pair.snapshot.inputs) {
        InputPair& input = pairs.emplace_back(InputPair{name, "", "", false});
        const Result<std::string> before = read_file(png_path(pair.folder, name, ".json"), largest_numbers);
        if (before) input.before = *before;
        const Result<Input> now = pair.snapshot.input ? pair.snapshot.input(name) : Error{name, "unknown"};
        if (!now) continue;
        input.after = now->facts;
        const Numbers& bytes = member_of(approved, name);
        input.same_bytes = !now->bytes.empty() && bytes == input_mark(input.before, now->bytes);
    }
    return pairs;
}

std::string pixels_hash(const Image& image) {
    return hex_text(hash_blocks(image.rgba.data(), image.rgba.size()));
}

// Whether nothing is forgiven where the inputs are the same: the same renderer drew both, and the golden is
// the image that its numbers were written with, not one that fitted them.
bool exact_gate(const Image& golden, const std::string& golden_numbers, const std::string& actual_numbers) {
    if (golden_numbers.empty() || actual_numbers.empty()) return false;
    const Numbers was = Numbers::parse(golden_numbers, nullptr, false),
                  is = Numbers::parse(actual_numbers, nullptr, false);
    const Numbers& renderer = member_of(was, "renderer");
    return !renderer.is_null() && renderer == member_of(is, "renderer") &&
           member_of(was, "pixels") == pixels_hash(golden);
}

// Facts of an input: a snapshot without an image.
GoldenResult check_input(const Pair& pair) {
    const fs::path path = png_path(pair.folder, pair.snapshot.name, ".json");
    const Result<std::string> before = read_file(path, largest_numbers);
    if (!on_disk(path))
        return without_golden(pair, GoldenState::missing, path.string() + ": not approved yet");
    if (!before) return without_golden(pair, GoldenState::unreadable, before.error().text());
    const auto numbers = compare_numbers(*before, pair.actual.numbers, path.string());
    if (!numbers) return without_golden(pair, GoldenState::unreadable, numbers.error().text());
    GoldenResult result;
    result.name = pair.snapshot.name;
    InputPair input{result.name, *before, pair.actual.numbers, false};
    if (const Result<Input> now = pair.snapshot.input ? pair.snapshot.input(result.name) : Error{};
        now && any_decides(*numbers))
        input.same_bytes = !now->bytes.empty() &&
                           bytes_were_approved(pair.folder, result.name, input_mark(*before, now->bytes));
    result.findings = explain_input(input);
    // Where packed bytes or an order differ, nothing is red.
    result.state = any_decides(*numbers) ? GoldenState::different : GoldenState::same;
    if (result.state == GoldenState::same) {
        if (!result.findings.empty()) result.matched = result.findings.front().text;
        result.findings.clear();
        result.message = result.matched;
        return result;
    }
    if (result.findings.empty())
        result.findings.push_back({Cause::level, 0, fmt::format("{} changed", result.name), true});
    result.message = result.findings.front().text;
    write_actual(pair, result.message);
    return result;
}

std::string difference_message(const GoldenResult& result, const fs::path& golden_path) {
    std::string message = golden_path.string() + ": " + result.comparison.verdict;
    for (const NumberDifference& number : result.numbers) {
        if (!number.decides) continue;
        message += fmt::format("; {} was {}, is {}", number.path, number.expected, number.actual);
        break;
    }
    return message;
}

}  // namespace

bool valid_snapshot_name(std::string_view name) {
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
               c == '_' || c == '@';
    };
    bool after_separator = true;
    for (const char c : name) {
        if (c == '/' || c == '.') {
            if (after_separator) return false;
            after_separator = true;
        } else if (plain(c)) {
            after_separator = false;
        } else {
            return false;
        }
    }
    return !after_separator && name.size() <= 200;
}

const char* golden_state_name(GoldenState state) {
    constexpr std::array<const char*, golden_state_count> names{
        "same", "different", "missing", "unreadable", "nondeterministic", "failed", "orphan"};
    return names[static_cast<std::size_t>(state)];
}

GoldenResult check_golden(const fs::path& folder, const Snapshot& snapshot, const Rendering& actual,
                          const fs::path& out) {
    const Pair pair{snapshot, actual, folder, out};
    if (!valid_snapshot_name(snapshot.name)) {
        GoldenResult result;
        result.name = snapshot.name;
        result.state = GoldenState::unreadable;
        result.message = fmt::format("found the snapshot name \"{}\", {}", snapshot.name, name_rule);
        return result;
    }
    if (is_input(snapshot.name)) return check_input(pair);
    const fs::path golden_path = png_path(folder, snapshot.name, ".png");
    const fs::path numbers_path = png_path(folder, snapshot.name, ".json");
    if (!on_disk(golden_path))
        return without_golden(pair, GoldenState::missing, golden_path.string() + ": no golden");
    const Result<Image> golden = load_golden(golden_path);
    if (!golden) return without_golden(pair, GoldenState::unreadable, golden.error().text());
    std::string golden_numbers;
    if (!actual.numbers.empty()) {
        if (!on_disk(numbers_path))
            return without_golden(pair, GoldenState::missing, numbers_path.string() + ": no numbers");
        const Result<std::string> text = read_file(numbers_path, largest_numbers);
        if (!text) return without_golden(pair, GoldenState::unreadable, text.error().text());
        golden_numbers = *text;
    }
    const auto numbers = compare_numbers(golden_numbers, actual.numbers, numbers_path.string());
    if (!numbers) return without_golden(pair, GoldenState::unreadable, numbers.error().text());

    GoldenResult result;
    result.name = snapshot.name;
    result.numbers = *numbers;
    std::erase_if(result.numbers, [](const NumberDifference& number) { return number.path == "/pixels"; });
    compare_image_files(pair, *golden, golden_numbers, result);
    const bool passes = result.comparison.same && !any_decides(result.numbers);
    const bool identical = result.comparison.max_delta == 0 || !result.matched.empty();
    const auto same = [&] {
        result.findings.clear();
        result.state = GoldenState::same;
        result.message = result.matched.empty()
                             ? difference_message(result, golden_path)
                             : fmt::format("{} matches; the golden itself does not", result.matched);
        return result;
    };
    if (passes && identical) return same();
    const Rendering seen{masked(*golden, actual.image, snapshot.masks), actual.numbers};
    const std::vector<InputPair> inputs = input_pairs(pair, golden_numbers);
    result.findings = explain({*golden, seen, golden_numbers, result.numbers, inputs, snapshot.tolerance});
    // What the same renderer drew from the same inputs are the same pixels.
    const bool exact = result.findings.front().cause == Cause::program &&
                       exact_gate(*golden, golden_numbers, actual.numbers);
    if (passes && !exact) return same();
    if (passes) result.comparison.verdict += "; the same renderer draws the same inputs with the same pixels";
    result.comparison.same = false;
    result.state = GoldenState::different;
    result.matched.clear();
    result.sweep = threshold_sweep(*golden, seen.image);
    result.message = result.findings.front().text + "; " + difference_message(result, golden_path);
    write_and_report(png_path(out, snapshot.name, ".expected.png"), *golden, result.message);
    write_actual(pair, result.message);
    write_and_report(png_path(out, snapshot.name, ".difference.png"), difference_image(*golden, seen.image),
                     result.message);
    return result;
}

Result<std::vector<std::string>> approve_golden(const fs::path& folder, const Snapshot& snapshot,
                                                const Rendering& actual, const ApproveOptions& options) {
    if (!valid_snapshot_name(snapshot.name))
        return Error{"snapshot name", fmt::format("found \"{}\", {}", snapshot.name, name_rule)};
    std::vector<std::string> written;
    const fs::path numbers_path = png_path(folder, snapshot.name, ".json");
    const Result<std::string> before = read_file(numbers_path, largest_numbers);
    const auto write_numbers = [&]() -> Status {
        if (Status status = create_folder_of(numbers_path); !status) return status;
        written.push_back(snapshot.name + ".json");
        Numbers numbers = Numbers::parse(actual.numbers, nullptr, false);
        if (is_input(snapshot.name) || !numbers.is_object())
            return write_file_atomic(numbers_path, actual.numbers);
        numbers["pixels"] = pixels_hash(actual.image);
        return write_file_atomic(numbers_path, numbers_text(numbers));
    };
    const auto differences = before ? compare_numbers(*before, actual.numbers, "")
                                    : Result<std::vector<NumberDifference>>(before.error());
    if (is_input(snapshot.name)) {
        const bool same =
            differences && std::all_of(differences->begin(), differences->end(),
                                       [](const auto& one) { return one.path.ends_with("/packed"); });
        if (same && !options.force) return written;
        if (Status status = write_numbers(); !status) return status.error();
        return written;
    }
    const fs::path path = png_path(folder, snapshot.name, ".png");
    const Result<Image> golden = load_golden(path);
    const auto fits_to = [&](const Result<Image>& image) {
        return image &&
               compare_images(*image, masked(*image, actual.image, snapshot.masks), snapshot.tolerance).same;
    };
    const PngEffort effort = options.packed ? PngEffort::small : PngEffort::fast;
    if (options.here && golden) {
        const std::string drawer = drawn_by(actual.numbers);
        if (before && !drawer.empty() && drawer != drawn_by(*before)) {
            const fs::path own = own_golden(folder, snapshot.name, drawer);
            if ((fits_to(golden) || fits_to(load_golden(own))) && !options.force) return written;
            if (Status status = write_image_file(own, actual.image, effort); !status) return status.error();
            written.push_back(own.lexically_relative(folder).generic_string());
            return written;
        }
    }
    const bool same_pixels = golden && masked(*golden, actual.image, snapshot.masks) == *golden;
    const bool exact = golden && before && exact_gate(*golden, *before, actual.numbers);
    if ((exact ? !same_pixels : !fits_to(golden)) || options.force) {
        if (Status status = write_image_file(path, actual.image, effort); !status) return status.error();
        written.push_back(snapshot.name + ".png");
    }
    if (actual.numbers.empty()) return written;
    if (!differences || any_decides(*differences) || !written.empty())
        if (Status status = write_numbers(); !status) return status.error();
    return written;
}

std::string what_repeats_otherwise(const Snapshot& snapshot, const Rendering& first,
                                   const Rendering& second) {
    const Image again = masked(first.image, second.image, snapshot.masks);
    const auto numbers = compare_numbers(first.numbers, second.numbers, "");
    const bool same_numbers = first.numbers == second.numbers || !numbers || numbers->empty();
    if (first.image == again && same_numbers) return "";
    const Comparison comparison = compare_images(first.image, again, snapshot.tolerance);
    const std::vector<NumberDifference> none;
    const std::string where = first.image.width != again.width || first.image.height != again.height
                                  ? comparison.verdict
                                  : explain({first.image,
                                             {again, second.numbers},
                                             first.numbers,
                                             numbers ? *numbers : none,
                                             {},
                                             snapshot.tolerance})
                                        .front()
                                        .text;
    return fmt::format(
        "two renderings in a row differ: {}{}",
        first.image != again ? comparison.verdict : "the same image, other numbers",
        where.find(": ") == std::string::npos ? "" : "; " + where.substr(where.find(": ") + 2));
}

GoldenResult check_snapshot(const Snapshot& snapshot, const fs::path& folder, const fs::path& out,
                            bool render_twice) {
    const auto start = std::chrono::steady_clock::now();
    const auto timed = [&](GoldenResult result) {
        result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return result;
    };
    GoldenResult result;
    result.name = snapshot.name;
    const auto failed = [&](const Error& error) {
        result.state = GoldenState::failed;
        result.message = error.text();
        return timed(result);
    };
    forget_images(out, snapshot.name);
    const Result<Rendering> first = snapshot.render();
    if (!first) return failed(first.error());
    GoldenResult checked = check_golden(folder, snapshot, *first, out);
    if (is_input(snapshot.name) || (checked.state == GoldenState::same && !render_twice))
        return timed(std::move(checked));
    const Result<Rendering> second = snapshot.render();
    if (!second) return failed(second.error());
    const std::string unstable = what_repeats_otherwise(snapshot, *first, *second);
    if (unstable.empty()) return timed(std::move(checked));
    forget_images(out, snapshot.name);
    result.state = GoldenState::nondeterministic;
    result.comparison = compare_images(first->image, second->image, snapshot.tolerance);
    result.message = unstable;
    result.findings.push_back({Cause::program, result.comparison.differing, unstable, true});
    if (valid_snapshot_name(snapshot.name)) {
        write_and_report(png_path(out, snapshot.name, ".first.png"), first->image, result.message);
        write_and_report(png_path(out, snapshot.name, ".second.png"), second->image, result.message);
    }
    return timed(std::move(result));
}

}  // namespace slipface

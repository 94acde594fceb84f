#include "goldens/golden.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <string_view>

#include "goldens/drawer.h"
#include "goldens/numbers_json.h"
#include "slipface/base/files.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

fs::path png_path(const fs::path& folder, const std::string& name, const char* ending) {
    return folder / (name + ending);
}

Status write_image_file(const fs::path& path, const Image& image, PngEffort effort = PngEffort::fast) {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) return Error{path.parent_path().string(), "cannot create the folder: " + error.message()};
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
    write_and_report(png_path(pair.out, pair.snapshot.name, ".actual.png"), pair.actual.image, message);
    if (pair.actual.numbers.empty()) return;
    const fs::path path = png_path(pair.out, pair.snapshot.name, ".actual.json");
    if (Status status = write_file_atomic(path, pair.actual.numbers); !status)
        message += "; " + status.error().text();
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
    // A widget that is there on one side only is no matter of pixels.
    for (NumberDifference& number : result.numbers)
        if (number.cause == Cause::ui && (number.expected == "nothing" || number.actual == "nothing"))
            number.decides = true;
}

void explain_difference(const Pair& pair, const Image& golden, const std::string& golden_numbers,
                        GoldenResult& result) {
    const Image& actual = pair.actual.image;
    if (golden.width != actual.width || golden.height != actual.height) {
        result.findings.push_back({Cause::view, 0, result.comparison.verdict});
        return;
    }
    const Rendering seen{masked(golden, actual, pair.snapshot.masks), pair.actual.numbers};
    result.sweep = threshold_sweep(golden, seen.image);
    if (!pair.snapshot.explain) return;
    result.findings = pair.snapshot.explain(
        {golden, seen, golden_numbers, result.numbers, pair.folder, pair.snapshot.tolerance});
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
        const Result<std::string> text = read_file(numbers_path, std::uint64_t{64} << 20U);
        if (!text) return without_golden(pair, GoldenState::unreadable, text.error().text());
        golden_numbers = *text;
    }
    const auto numbers = compare_numbers(golden_numbers, actual.numbers, numbers_path.string());
    if (!numbers) return without_golden(pair, GoldenState::unreadable, numbers.error().text());

    GoldenResult result;
    result.name = snapshot.name;
    result.numbers = *numbers;
    compare_image_files(pair, *golden, golden_numbers, result);
    const bool same = result.comparison.same && !any_decides(result.numbers);
    result.state = same ? GoldenState::same : GoldenState::different;
    result.message = difference_message(result, golden_path);
    if (same && !result.matched.empty())
        result.message = fmt::format("{} matches; the golden itself does not", result.matched);
    if (same) return result;
    result.matched.clear();
    explain_difference(pair, *golden, golden_numbers, result);
    if (!result.findings.empty()) result.message += "; " + result.findings.front().text;
    write_and_report(png_path(out, snapshot.name, ".expected.png"), *golden, result.message);
    write_actual(pair, result.message);
    write_and_report(png_path(out, snapshot.name, ".difference.png"),
                     difference_image(*golden, masked(*golden, actual.image, snapshot.masks)),
                     result.message);
    return result;
}

Result<std::vector<std::string>> approve_golden(const fs::path& folder, const Snapshot& snapshot,
                                                const Rendering& actual, const ApproveOptions& options) {
    if (!valid_snapshot_name(snapshot.name))
        return Error{"snapshot name", fmt::format("found \"{}\", {}", snapshot.name, name_rule)};
    std::vector<std::string> written;
    const fs::path path = png_path(folder, snapshot.name, ".png");
    const Result<Image> golden = load_golden(path);
    const bool fits =
        golden &&
        compare_images(*golden, masked(*golden, actual.image, snapshot.masks), snapshot.tolerance).same;
    if (options.here && golden) {
        const Result<std::string> numbers = read_file(png_path(folder, snapshot.name, ".json"));
        const std::string drawer = drawn_by(actual.numbers);
        if (numbers && !drawer.empty() && drawer != drawn_by(*numbers)) {
            if (fits && !options.force) return written;
            const fs::path own = own_golden(folder, snapshot.name, drawer);
            const Result<Image> before = load_golden(own);
            if (before && !options.force &&
                compare_images(*before, masked(*before, actual.image, snapshot.masks), snapshot.tolerance)
                    .same)
                return written;
            if (Status status =
                    write_image_file(own, actual.image, options.packed ? PngEffort::small : PngEffort::fast);
                !status)
                return status.error();
            written.push_back(own.lexically_relative(folder).generic_string());
            return written;
        }
    }
    if (!fits || options.force) {
        const PngEffort effort = options.packed ? PngEffort::small : PngEffort::fast;
        if (Status status = write_image_file(path, actual.image, effort); !status) return status.error();
        written.push_back(snapshot.name + ".png");
    }
    if (actual.numbers.empty()) return written;
    const fs::path numbers_path = png_path(folder, snapshot.name, ".json");
    const Result<std::string> before = read_file(numbers_path);
    const auto differences = before ? compare_numbers(*before, actual.numbers, "") : before.error();
    if (!differences || any_decides(*differences) || !written.empty()) {
        if (Status status = write_file_atomic(numbers_path, actual.numbers); !status) return status.error();
        written.push_back(snapshot.name + ".json");
    }
    if (!snapshot.attachment || written.empty()) return written;
    const Result<Attachment> attachment = snapshot.attachment();
    if (!attachment) return attachment.error();
    if (attachment->path.empty() || on_disk(folder / attachment->path)) return written;
    std::error_code error;
    fs::create_directories((folder / attachment->path).parent_path(), error);
    if (Status status = write_file_atomic(folder / attachment->path, attachment->bytes); !status)
        return status.error();
    written.push_back(attachment->path);
    return written;
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
    if (render_twice) {
        const Result<Rendering> second = snapshot.render();
        if (!second) return failed(second.error());
        if (first->image != second->image || first->numbers != second->numbers) {
            result.state = GoldenState::nondeterministic;
            result.comparison = compare_images(first->image, second->image, snapshot.tolerance);
            result.message = fmt::format(
                "{}: two renderings in a row differ: {}", snapshot.name,
                first->image != second->image ? result.comparison.verdict : "the same image, other numbers");
            if (valid_snapshot_name(snapshot.name)) {
                write_and_report(png_path(out, snapshot.name, ".first.png"), first->image, result.message);
                write_and_report(png_path(out, snapshot.name, ".second.png"), second->image, result.message);
            }
            return timed(result);
        }
    }
    return timed(check_golden(folder, snapshot, *first, out));
}

}  // namespace slipface

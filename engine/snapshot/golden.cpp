#include "slipface/snapshot/golden.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "slipface/base/files.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

fs::path png_path(const fs::path& folder, const std::string& name, const char* ending) {
    return folder / (name + ending);
}

Status write_picture(const fs::path& path, const Image& image) {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) return Error{path.parent_path().string(), "cannot make the folder: " + error.message()};
    return save_png(path, image);
}

// Git LFS leaves a small text in the place of a picture that was not fetched.
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

// Appends what was written, or why it could not be.
void write_and_tell(const fs::path& path, const Image& image, std::string& message) {
    const Status status = write_picture(path, image);
    message += status ? fmt::format("; wrote {}", path.string()) : fmt::format("; {}", status.error().text());
}

}  // namespace

bool valid_snapshot_name(std::string_view name) {
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
               c == '_';
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
    switch (state) {
        case GoldenState::same:
            return "same";
        case GoldenState::different:
            return "different";
        case GoldenState::missing:
            return "missing";
        case GoldenState::unreadable:
            return "unreadable";
        case GoldenState::nondeterministic:
            return "nondeterministic";
    }
    return "unknown";
}

GoldenResult check_golden(const fs::path& folder, const std::string& name, const Image& actual,
                          const CompareTolerance& tolerance, const fs::path& out) {
    GoldenResult result;
    result.name = name;
    if (!valid_snapshot_name(name)) {
        result.state = GoldenState::unreadable;
        result.message =
            fmt::format("found the snapshot name \"{}\", expected letters, digits, '-', '_' and '/'", name);
        return result;
    }
    const fs::path golden_path = png_path(folder, name, ".png");
    std::error_code error;
    if (!fs::exists(fs::symlink_status(golden_path, error))) {
        result.state = GoldenState::missing;
        result.message = fmt::format("{}: no golden", golden_path.string());
        write_and_tell(png_path(out, name, ".actual.png"), actual, result.message);
        return result;
    }
    const Result<Image> golden = load_golden(golden_path);
    if (!golden) {
        result.state = GoldenState::unreadable;
        result.message = golden.error().text();
        write_and_tell(png_path(out, name, ".actual.png"), actual, result.message);
        return result;
    }
    result.comparison = compare_images(*golden, actual, tolerance);
    result.state = result.comparison.same ? GoldenState::same : GoldenState::different;
    result.message = fmt::format("{}: {}", golden_path.string(), result.comparison.verdict);
    if (result.state == GoldenState::different) {
        write_and_tell(png_path(out, name, ".expected.png"), *golden, result.message);
        write_and_tell(png_path(out, name, ".actual.png"), actual, result.message);
        write_and_tell(png_path(out, name, ".difference.png"), difference_image(*golden, actual),
                       result.message);
    }
    return result;
}

Status approve_golden(const fs::path& folder, const std::string& name, const Image& actual,
                      const CompareTolerance& tolerance) {
    if (!valid_snapshot_name(name)) {
        return Error{"snapshot name",
                     fmt::format("found \"{}\", expected letters, digits, '-', '_' and '/'", name)};
    }
    const fs::path path = png_path(folder, name, ".png");
    const Result<Image> golden = load_golden(path);
    if (golden && compare_images(*golden, actual, tolerance).same) return {};
    return write_picture(path, actual);
}

Result<GoldenResult> check_snapshot(const Snapshot& snapshot, const fs::path& folder, const fs::path& out,
                                    bool render_twice) {
    const Result<Image> first = snapshot.render();
    if (!first) return first.error();
    if (render_twice) {
        const Result<Image> second = snapshot.render();
        if (!second) return second.error();
        if (*first != *second) {
            GoldenResult result;
            result.name = snapshot.name;
            result.state = GoldenState::nondeterministic;
            result.comparison = compare_images(*first, *second, snapshot.tolerance);
            result.message = fmt::format("{}: two renderings in a row differ: {}", snapshot.name,
                                         result.comparison.verdict);
            if (valid_snapshot_name(snapshot.name)) {
                write_and_tell(png_path(out, snapshot.name, ".first.png"), *first, result.message);
                write_and_tell(png_path(out, snapshot.name, ".second.png"), *second, result.message);
            }
            return result;
        }
    }
    return check_golden(folder, snapshot.name, *first, snapshot.tolerance, out);
}

std::vector<std::string> orphan_goldens(const fs::path& folder, const std::vector<Snapshot>& snapshots) {
    std::vector<std::string> orphans;
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        if (it->path().extension() != ".png") continue;
        const std::string name = it->path().lexically_relative(folder).replace_extension().generic_string();
        const bool known = std::any_of(snapshots.begin(), snapshots.end(),
                                       [&](const Snapshot& snapshot) { return snapshot.name == name; });
        if (!known) orphans.push_back(name);
    }
    std::sort(orphans.begin(), orphans.end());
    return orphans;
}

}  // namespace slipface

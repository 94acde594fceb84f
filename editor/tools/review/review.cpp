#include "tools/review/review.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "goldens/suite.h"
#include "process/process.h"
#include "slipface/base/files.h"
#include "tools/editor.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

fs::path image_path(const Review& review, const char* ending) {
    return review.report_file.parent_path() / (review.entry()->name + ending);
}

Image image(const Review& review, const char* kind) {
    Result<Image> image = load_image(image_path(review, kind));
    return image ? *std::move(image) : Image{};
}

std::optional<Vec3> vec3_of(const Json& camera, const char* key) {
    if (!camera.contains(key) || !camera[key].is_array() || camera[key].size() != 3) return std::nullopt;
    Vec3 v;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!camera[key][i].is_number()) return std::nullopt;
        v[static_cast<Eigen::Index>(i)] = camera[key][i].get<double>();
    }
    return v.allFinite() ? std::optional(v) : std::nullopt;
}

std::optional<Camera> camera_of(const Review& review) {
    const Result<std::string> text = read_file(image_path(review, ".actual.json"), std::uint64_t{64} << 20U);
    const Json numbers = text ? Json::parse(*text, nullptr, false) : Json();
    if (!numbers.is_object() || !numbers.contains("camera") || !numbers["camera"].is_object())
        return std::nullopt;
    const Json& json = numbers["camera"];
    const std::optional<Vec3> eye = vec3_of(json, "eye"), target = vec3_of(json, "target");
    if (!eye || !target) return std::nullopt;
    Camera camera;
    camera.eye = *eye;
    camera.target = *target;
    if (json.contains("fov_y") && json["fov_y"].is_number()) {
        const double fov = json["fov_y"].get<double>();
        if (fov > 0.05 && fov < 3.0) camera.fov_y = fov;
    }
    return camera;
}

void load_images(Review& review) {
    review.expected = review.actual = review.heat = {};
    ++review.images_revision;
    review.blink_s = 0.0;
    review.camera.reset();
    if (review.entry() == nullptr) return;
    review.camera = camera_of(review);
    review.expected = image(review, ".expected.png");
    review.actual = image(review, ".actual.png");
    if (review.entry()->state == GoldenState::nondeterministic) {
        review.expected = image(review, ".first.png");
        review.actual = image(review, ".second.png");
    }
    if (!review.expected.rgba.empty() && !review.actual.rgba.empty())
        review.heat = difference_image(review.expected, review.actual);
}

// Runs the verb of this program, or of the installed one, in its own process: a snapshot's context cannot
// exist in the process of a window.
Status approve_by_program(const Review& review, const std::vector<std::string>& which) {
    ProcessStart approve{.words = {"snapshot", "approve", "--from", review.report_file.string(), "--goldens",
                                   review.report.goldens}};
    approve.words.insert(approve.words.end(), which.begin(), which.end());
    std::error_code error;
    if (fs::read_symlink("/proc/self/exe", error).filename() != "slipface") approve.program = "slipface";
    const Result<pid_t> process = start_process(approve);
    if (!process) return process.error();
    if (wait_for(*process) != 0)
        return Error{review.entry()->name,
                     "could not be approved; in a terminal, `slipface snapshot approve --from " +
                         review.report_file.generic_string() + " " + which.back() + "` says why"};
    return {};
}

// The level of the scene that this snapshot shows; empty if the suite does not say.
fs::path level_of(const Review& review) {
    const auto scenes = load_scene_suite(fs::path(review.report.goldens) / "scenes.json");
    if (!scenes) return {};
    const std::string scene_name = review.entry()->name.substr(0, review.entry()->name.find('@'));
    for (const Scene& scene : *scenes)
        if (scene.name == scene_name) return scene.level;
    return {};
}

}  // namespace

void open_review(Editor& editor, const fs::path& report_file) {
    const Result<std::string> text = read_file(report_file, std::uint64_t{256} << 20U);
    Result<Report> report = text ? report_from_json(*text, report_file.string()) : text.error();
    if (!report) {
        editor.message = MessageDialog{"Cannot review", report.error().text(), {}};
        return;
    }
    auto review = std::make_shared<Review>();
    review->report_file = report_file;
    review->report = *std::move(report);
    sort_by_severity(review->report);
    review->acts = act_rows(review->report);
    for (std::size_t act = 0; act < review->acts.size(); ++act)
        for (const std::size_t entry : review->acts[act].entries) {
            if (std::find(review->shown.begin(), review->shown.end(), entry) != review->shown.end()) continue;
            review->shown.push_back(entry);
            review->act_of.push_back(act);
        }
    review->marks.assign(review->shown.size(), ReviewMark::none);
    load_images(*review);
    editor.review = std::move(review);
    editor.layout.show(PanelId::review);
    editor.status = fmt::format("{} of {} snapshots differ", editor.review->shown.size(),
                                editor.review->report.entries.size());
}

void close_review(Editor& editor) {
    editor.review.reset();
}

void review_show(Editor& editor, std::size_t index) {
    Review& review = *editor.review;
    if (review.shown.empty()) return;
    review.current = std::min(index, review.shown.size() - 1);
    review.images = true;
    load_images(review);
}

void review_step(Editor& editor, int by) {
    const auto count = static_cast<std::ptrdiff_t>(editor.review->shown.size());
    const auto next = static_cast<std::ptrdiff_t>(editor.review->current) + by;
    if (next < 0 || next >= count) return;
    review_show(editor, static_cast<std::size_t>(next));
}

bool review_can_approve(const Editor& editor) {
    const GoldenResult* entry = editor.review ? editor.review->entry() : nullptr;
    return entry != nullptr && can_be_approved(*entry);
}

namespace {

bool approved(Editor& editor, const std::vector<std::string>& which) {
    const Status status = approve_by_program(*editor.review, which);
    if (!status)
        editor.message = MessageDialog{.title = "Cannot approve",
                                       .text = status.error().text(),
                                       .details = {},
                                       .of_refused_write = true};
    return status.ok();
}

}  // namespace

void review_approve_act(Editor& editor) {
    Review& review = *editor.review;
    if (!review_can_approve(editor)) return;
    const std::size_t act = review.act_of[review.current];
    if (!approved(editor, {"--act", review.acts[act].text})) return;
    for (std::size_t i = 0; i < review.shown.size(); ++i)
        if (review.act_of[i] == act && can_be_approved(review.report.entries[review.shown[i]]))
            review.marks[i] = ReviewMark::approved;
    editor.status = "Approved: " + review.acts[act].text;
    const auto next = std::find(review.marks.begin(), review.marks.end(), ReviewMark::none);
    if (next != review.marks.end())
        review_show(editor, static_cast<std::size_t>(next - review.marks.begin()));
}

void review_mark(Editor& editor, ReviewMark mark) {
    Review& review = *editor.review;
    if (review.entry() == nullptr) return;
    if (mark == ReviewMark::approved) {
        if (!review_can_approve(editor)) return;
        if (!approved(editor, {review.entry()->name})) return;
    }
    review.marks[review.current] = mark;
    editor.status = fmt::format("{}: {}", review.entry()->name, review_mark_name(mark));
    review_step(editor, 1);
}

bool review_has_camera(const Editor& editor) {
    return editor.review && editor.review->camera.has_value();
}

void review_go_to_camera(Editor& editor) {
    Review& review = *editor.review;
    if (!review.camera) return;
    const fs::path level = level_of(review);
    std::error_code error;
    const bool open = editor.document && fs::equivalent(editor.document->level().mesh_path, level, error);
    if (!open && !level.empty()) request_open(editor, level);
    editor.view.look_at(review.camera->eye, review.camera->target);
    editor.view.fov_y = review.camera->fov_y;
    review.images = false;
    editor.status = "Looking from where " + review.entry()->name + " was taken";
}

const char* review_mark_name(ReviewMark mark) {
    constexpr std::array names{"", "approved", "rejected", "skipped"};
    return names[static_cast<std::size_t>(mark)];
}

}  // namespace slipface

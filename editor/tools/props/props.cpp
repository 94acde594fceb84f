#include "tools/props/props.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_set>

#include "slipface/mesh/formats.h"
#include "slipface/mesh/mesh.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_files = 1000, max_looked_at = 20'000;
constexpr int max_folder_depth = 2;

std::string free_prop_name(const Level& level, const std::string& wanted) {
    std::unordered_set<std::string_view> names;
    for (const Prop& prop : level.props)
        names.insert(prop.name);
    names.insert(own_mesh(level)->groups.begin(), own_mesh(level)->groups.end());
    const auto taken = [&](const std::string& name) { return names.contains(name); };
    if (!taken(wanted)) return wanted;
    // "crate 2" becomes "crate 3".
    const std::size_t end = wanted.find_last_not_of("0123456789");
    const bool numbered = end != std::string::npos && end + 1 < wanted.size() && wanted[end] == ' ';
    const std::string stem = numbered ? wanted.substr(0, end) : wanted;
    for (std::size_t number = 2;; ++number) {
        std::string name = stem + " " + std::to_string(number);
        if (!taken(name)) return name;
    }
}

// Sets all props; false, with the reason in the status line, if they are no valid ones.
bool put_props(Editor& editor, std::vector<Prop> props, std::span<const std::uint32_t> from,
               const std::string& step_name) {
    if (const std::string problem = props_problem(props); !problem.empty()) {
        editor.status = problem;
        return false;
    }
    Document& document = *editor.document;
    const std::size_t meshes = document.level().placed.meshes.size();
    document.set_props(std::move(props), from, step_name);
    if (document.level().placed.meshes.size() != meshes) watch_files(editor);
    editor.hovered = no_id;
    editor.pointed.reset();
    editor.tool_faces = {};
    editor.session.report.reset();
    editor.status = document.prop_warnings().empty() ? step_name : document.prop_warnings().front().text();
    return true;
}

std::vector<FaceId> faces_of_prop(const Level& level, std::size_t prop) {
    std::vector<FaceId> faces;
    const std::vector<FaceId>& first = level.placed.first_face;
    if (prop + 1 >= first.size()) return faces;
    for (FaceId face = first[prop]; face < first[prop + 1]; ++face)
        faces.push_back(face);
    return faces;
}

Eigen::Matrix3d rotation_of(const Prop& prop) {
    const Placement turned = placement(Vec3::Zero(), prop.rotation, Vec3::Ones());
    Eigen::Matrix3d matrix;
    for (int column = 0; column < 3; ++column)
        matrix.col(column) = turned.columns[static_cast<std::size_t>(column)];
    return matrix;
}

// The angles about z, then x, then y that give a rotation.
Vec3 angles_of(const Eigen::Matrix3d& m) {
    const double sine = std::clamp(-m(1, 2), -1.0, 1.0);
    if (std::abs(sine) > 1.0 - 1e-12)  // x is upright: z and y turn about the same axis
        return {std::copysign(1.5707963267948966, sine), std::atan2(-m(2, 0), m(0, 0)), 0.0};
    return {std::asin(sine), std::atan2(m(0, 2), m(2, 2)), std::atan2(m(1, 0), m(1, 1))};
}

}  // namespace

std::vector<std::string> find_prop_files(const Level& level) {
    const fs::path folder = level.mesh_path.parent_path().empty() ? "." : level.mesh_path.parent_path();
    std::set<std::string> files;
    for (const Prop& prop : level.props)
        files.insert(prop.mesh);
    std::error_code error;
    std::size_t looked_at = 0;
    fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
    for (; !error && it != end && ++looked_at < max_looked_at && files.size() < max_files;
         it.increment(error)) {
        std::error_code unreadable;
        if (it->is_directory(unreadable)) {
            const bool hidden = it->path().filename().string().starts_with('.');
            if (hidden || it.depth() >= max_folder_depth) it.disable_recursion_pending();
        } else if (mesh_format_of(it->path()) != nullptr && it->is_regular_file(unreadable) &&
                   !fs::equivalent(it->path(), level.mesh_path, unreadable)) {
            files.insert(it->path().lexically_relative(folder).generic_string());
        }
    }
    return {files.begin(), files.end()};
}

std::optional<std::size_t> chosen_prop(const Editor& editor) {
    if (!editor.document || editor.props.chosen.empty()) return std::nullopt;
    const std::vector<Prop>& props = editor.document->level().props;
    const auto found = std::ranges::find(props, editor.props.chosen, &Prop::name);
    if (found == props.end()) return std::nullopt;
    return static_cast<std::size_t>(found - props.begin());
}

void choose_prop(Editor& editor, std::optional<std::size_t> prop) {
    const Level& level = editor.document->level();
    editor.props.chosen = prop && *prop < level.props.size() ? level.props[*prop].name : std::string();
    editor.document->select(prop ? faces_of_prop(level, *prop) : std::vector<FaceId>(),
                            prop ? "Select " + editor.props.chosen : std::string());
}

std::optional<std::size_t> prop_of_target(const Editor& editor, const std::optional<FacePoint>& target) {
    if (!target) return std::nullopt;
    const std::uint32_t prop = editor.document->level().placed.prop_of(target->face);
    return prop == no_id ? std::nullopt : std::optional<std::size_t>(prop);
}

bool add_prop(Editor& editor, const std::string& file, const Vec3& position, std::string name) {
    const Level& level = editor.document->level();
    if (name.empty()) name = free_prop_name(level, fs::path(file).stem().string());
    std::vector<Prop> props = level.props;
    std::vector<std::uint32_t> from = every_prop(level);
    Prop prop;
    prop.name = std::move(name);
    prop.mesh = file;
    prop.position = position;
    props.push_back(prop);
    from.push_back(no_id);
    editor.document->begin("Place " + prop.name);
    const bool added = put_props(editor, std::move(props), from, "Place " + prop.name);
    if (added) choose_prop(editor, editor.document->level().props.size() - 1);
    editor.document->commit();
    return added;
}

bool change_prop(Editor& editor, std::size_t prop, const Prop& to, std::string step_name) {
    const Level& level = editor.document->level();
    if (prop >= level.props.size()) return false;
    std::vector<Prop> props = level.props;
    const bool chosen = editor.props.chosen == props[prop].name;
    props[prop] = to;
    if (!put_props(editor, std::move(props), every_prop(level), step_name)) return false;
    if (chosen) editor.props.chosen = to.name;
    return true;
}

void duplicate_prop(Editor& editor, std::size_t prop) {
    const Level& level = editor.document->level();
    if (prop >= level.props.size()) return;
    std::vector<Prop> props = level.props;
    std::vector<std::uint32_t> from = every_prop(level);
    Prop copy = props[prop];
    copy.name = free_prop_name(level, copy.name);
    // As far to the side as it is wide.
    const Aabb box = prop_bounds(level, prop);
    copy.position.x() += box.empty() ? 1.0 : std::max(0.25, std::ceil(4.0 * box.size().x()) / 4.0);
    props.push_back(copy);
    from.push_back(static_cast<std::uint32_t>(prop));
    editor.document->begin("Duplicate " + props[prop].name);
    if (put_props(editor, std::move(props), from, "Duplicate " + level.props[prop].name))
        choose_prop(editor, editor.document->level().props.size() - 1);
    editor.document->commit();
}

void place_prop(Editor& editor) {
    if (const auto pointed = pointed_target(editor))
        add_prop(editor, editor.props.file, pointed->point);
    else if (const auto middle = middle_of_view(editor))
        add_prop(editor, editor.props.file, middle->point);
    else
        editor.status = "There is no face in the middle of the view";
}

void move_prop_in_view(Editor& editor, std::size_t prop) {
    const auto hit = middle_of_view(editor);
    if (!hit || prop >= editor.document->level().props.size()) {
        editor.status = "There is no face in the middle of the view";
        return;
    }
    Prop to = editor.document->level().props[prop];
    to.position = hit->point;
    change_prop(editor, prop, to, "Move " + to.name);
}

void remove_prop(Editor& editor, std::size_t prop) {
    const Level& level = editor.document->level();
    if (prop >= level.props.size()) return;
    std::vector<Prop> props = level.props;
    std::vector<std::uint32_t> from = every_prop(level);
    const std::string name = props[prop].name;
    props.erase(props.begin() + static_cast<std::ptrdiff_t>(prop));
    from.erase(from.begin() + static_cast<std::ptrdiff_t>(prop));
    put_props(editor, std::move(props), from, "Delete " + name);
}

std::string prop_name_problem(const Document& document, std::size_t prop, const std::string& name) {
    std::vector<Prop> props = document.level().props;
    if (prop >= props.size()) return "There is no such prop";
    props[prop].name = name;
    return props_problem(props);
}

void paint_prop(Editor& editor, std::size_t prop, std::optional<SurfaceId> surface) {
    const Level& level = editor.document->level();
    if (prop >= level.props.size() || (surface && *surface >= level.surfaces.size())) return;
    Prop to = level.props[prop];
    to.type = surface ? level.surfaces[*surface].name : std::string();
    change_prop(editor, prop, to, surface ? "Make " + to.name + " " + to.type : "Unset " + to.name);
}

PropMotion prop_motion(const Level& level, const Prop& prop) {
    PropMotion motion;
    const auto found = std::ranges::find(level.platforms, prop.name, &Platform::group);
    if (found == level.platforms.end()) return motion;
    motion.turn = found->spin_rate;
    if (found->path.size() < 2) return motion;
    motion.way = found->path.back().offset;
    motion.speed = found->path.front().speed;
    return motion;
}

void set_prop_motion(Editor& editor, std::size_t prop, const PropMotion& motion) {
    const Level& level = editor.document->level();
    if (prop >= level.props.size()) return;
    const Prop& moved = level.props[prop];
    std::vector<Platform> platforms = level.platforms;
    const auto found = std::ranges::find(platforms, moved.name, &Platform::group);
    Platform platform = found == platforms.end() ? Platform{} : *found;
    if (found != platforms.end()) platforms.erase(found);
    if (!motion.way.isZero(0.0) || motion.turn != 0.0) {
        platform.name = platform.group = moved.name;
        platform.spin_pivot = moved.position;
        platform.spin_rate = motion.turn;
        platform.path.clear();
        if (!motion.way.isZero(0.0))
            platform.path = {{.speed = motion.speed}, {.offset = motion.way, .speed = motion.speed}};
        platforms.push_back(std::move(platform));
    }
    editor.document->set_platforms(std::move(platforms), "Move " + moved.name + " by itself");
}

double snapped(double value, double step) {
    return step > 0.0 ? std::round(value / step) * step : value;
}

Prop moved_prop(const Prop& from, int axis, double metres, std::optional<double> step) {
    Prop to = from;
    to.position[axis] += metres;
    if (step) to.position[axis] = snapped(to.position[axis], *step);
    return to;
}

Prop turned_prop(const Prop& from, int axis, double radians) {
    Prop to = from;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(radians, Vec3::Unit(axis)).toRotationMatrix();
    to.rotation = angles_of(turn * rotation_of(from));
    // No angle is a hair away from none.
    for (int i = 0; i < 3; ++i)
        if (std::abs(to.rotation[i]) < 1e-12) to.rotation[i] = 0.0;
    return to;
}

Prop scaled_prop(const Prop& from, int axis, double factor, std::optional<double> step) {
    Prop to = from;
    double size = std::abs(from.scale[axis]) * factor;
    if (step) size = snapped(size, *step);
    size = std::clamp(size, step.value_or(smallest_prop_scale), largest_prop_scale);
    to.scale[axis] = std::copysign(size, from.scale[axis]);
    return to;
}

}  // namespace slipface

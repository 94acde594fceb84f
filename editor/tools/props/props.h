// Props in the editor: which files can be placed, the chosen prop, and its changes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/target.h"

namespace slipface {

// Geometry files that can be props, relative to the level's folder, in alphabetical order: those in the
// folder and two levels below, without the level's own, and those that props name already.
std::vector<std::string> find_prop_files(const Level& level);

// The chosen prop; nothing: none, or it is gone.
std::optional<std::size_t> chosen_prop(const Editor& editor);
void choose_prop(Editor& editor, std::optional<std::size_t> prop);  // also selects its faces
// The prop that the face belongs to, or nothing.
std::optional<std::size_t> prop_of_target(const Editor& editor, const std::optional<FacePoint>& target);

// Each of these is one step of history, and reports a problem in the status line.
// Places a mesh with its origin at `position`, and chooses it. `name`: empty for one from the file's.
bool add_prop(Editor& editor, const std::string& file, const Vec3& position, std::string name = {});
void place_prop(Editor& editor);  // the chosen mesh, under the mouse or in the middle of the view
bool change_prop(Editor& editor, std::size_t prop, const Prop& to, std::string step_name);
void duplicate_prop(Editor& editor, std::size_t prop);     // beside itself
void move_prop_in_view(Editor& editor, std::size_t prop);  // onto the face in its middle
void remove_prop(Editor& editor, std::size_t prop);
// Why a prop cannot have that name; empty: it can.
std::string prop_name_problem(const Document& document, std::size_t prop, const std::string& name);
// Gives the prop the brush's type; nothing: its materials decide again.
void paint_prop(Editor& editor, std::size_t prop, std::optional<SurfaceId> surface);
// Turns by a path and a rate: a platform of the prop's group. No path and no rate: it rests.
struct PropMotion {
    Vec3 way = Vec3::Zero();  // it moves to there and back, metres
    double speed = 2.0;       // m/s
    double turn = 0.0;        // rad/s about its own vertical axis
};
PropMotion prop_motion(const Level& level, const Prop& prop);
void set_prop_motion(Editor& editor, std::size_t prop, const PropMotion& motion);

// What the mouse does to the chosen prop: one axis of the world (`rotate` and `move`), or of the prop
// (`scale`).
double snapped(double value, double step);
Prop moved_prop(const Prop& from, int axis, double metres, std::optional<double> step);
Prop turned_prop(const Prop& from, int axis, double radians);
Prop scaled_prop(const Prop& from, int axis, double factor, std::optional<double> step);

}  // namespace slipface

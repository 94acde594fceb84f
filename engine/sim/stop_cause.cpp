// Names what held the player by what was enough to free it, and measures it.
#include <algorithm>
#include <cmath>

#include "stop_parts.h"

namespace slipface {
namespace {

// Faces less upright than this are slopes: N.y.
constexpr double least_slope_y = 0.1;

// What one of the things does that hold the player, measured in its way.
struct Part {
    const Holding* holding = nullptr;
    StopCause cause = StopCause::wall;
    double lowest_m = 0.0, highest_m = 0.0;  // above the feet
    double feet_m = 0.0;                     // of the player
    double nearest_m = 0.0;                  // from the player's middle
    bool out_of_bounds = true;               // too high, too low, too steep for the settings
};

Part part_of(WhatHolds& holds, const Holding& holding, const Stop& stop, const MovementSettings& settings,
             const Mesh& mesh) {
    Part part{.holding = &holding};
    if (const auto extent = holds.extent(holding, stop.worst)) {
        part.lowest_m = extent->lowest;
        part.highest_m = extent->highest;
        part.nearest_m = extent->nearest;
        part.feet_m = extent->feet;
    }
    const double step = settings.step_up ? settings.step_height : 0.0;
    const double body = 2.0 * settings.radii.y();
    // Touched within the face, and not at its rim.
    const Vec3 face = face_normal(mesh, holding.front().face), touched = holding.front().normal;
    const bool within = touched.dot(face) > 0.99;
    const bool tilted = within && face.y() > least_slope_y && face.y() < 0.999;
    const bool above = within && face.y() < -least_slope_y;
    if (holding.front().platform != no_id) {
        part.cause = StopCause::platform;
    } else if (above || (part.lowest_m > std::max(step, 0.25 * body) && part.lowest_m < body + step)) {
        part.cause = StopCause::overhead;
    } else if (tilted) {
        part.cause = StopCause::slope;
    } else if (part.highest_m < settings.radii.y()) {
        part.cause = StopCause::step;
        part.out_of_bounds = part.highest_m > step;
    }
    return part;
}

bool is_upright(const Part& part) {
    return part.cause == StopCause::wall || part.cause == StopCause::step;
}

void hold(Stop& stop, const Holding& holding) {
    for (const Obstacle& obstacle : holding)
        stop.held_by.insert(stop.held_by.end(), obstacle.faces.begin(), obstacle.faces.end());
}

}  // namespace

// Names the thing that held the player, by what was enough to free it.
void name_cause(Stop& stop, WhatHolds& holds, std::span<const Holding> found, std::span<const Blame> by_trace,
                const MovementSettings& settings, const Mesh& mesh) {
    // Of a set that holds together, what was hit in the run itself stands for all.
    std::vector<Holding> sets(found.begin(), found.end());
    for (Holding& holding : sets) {
        for (const Blame& blame : by_trace) {
            const auto hit = std::ranges::find_if(holding, [&](const Obstacle& obstacle) {
                return std::ranges::binary_search(obstacle.faces, blame.face);
            });
            if (hit == holding.end()) continue;
            std::rotate(holding.begin(), hit, hit + 1);
            break;
        }
    }
    std::vector<Part> parts;
    for (const Holding& holding : sets)
        parts.push_back(part_of(holds, holding, stop, settings, mesh));
    auto chosen = std::ranges::find_if(parts, &Part::out_of_bounds);
    if (chosen == parts.end()) chosen = parts.begin();
    const Holding& holding = *chosen->holding;

    Loss& loss = stop.loss;
    const Obstacle* main = &holding.front();
    const Blame* traced = nullptr;
    for (const Blame& blame : by_trace) {
        for (const Obstacle& obstacle : holding) {
            if (traced != nullptr || !std::ranges::binary_search(obstacle.faces, blame.face)) continue;
            traced = &blame;
            main = &obstacle;
        }
    }
    if (traced != nullptr) {
        stop.worst = traced->worst;
        loss = traced->loss;
    } else {
        // Met in a try to step up, or behind what was met first.
        loss.face = main->face;
        loss.position = main->point;
        loss.normal = main->normal;
        loss.record.reset();
        loss.height_m = main->point.y() - chosen->feet_m;
    }
    const StopCause before = loss.cause;
    loss.cause = chosen->cause;
    loss.top_m = chosen->highest_m;
    stop.feet_m = chosen->feet_m;
    loss.other = no_id;
    hold(stop, holding);

    if (chosen->cause == StopCause::overhead && !loss.in_air) {
        double floor = 0.0;
        for (const Part& part : parts)
            if (!part.out_of_bounds && part.lowest_m < chosen->lowest_m)
                floor = std::max(floor, part.highest_m);
        loss.clearance_m = chosen->lowest_m - floor;
    }
    if (chosen->cause == StopCause::wall && before == StopCause::back) loss.cause = StopCause::back;
    if (!is_upright(*chosen)) return;
    // What is higher than the player is a wall, with a hole before it or without.
    const bool low = !loss.in_air && chosen->highest_m < 2.0 * settings.radii.y();
    const FaceId rim = low ? holds.rim_before(chosen->nearest_m, stop.worst) : no_id;
    if (rim != no_id) {
        loss.cause = StopCause::gap;
        loss.other = rim;
        loss.hole = true;
        return;
    }
    // A second wall stands against the stick. If a much thinner player gets on, the two are a gap, else a
    // corner.
    const Obstacle wall{{}, loss.face, loss.normal, loss.position, main->platform};
    std::optional<Obstacle> other = holds.beside(wall, stop.first, stop.last);
    if (!other) other = holds.beside(*main, stop.first, stop.last);
    if (other) {
        loss.cause = holds.lets_thin_through() ? StopCause::gap : StopCause::corner;
        loss.other = other->face != loss.face ? other->face : main->face;
    }
}

// The two things that left no room: without either the player would have lived.
void name_press(Stop& stop, WhatHolds& holds) {
    const std::vector<Holding> found = holds.of_crush(stop.first);
    for (const Holding& holding : found) {
        const Obstacle& obstacle = holding.front();
        if (obstacle.platform != no_id && stop.held_by.empty()) {
            stop.loss.face = obstacle.face;
            hold(stop, holding);
        } else {
            stop.loss.other = obstacle.face;
        }
    }
}

bool name_fall(Stop& stop, WhatHolds& holds, double lowest) {
    const auto carrier = holds.of_fall(stop.left, stop.first, lowest);
    if (!carrier) return false;
    const Obstacle& obstacle = carrier->holding.front();
    stop.fall = carrier->cause;
    stop.loss.face = obstacle.face;
    stop.loss.other = carrier->ground;
    if (carrier->surface) stop.loss.surface = *carrier->surface;
    hold(stop, carrier->holding);
    if (!obstacle.point.isZero(0.0)) stop.loss.position = obstacle.point;
    return true;
}

}  // namespace slipface

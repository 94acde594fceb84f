#include "slipface/collision/posed.h"

#include <cmath>

#include "queries/sight.h"

namespace slipface {

namespace {

Vec3 middle_of(const CollisionWorld::Impl& world) {
    return world.bounds.empty() ? Vec3(Vec3::Zero()) : Vec3(0.5 * (world.bounds.min + world.bounds.max));
}

}  // namespace

PosedWorld::PosedWorld(const CollisionWorld& world, const Pose& pose)
    : world_(&world),
      pose_(pose),
      turned_(pose.columns != Pose{}.columns),
      origin_(turned_ ? pose.apply(middle_of(world.impl())) : pose.offset) {}

std::array<Vec3, 3> PosedWorld::triangle(TriangleId triangle) const {
    // Not in place: clang 14 makes WebAssembly of that which reads what it has written.
    const std::array<Vec3, 3> corners = world_->triangle(triangle);
    return {pose_.apply(corners[0]), pose_.apply(corners[1]), pose_.apply(corners[2])};
}

Aabb PosedWorld::bounds() const {
    Aabb rest = world_->bounds();
    if (rest.empty()) return rest;
    if (!turned_) return {rest.min + pose_.offset, rest.max + pose_.offset};
    const Vec3 half = 0.5 * (rest.max - rest.min);
    const Vec3 reach = pose_.columns[0].cwiseAbs() * half.x() + pose_.columns[1].cwiseAbs() * half.y() +
                       pose_.columns[2].cwiseAbs() * half.z();
    // Turned corners are rounded to float.
    const Vec3 most = reach + Vec3::Constant(1e-6 * half.maxCoeff());
    return {origin_ - most, origin_ + most};
}

namespace detail {

PosedSight::PosedSight(const PosedWorld& posed) : Sight(posed.world().impl()) {
    if (!posed.turned() || world.empty()) return;
    const Vec3 middle = middle_of(world), offset = -posed.pose().rotate(middle);
    const double radius = world.radius;
    view_.tree = world.bvh.view();
    for (int axis = 0; axis < 3; ++axis) {
        view_.offset[axis] = offset[axis];
        for (int column = 0; column < 3; ++column) {
            const double cosine = posed.pose().columns[static_cast<std::size_t>(column)][axis];
            view_.linear[column][axis] = view_.inverse[column][axis] = cosine;
        }
        extent_.low[axis] = static_cast<float>(-radius);
        extent_.high[axis] = static_cast<float>(radius);
    }
    view_.slack = 0x1p-22 * radius + 1e-37;
    view_.least_scale = 1.0 - 1e-6;
    view_.first = 0;
    view_.mirrors = false;
    extent_.reach = radius;
    turned = &view_;
    extent = &extent_;
    has_tree = world.movable();
    view = {{nullptr, nullptr}, world.ball.view(), &view_, radius};
}

}  // namespace detail

}  // namespace slipface

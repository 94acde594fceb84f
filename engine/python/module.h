// What the parts of the Python module share.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <stdexcept>

#include "slipface/level/level_scene.h"

namespace slipface::python {

namespace py = pybind11;

// A NumPy array of numbers in rows; others are converted, which copies them.
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

[[noreturn]] inline void raise(const Error& error) {
    throw py::value_error(error.text());
}
template <class T>
T value_or_raise(Result<T> result) {
    if (!result) raise(result.error());
    return std::move(*result);
}

inline Vec3 vec(const std::array<double, 3>& v) {
    return {v[0], v[1], v[2]};
}
inline py::tuple tuple(const Vec3& v) {
    return py::make_tuple(v.x(), v.y(), v.z());
}

// What queries and steps see: triangles, or a level.
struct World {
    CollisionWorld collision;
    std::vector<SurfaceType> types;
    std::vector<std::uint32_t> groups;  // [triangle]; empty: all are in all
    std::unique_ptr<Level> level;       // null: a world of triangles
    std::optional<LevelScene> scene;
    double time = 0.0, dt = 0.0;
    // Calls that let other Python threads run hold it shared; those that change the world want it alone.
    mutable std::shared_mutex in_use;

    MovementScene now() {
        if (scene) return scene->at(time, dt);
        return {.collision = collision, .surfaces = types};
    }
    std::vector<SurfaceType>& surfaces() { return level ? level->surfaces : types; }
};

// While it lives, the world may be changed.
class Change {
  public:
    explicit Change(const World& world) : lock_(world.in_use, std::try_to_lock) {
        if (!lock_.owns_lock()) throw std::runtime_error("the world is in use by another thread");
    }

  private:
    std::unique_lock<std::shared_mutex> lock_;
};

py::dict record_dict(const TraceRecord& record);

void add_settings(py::module_& module);
void add_world(py::module_& module);
void add_level(py::module_& module);

}  // namespace slipface::python

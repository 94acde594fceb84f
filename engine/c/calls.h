// What every function of slipface.h does around its work: find the objects of handles, catch exceptions, say
// what is wrong.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <optional>

#include "handles.h"
#include "slipface/collision/filter.h"
#include "slipface/level/level_scene.h"

namespace slipface::c {

struct Settings final : Object {
    MovementSettings values;
};

// A platform of a world of triangles.
struct PlatformBody {
    std::vector<std::uint32_t> groups;
    std::unique_ptr<CollisionWorld> rest;
};

struct World final : Object {
    // A world of triangles.
    CollisionWorld collision;
    std::vector<SurfaceType> types;
    std::vector<std::uint32_t> groups;  // [triangle]; empty: all are in all
    std::vector<PlatformBody> platforms;
    std::vector<MovingPart> parts;
    PlatformTree tree;  // of `parts`
    // A level; null in a world of triangles.
    std::unique_ptr<Level> level;
    std::optional<LevelScene> scene;
    double time = 0.0, dt = 0.0;

    std::optional<MovementScene> now;  // what queries and steps see; always there

    void see_triangles() {
        now.emplace(
            MovementScene{.collision = collision, .surfaces = types, .platforms = parts, .tree = &tree});
    }
    void see_level() { now.emplace(scene->at(time, dt)); }
};

// A reason to stop, thrown within the library only.
struct Failure {
    slipface_status status;
    std::string text;
};
template <class... Args>
[[noreturn]] void refuse(slipface_status status, fmt::format_string<Args...> text, Args&&... args) {
    throw Failure{status, fmt::format(text, std::forward<Args>(args)...)};
}
[[noreturn]] inline void refuse(slipface_status status, const Error& error) {
    throw Failure{status, error.text()};
}

inline slipface_status report(slipface_error* error, slipface_status status, std::string_view text) {
    if (error == nullptr) return status;
    error->status = status;
    const std::size_t length = std::min(text.size(), sizeof error->text - 1);
    std::memcpy(error->text, text.data(), length);
    error->text[length] = '\0';
    return status;
}

// Runs `body`, which may throw; what it threw becomes a status and a text.
template <class Body>
slipface_status run(slipface_error* error, const Body& body) noexcept {
    try {
        body();
        return report(error, SLIPFACE_OK, "");
    } catch (const Failure& failure) {
        return report(error, failure.status, failure.text);
    } catch (const std::bad_alloc&) {
        return report(error, SLIPFACE_NO_MEMORY, "out of memory");
    } catch (const std::exception& exception) {
        return report(error, SLIPFACE_FAILED, exception.what());
    } catch (...) {
        return report(error, SLIPFACE_FAILED, "an unknown exception");
    }
}

// The object of a handle, for as long as it lives.
template <class T, Kind kind, Use use>
class Held {
  public:
    explicit Held(std::uint64_t id) : access_(kind, id, use) {
        constexpr const char* name = kind == Kind::world ? "world" : "settings";
        if (access_.status() == SLIPFACE_WRONG_HANDLE)
            refuse(SLIPFACE_WRONG_HANDLE, "found {} with the handle {}, which was freed or never was one",
                   name, id);
        if (access_.status() == SLIPFACE_IN_USE)
            refuse(SLIPFACE_IN_USE, "the {} {} in use by another thread", name,
                   kind == Kind::world ? "is" : "are");
    }
    T* operator->() const { return static_cast<T*>(access_.object()); }
    T& operator*() const { return *static_cast<T*>(access_.object()); }

  private:
    Access access_;
};
using SharedWorld = Held<const World, Kind::world, Use::shared>;
using ChangedWorld = Held<World, Kind::world, Use::alone>;
using SharedSettings = Held<const Settings, Kind::settings, Use::shared>;
using ChangedSettings = Held<Settings, Kind::settings, Use::alone>;

template <class... Pointers>
void need(const char* names, Pointers... pointers) {
    if ((!pointers || ...)) refuse(SLIPFACE_WRONG_ARGUMENT, "found null, expected {}", names);
}

inline Vec3 vec(const slipface_vec3& v) {
    return {v.x, v.y, v.z};
}
inline slipface_vec3 vec(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}
inline Vec3 finite(const slipface_vec3& v, const char* name) {
    if (!vec(v).allFinite())
        refuse(SLIPFACE_WRONG_ARGUMENT, "{}: found ({}, {}, {}), expected finite numbers", name, v.x, v.y,
               v.z);
    return vec(v);
}

slipface_contact contact_of(const Contact& contact, std::uint32_t platform,
                            std::span<const TriangleId> numbers);
slipface_contact no_contact();

}  // namespace slipface::c

// What every function of slipface.h does around its work: find the objects of handles, catch exceptions, say
// what is wrong.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "slipface/base/result.h"
#include "slipface/base/say.h"
#include "slipface/movement/settings.h"
#include "world.h"

namespace slipface::c {

struct Settings final : Object {
    MovementSettings values;
};

// A reason to stop, thrown within the library only.
struct Failure {
    slipface_status status;
    std::string text;
};
template <class... Words>
[[noreturn]] void refuse(slipface_status status, std::string_view text, const Words&... words) {
    throw Failure{status, say(text, words...)};
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

inline std::uint64_t handle_of(Kind kind, std::unique_ptr<Object> object) {
    const std::uint64_t id = new_handle(kind, std::move(object));
    if (id == 0) refuse(SLIPFACE_NO_MEMORY, "too many worlds and settings, expected at most 65536");
    return id;
}

inline Vec3 positive(const slipface_vec3& v, const char* name) {
    if (!(finite(v, name).minCoeff() > 0.0))
        refuse(SLIPFACE_WRONG_ARGUMENT, "{}: found ({}, {}, {}), expected numbers above 0", name, v.x, v.y,
               v.z);
    return vec(v);
}
// 0 or more, and possibly infinite.
inline double distance(double value, const char* name) {
    if (!(value >= 0.0)) refuse(SLIPFACE_WRONG_ARGUMENT, "{}: found {}, expected 0 or more", name, value);
    return value;
}

// A struct that the caller fills, of its version or a later one; what it does not have is 0. `first`: the
// size of the first version.
template <class Sized>
Sized taken(const Sized& from, const char* name, std::size_t first = sizeof(Sized)) {
    constexpr std::size_t most = 4096;
    if (from.size < first || from.size > most)
        refuse(SLIPFACE_WRONG_ARGUMENT, "{}: found the size {}, expected sizeof, {}", name, from.size,
               sizeof(Sized));
    Sized here{};
    std::memcpy(&here, &from, std::min<std::size_t>(from.size, sizeof(Sized)));
    return here;
}
// Of an array of such structs.
template <class Sized>
Sized& nth(Sized* first, std::size_t i) {
    using Byte = std::conditional_t<std::is_const_v<Sized>, const char, char>;
    return *reinterpret_cast<Sized*>(reinterpret_cast<Byte*>(first) + i * first->size);
}

// The scene of a world as a filter lets it be seen. The filter must outlive it.
class Seen {
  public:
    Seen(const World& in, const slipface_filter* filter);
    Seen(const Seen&) = delete;
    Seen& operator=(const Seen&) = delete;

    const MovementScene& scene() const { return filtered_ ? *filtered_ : *in_.now; }
    const SceneFilter* filter() const { return filtered_ ? &filter_ : nullptr; }

  private:
    const World& in_;
    slipface_filter asked_{};
    SceneFilter filter_;
    std::optional<MovementScene> filtered_;
};

slipface_contact contact_of(const Contact& contact, std::uint32_t platform,
                            std::span<const TriangleId> numbers);
slipface_contact no_contact();

}  // namespace slipface::c

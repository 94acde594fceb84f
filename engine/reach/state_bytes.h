// States as bytes, for files of searches and for what the processes of a team send each other.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "slipface/base/bytes.h"
#include "slipface/reach/search.h"

namespace slipface {

struct StateWriter : ByteWriter<std::uint64_t> {
    using ByteWriter::put;
    void put(const Vec3& vector) {
        for (int axis = 0; axis < 3; ++axis)
            put(vector[axis]);
    }
};

// Reads what StateWriter wrote; `problem` says which value is missing or not allowed, and nothing is read
// after it.
class StateReader {
  public:
    explicit StateReader(std::string_view bytes) : from_(bytes) {}
    template <class T>
    T get() {
        if (problem) return T{};
        const T value = from_.get<T>();
        if (!from_.ok) fail("the end of the data", "more");
        return value;
    }
    // A whole number of at most `most`.
    template <class T>
    T up_to(std::uint64_t maximum, const char* what) {
        const T value = get<T>();
        if (value > maximum) fail(fmt::format("{} {}", what, value), fmt::format("at most {}", maximum));
        return problem ? T{0} : value;
    }
    // An index below `count`, or no_id.
    std::uint32_t index(std::size_t count, const char* what) {
        const auto value = get<std::uint32_t>();
        if (value != no_id && value >= count)
            fail(fmt::format("{} {}", what, value), fmt::format("one below {}", count));
        return problem ? no_id : value;
    }
    double number(const char* what) {
        const auto value = get<double>();
        if (!(std::abs(value) <= 1e12)) fail(fmt::format("{} {}", what, value), "a finite number");
        return problem ? 0.0 : value;
    }
    Vec3 vector(const char* what) {
        const double x = number(what), y = number(what), z = number(what);
        return {x, y, z};
    }
    // How many items follow, each of at least `size` bytes: no more than there are bytes for.
    std::size_t count(std::size_t size, const char* what) {
        return up_to<std::uint64_t>(from_.left() / size, what);
    }
    bool at_end() const { return from_.at_end(); }
    void fail(std::string found, std::string expected) {
        if (!problem) problem = fmt::format("byte {}: found {}, expected {}", from_.at(), found, expected);
    }
    std::optional<std::string> problem;

  private:
    ByteReader<std::uint64_t> from_;
};

inline void put_state(StateWriter& to, const PlayerState& state) {
    for (const auto member : PlayerState::vectors)
        to.put(state.*member);
    for (const std::int32_t number : state.sector)
        to.put(number);
    std::uint16_t flags = 0;
    for (const auto member : PlayerState::flags)
        flags = static_cast<std::uint16_t>(flags * 2 + (state.*member ? 1 : 0));
    to.put(flags);
    to.put(state.ground_face);
    to.put(state.ground_surface);
    to.put(state.ground_platform);
    to.put(static_cast<std::uint8_t>(state.carrier));
    for (const auto member : PlayerState::numbers)
        to.put(state.*member);
    for (const auto member : PlayerState::counts)
        to.put(state.*member);
}

inline PlayerState get_state(StateReader& from, const Level& level) {
    PlayerState state;
    for (const auto member : PlayerState::vectors)
        state.*member = from.vector("a coordinate of a state");
    for (std::int32_t& number : state.sector)
        number = from.get<std::int32_t>();
    static_assert(PlayerState::flags.size() <= 16, "two bytes hold them");
    auto flags = from.up_to<std::uint16_t>((1U << PlayerState::flags.size()) - 1, "the flags of a state");
    for (auto member = PlayerState::flags.rbegin(); member != PlayerState::flags.rend(); ++member) {
        state.*(*member) = flags % 2 != 0;
        flags /= 2;
    }
    state.ground_face = from.index(level.mesh.face_count(), "a face");
    state.ground_surface = from.up_to<SurfaceId>(level.surfaces.size() - 1, "a surface type");
    state.ground_platform = from.index(level.platforms.size(), "a platform");
    state.carrier = static_cast<Carrier>(
        from.up_to<std::uint8_t>(static_cast<std::uint8_t>(Carrier::character), "a carrier"));
    for (const auto member : PlayerState::numbers)
        state.*member = from.number("a number of a state");
    for (const auto member : PlayerState::counts)
        state.*member = from.get<std::uint8_t>();
    return state;
}

}  // namespace slipface

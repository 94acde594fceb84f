// Reads the members of a request of the stepping protocol (docs/course.md). Every function refuses what does
// not fit by throwing Refused, which names the place, what was found and what was expected; only `serve`
// calls them, and catches it.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "cli/format.h"

namespace slipface::cli {

struct Refused {
    std::string place;  // a JSON pointer into the request: "/meshes/0/triangles/3"
    std::string found, expected;
};

// A value and where it is.
struct Placed {
    const OutputJson& value;
    std::string place;

    [[noreturn]] void refuse(std::string_view expected) const;  // found: the value itself, cut short
    // The object's member, or refuses that there is none.
    Placed member(std::string_view key) const;
    // Calls use(member) if the object has it.
    template <class Use>
    void if_member(std::string_view key, Use&& use) const {
        const auto found = value.find(key);
        if (found != value.end()) use(Placed{*found, place + "/" + std::string(key)});
    }
    // Refuses what is no object, and members of other names.
    void need_object_of(std::initializer_list<std::string_view> keys) const;
    std::size_t need_array(std::size_t most) const;  // its length
    Placed item(std::size_t index) const;

    double number(double least, double most) const;
    std::size_t whole(std::size_t least, std::size_t most) const;
    bool truth() const;
    std::string text() const;              // of at most 1000 bytes
    Vec3 vector(double most = 1e6) const;  // of three numbers, each within +-most
};

}  // namespace slipface::cli

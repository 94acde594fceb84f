// A value of a glTF file's JSON, and where it stands: every access is checked, and a failure names the place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

// Thrown by everything that reads glTF, and caught by import_gltf(): a file is refused as a whole.
struct GltfRefused : std::runtime_error {
    explicit GltfRefused(Error refused) : std::runtime_error(refused.message), error(std::move(refused)) {}
    Error error;
};

// Of a file of glTF 1.0, which is another format.
struct GltfTooOld : GltfRefused {
    using GltfRefused::GltfRefused;
};

class GltfValue {
  public:
    // `place`: the file's name. `value`: null for a member that is not there.
    GltfValue(const nlohmann::json* value, std::string place) : value_(value), place_(std::move(place)) {}

    explicit operator bool() const { return value_ != nullptr; }
    const std::string& place() const { return place_; }  // "level.glb:/meshes/0/primitives/2"
    [[noreturn]] void refuse(std::string message) const { throw GltfRefused({place_, std::move(message)}); }

    // A member; of what is not there or no object, what is not there.
    GltfValue operator[](std::string_view key) const;
    GltfValue extension(std::string_view name) const { return (*this)["extensions"][name]; }
    // Refuse what is no array, and an index outside it. What is not there is an empty array.
    std::size_t size() const;
    GltfValue at(std::size_t index) const;

    // Refuse what is something else. What is not there is `otherwise`; without one it is refused.
    std::string text(std::optional<std::string> otherwise = {}) const;
    double number(std::optional<double> otherwise = {}) const;  // finite
    std::uint64_t whole(std::optional<std::uint64_t> otherwise = {}) const;
    bool truth(bool otherwise) const;
    // An array of `count` numbers, or what is not there: `out` then stays.
    void numbers(float* out, std::size_t count) const;

    bool is_text() const;
    bool is_truth() const;
    std::string json() const;  // as text

  private:
    std::string found() const;
    const nlohmann::json* value_;
    std::string place_;
};

}  // namespace slipface

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "slipface/base/result.h"
#include "warning_list.h"

namespace slipface {

// A name and the line on which it was first used.
struct NameOnLine {
    std::string name;
    std::size_t line = 0;
};

inline constexpr std::size_t longest_obj_line = std::size_t{1} << 20;
inline constexpr std::size_t max_obj_faces = std::size_t{1} << 26;
inline constexpr double largest_obj_coordinate = 1e7;  // in units of the file

// Numbers names in the order in which faces first use them. A name without a face gets no number.
class NameTable {
  public:
    void set(std::string name, std::size_t line) {
        if (name == current_.name) return;
        current_ = {std::move(name), line};
        index_ = no_index;
    }

    std::uint32_t index() {
        if (index_ != no_index) return index_;
        const auto [slot, added] =
            known_.try_emplace(current_.name, static_cast<std::uint32_t>(list_.size()));
        if (added) list_.push_back(current_);
        return index_ = slot->second;
    }

    std::vector<NameOnLine> take() { return std::move(list_); }

  private:
    static constexpr std::uint32_t no_index = 0xFFFFFFFF;
    NameOnLine current_;
    std::uint32_t index_ = no_index;
    std::unordered_map<std::string, std::uint32_t> known_;
    std::vector<NameOnLine> list_;
};

// True if a number can be passed to assimp as it is spelled. Assimp misreads numbers that begin with a point
// and cuts off long ones, so those are rewritten.
bool copies_obj_number(std::string_view word);

// An OBJ file after checking, with its polygons rewritten for a reader that does not check.
struct ObjScan {
    // Only `v x y z`, `vt u v` and `f`, with positive indices and either `v` or `v/vt` throughout. There is a
    // `usemtl` every few million corners, so that no mesh becomes too large for the reader.
    std::string clean;

    std::vector<std::uint32_t> face_first_corner;  // [face + 1], in the order of the file
    std::vector<std::uint32_t> face_material;      // [face] index into materials
    std::vector<std::uint32_t> face_group;         // [face] index into groups
    std::vector<NameOnLine> materials;             // `usemtl` names, in the order in which faces use them
    std::vector<NameOnLine> groups;                // `o` and `g` names, the last before a face
    std::vector<NameOnLine> libraries;             // the arguments of each `mtllib`
};

// The errors are those of import_mesh(). The second argument is the name of the file in messages.
Result<ObjScan> scan_obj(std::string text, const std::string& location, WarningList& warnings);

}  // namespace slipface

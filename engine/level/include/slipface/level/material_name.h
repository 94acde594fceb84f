// Surface types in material names.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "slipface/movement/surface_type.h"

namespace slipface {

// `name` in lower case, with '_' for each space and without endings of a dot and three digits (".001").
// Modelling tools change names in these ways.
std::string normal_name(std::string_view name);

// As normal_name(), but a pattern with wildcards keeps its ending: "*.001" must not become "*".
std::string normal_pattern(std::string_view pattern);

// The type in a name like "stone__ice": the text after the last "__", if it names one of `surfaces`.
std::optional<SurfaceId> suffix_surface(std::string_view name, SurfaceTable surfaces);

// The material name that gives a type: "stone__ice" from "stone", from "stone__ladder" and from
// "stone__ladder.001". Spaces of the type's name become '_'. Nothing if suffix_surface() would not read the
// same type back, for example because the type's name ends in ".001".
std::optional<std::string> typed_material(std::string_view material, SurfaceId surface,
                                          SurfaceTable surfaces);

// The normal name without such a suffix. Writing a face's type into its material's name does not change it.
std::string base_material(std::string_view name, SurfaceTable surfaces);

}  // namespace slipface

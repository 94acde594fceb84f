// What a material's name says.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "slipface/movement/surface_type.h"

namespace slipface {

// Modelling tools rewrite names: lower case, spaces as '_', and an ending of a dot and three digits (".001")
// cut off.
std::string normal_name(std::string_view name);

// As normal_name, except that a pattern with wildcards keeps its ending: "*.001" must not become "*".
std::string normal_pattern(std::string_view pattern);

// The type that "stone__ice" asks for: what follows the last "__", if it names one of `surfaces`.
std::optional<SurfaceId> suffix_surface(std::string_view name, SurfaceTable surfaces);

// The material that asks for a type: "stone__ice" from "stone", from "stone__ladder" and from
// "stone__ladder.001". Spaces of the type's name become '_'. Nothing where the type's name could not be read
// back, as with an ending like ".001" or a space at its end.
std::optional<std::string> typed_material(std::string_view material, SurfaceId surface,
                                          SurfaceTable surfaces);

// The normal name without such a suffix, so that a face is recognised before and after its type is baked into
// its material.
std::string base_material(std::string_view name, SurfaceTable surfaces);

}  // namespace slipface

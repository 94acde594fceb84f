// A model as Wavefront OBJ and MTL text.
#pragma once

#include <string>

#include "model.h"

namespace slipface::generate {

std::string obj_text(const Model& model, const std::string& title, const std::string& mtl_name);

// Only the materials that the model uses.
std::string mtl_text(const Model& model, const std::string& title);

}  // namespace slipface::generate

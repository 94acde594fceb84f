// One name, one look: in files for other programs a material is known by its name alone.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>

#include "slipface/mesh/mesh.h"

namespace slipface {

// The materials of one mesh, as they are added to it.
class MaterialLooks {
  public:
    // A material that keeps its name; of several with one name the first counts.
    void add(const Material& material);
    // Gives a material another name, "stone.001", if one of its name that looks different came before; the
    // same name for the same look. Rules and types in names do not see such an ending.
    void name(Material& material);

  private:
    using Look =
        std::tuple<std::string, float, float, float, std::string, std::shared_ptr<const std::string>>;
    static Look look_of(const Material& material);

    std::map<Look, std::string> names_;
    std::set<std::string> taken_;
    std::map<std::string, std::size_t> numbers_;  // the last that a name was given
};

}  // namespace slipface

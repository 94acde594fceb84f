// Sweep queries from a CSV file.
#pragma once

#include <filesystem>
#include <vector>

#include "slipface/base/result.h"
#include "slipface/base/types.h"

namespace slipface::cli {

struct SweepQuery {
    Vec3 from = Vec3::Zero();
    Vec3 move = Vec3::Zero();
};

// The header is ox,oy,oz,dx,dy,dz, then six finite numbers per line. Empty lines are allowed only at the end.
// Errors name file:line.
Result<std::vector<SweepQuery>> parse_sweep_queries(std::string_view text, const std::string& location);
Result<std::vector<SweepQuery>> load_sweep_queries(const std::filesystem::path& path);

}  // namespace slipface::cli

#include "slipface/level/level_light.h"
#include "slipface/mesh/light_charts.h"

namespace slipface {

bool light_fits(const Mesh& mesh, const LevelLight& light) {
    const Result<LightCharts> charts = light_charts(mesh, light.texel_m);
    return charts && charts->geometry == light.geometry;
}

}  // namespace slipface

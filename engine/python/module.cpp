// import slipface
#include "module.h"

#include "slipface/base/version.h"

PYBIND11_MODULE(slipface, module) {
    module.doc() =
        "Swept ellipsoids against triangles, and the player that they move: levels, sweeps over NumPy "
        "arrays, steps, runs "
        "of tapes, audits, searches. Metres, +Y up, seconds, radians. The same bits as the C++ library.";
    module.attr("__version__") = slipface::program_version();
    slipface::python::add_settings(module);
    slipface::python::add_world(module);
    slipface::python::add_level(module);
}

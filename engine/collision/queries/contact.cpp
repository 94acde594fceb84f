#include "slipface/collision/contact.h"

namespace slipface {

const char* feature_name(Feature feature) {
    switch (feature) {
        case Feature::interior: return "interior";
        case Feature::edge: return "edge";
        case Feature::vertex: return "vertex";
    }
    return "unknown";
}

}  // namespace slipface

// One order of summation for Eigen. With vector instructions Eigen adds the three products of a dot product
// of doubles as (x + y) + z, without them as x + (y + z), and the last bit differs. A processor must not
// decide where a player ends, so this makes the first order that of every build. Included by types.h, before
// any use.
#pragma once

#include <Eigen/Core>
#include <concepts>

namespace Eigen::internal {

// Eigen halves a sum until one term is left; its halves of three terms are one and two. These cut three
// terms into two and one. An Eigen that names its classes differently does not compile here; one that uses
// them differently fails tests/base/tst_sum_order.cpp.
#define SLIPFACE_ADD_IN_ORDER(unroller, Number)                                       \
    template <class Function, class Evaluator, Number Start>                          \
    requires std::same_as<typename Evaluator::Scalar, double>                         \
    struct unroller<Function, Evaluator, Start, 3> {                                  \
        static double run(const Evaluator& terms, const Function& add) {              \
            return add(unroller<Function, Evaluator, Start, 2>::run(terms, add),      \
                       unroller<Function, Evaluator, Start + 2, 1>::run(terms, add)); \
        }                                                                             \
    };
#if EIGEN_VERSION_AT_LEAST(3, 4, 90)
SLIPFACE_ADD_IN_ORDER(redux_novec_unroller, Index)
SLIPFACE_ADD_IN_ORDER(redux_novec_linear_unroller, Index)
#else
SLIPFACE_ADD_IN_ORDER(redux_novec_unroller, int)
#endif
#undef SLIPFACE_ADD_IN_ORDER

}  // namespace Eigen::internal

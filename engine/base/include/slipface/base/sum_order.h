// One order of summation for Eigen. With vector instructions Eigen adds the three products of a dot product
// of doubles as (x + y) + z, without them as x + (y + z), and the last bit differs. A processor must not
// decide where a player ends, so this makes the first order that of every build. Included by types.h, before
// any use.
#pragma once

#include <Eigen/Core>
#include <concepts>

namespace Eigen::internal {

// Eigen halves a sum until one term is left; its halves of three terms are one and two. This one cuts three
// terms into two and one. An Eigen that names this class differently does not compile here; one that uses it
// differently fails tests/base/tst_sum_order.cpp.
template <class Function, class Evaluator, int Start>
requires std::same_as<typename Evaluator::Scalar, double>
struct redux_novec_unroller<Function, Evaluator, Start, 3> {
    static double run(const Evaluator& terms, const Function& add) {
        return add(redux_novec_unroller<Function, Evaluator, Start, 2>::run(terms, add),
                   redux_novec_unroller<Function, Evaluator, Start + 2, 1>::run(terms, add));
    }
};

}  // namespace Eigen::internal

// Why a snapshot is not like its golden: what was done to its inputs, and only if nothing was, the program.
#pragma once

#include "goldens/golden.h"

namespace slipface {

// An input as it was approved and as it is now. Empty facts: there are none on that side.
struct InputPair {
    std::string name;  // "inputs/levels/easy"
    std::string before, after;
    bool same_bytes = false;  // its files have the bytes with which the golden was approved
};

// What was done to an input, and what follows from it. The same bytes that read otherwise are the reader's
// doing.
std::vector<Finding> explain_input(const InputPair& input);

struct Difference {
    const Image& expected;  // masked and of the same size as the actual one; empty: there is none
    const Rendering& actual;
    const std::string& expected_numbers;
    const std::vector<NumberDifference>& numbers;
    const std::vector<InputPair>& inputs;
    CompareTolerance tolerance;
};

// Acts first, then what follows from them. Never empty.
std::vector<Finding> explain(const Difference& difference);

// Whether an act changed something; false: nothing did, or only an order.
bool any_input_changed(const std::vector<Finding>& findings);

}  // namespace slipface

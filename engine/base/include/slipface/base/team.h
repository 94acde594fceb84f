// Processes that do one job together, on one machine or on many. Each has all inputs, does a part of the work
// and receives what the others found, so all hold the same results, whatever their number.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// All processes of a team call the same functions of it in the same order.
class Team {
  public:
    virtual ~Team() = default;
    virtual std::size_t rank() const = 0;  // of this process, 0 to size() - 1
    virtual std::size_t size() const = 0;
    virtual std::string name_of(std::size_t rank) const = 0;  // for messages: "rank 3 on node7"
    // What each process gave, by rank. A process that died ends the whole job.
    virtual std::vector<std::string> gather(const std::string& mine) = 0;
    // The bytes of rank 0; what other ranks give is ignored.
    virtual std::string from_first(const std::string& bytes) = 0;
    // Ends the whole job, for what only a defect of the program brings about.
    [[noreturn]] virtual void stop(const std::string& why) = 0;
};

// Which of `size` processes does an item of work. Of each `size` items in a row every process does one, and
// which one differs from row to row: items that come in patterns are spread evenly.
std::size_t doer_of(std::size_t item, std::size_t size);

// The first error of any process, by rank and with its name, on all of them.
Status agree(Team& team, const Status& mine);

// What must be equal on all processes, such as {"program", "0.2.0 77aa..."}. The error names the first
// process that differs from rank 0, and in what.
Status agree_on(Team& team, const std::vector<std::pair<std::string, std::string>>& facts);

}  // namespace slipface

// A team of MPI ranks.
#pragma once

#include <cstdint>

#include "slipface/base/team.h"

namespace slipface {

class MpiTeam : public Team {
  public:
    // MPI_Init was called; all ranks make theirs together.
    MpiTeam();
    std::size_t rank() const override { return rank_; }
    std::size_t size() const override { return size_; }
    std::string name_of(std::size_t rank) const override;
    std::vector<std::string> gather(const std::string& mine) override;
    std::string from_first(const std::string& bytes) override;
    [[noreturn]] void stop(const std::string& why) override;

    // What gather() moved and how long this rank was in it, waiting included; MPI may spend processor time on
    // waiting.
    struct Traffic {
        std::uint64_t calls = 0, sent = 0, received = 0;  // bytes
        double seconds = 0.0, processor_s = 0.0;
    };
    const Traffic& traffic() const { return traffic_; }

  private:
    std::size_t rank_ = 0, size_ = 1;
    std::vector<std::string> hosts_;  // [rank]
    Traffic traffic_;
};

}  // namespace slipface

// A team of threads of one process, for tests.
#pragma once

#include <barrier>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <thread>

#include "slipface/base/team.h"

namespace slipface::test {

class ThreadTeam {
  public:
    explicit ThreadTeam(std::size_t size) : texts_(size), barrier_(static_cast<std::ptrdiff_t>(size)) {}

    // Runs `job` on every member, each in a thread of its own.
    void run(const std::function<void(Team&)>& job) {
        std::vector<std::thread> threads;
        for (std::size_t rank = 0; rank < texts_.size(); ++rank)
            threads.emplace_back([this, rank, &job] {
                Member member(*this, rank);
                job(member);
            });
        for (std::thread& thread : threads)
            thread.join();
    }

  private:
    class Member : public Team {
      public:
        Member(ThreadTeam& all, std::size_t rank) : all_(all), rank_(rank) {}
        std::size_t rank() const override { return rank_; }
        std::size_t size() const override { return all_.texts_.size(); }
        std::string name_of(std::size_t rank) const override { return "rank " + std::to_string(rank); }
        std::vector<std::string> gather(const std::string& mine) override {
            all_.texts_[rank_] = mine;
            all_.barrier_.arrive_and_wait();
            std::vector<std::string> texts = all_.texts_;
            all_.barrier_.arrive_and_wait();
            return texts;
        }
        std::string from_first(const std::string& bytes) override { return gather(bytes).front(); }
        [[noreturn]] void stop(const std::string& why) override {
            std::fprintf(stderr, "%s\n", why.c_str());
            std::abort();
        }

      private:
        ThreadTeam& all_;
        std::size_t rank_;
    };
    std::vector<std::string> texts_;
    std::barrier<> barrier_;
};

}  // namespace slipface::test

// Work in a background thread: one result, a progress and cancellation.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <thread>

#include "slipface/base/progress.h"

namespace slipface {

// Runs `work` in its own thread. The destructor cancels it and waits for it.
template <class T>
class Background {
  public:
    // The thread calls `done` once the result is ready, to wake the window up; may be empty.
    Background(std::function<T(Progress&)> work, std::function<void()> done)
        : thread_([this, work = std::move(work), done = std::move(done)] {
              T result = work(progress_);  // a named result: GCC 12 wrongly reports a deleted temporary
              result_.emplace(std::move(result));
              ready_ = true;
              if (done) done();
          }) {}
    ~Background() {
        cancel();
        if (thread_.joinable()) thread_.join();
    }
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    const Progress& progress() const { return progress_; }
    void cancel() { progress_.cancel(); }
    bool ready() const { return ready_; }
    T take() {  // waits if it is not ready; call it only once
        if (thread_.joinable()) thread_.join();
        return std::move(*result_);
    }

  private:
    Progress progress_;
    std::atomic<bool> ready_ = false;
    std::optional<T> result_;
    std::thread thread_;
};

}  // namespace slipface

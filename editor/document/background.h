// Work in a background thread: one result, a progress and cancellation.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "slipface/base/progress.h"

namespace slipface {

// Runs `work` in its own thread. The destructor cancels it and waits for it. In a page, which has one thread,
// it does not wait (web/one_thread.cpp): `work` must own all that it uses.
template <class T>
class Background {
  public:
    // The thread calls `done` once the result is ready, to wake the window up; may be empty.
    Background(std::function<T(Progress&)> work, std::function<void()> done)
        : shared_(std::make_shared<Shared>()),
          thread_([shared = shared_, work = std::move(work), done = std::move(done)] {
              std::this_thread::yield();  // in a page: this thread is one to be cut into slices
              T result =
                  work(shared->progress);  // a named result: GCC 12 wrongly reports a deleted temporary
              shared->result.emplace(std::move(result));
              shared->ready = true;
              if (done) done();
          }) {}
    ~Background() {
        cancel();
        if (thread_.joinable()) thread_.join();
    }
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    const Progress& progress() const { return shared_->progress; }
    void cancel() { shared_->progress.cancel(); }
    bool ready() const { return shared_->ready; }
    const T* result() const { return ready() ? &*shared_->result : nullptr; }  // null until it is ready
    T take() {  // waits if it is not ready; call it only once
        if (thread_.joinable()) thread_.join();
        return std::move(*shared_->result);
    }

  private:
    struct Shared {
        Progress progress;
        std::atomic<bool> ready = false;
        std::optional<T> result;
    };
    std::shared_ptr<Shared> shared_;
    std::thread thread_;
};

}  // namespace slipface

// Work in a background thread: one result, a progress and cancellation.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <thread>
#include <type_traits>

#include "slipface/base/progress.h"
#include "slipface/base/result.h"

namespace slipface {

// Runs `work` in its own thread. The destructor cancels it and waits for it. In a page, which has one thread,
// it does not wait (web/one_thread.cpp): `work` must own all that it uses. T is a Result: where `work`
// throws, such as for too little memory, it is that error.
template <class T>
class Background {
    static_assert(std::is_constructible_v<T, Error>);

  public:
    // The thread calls `done` once the result is ready, to wake the window up; may be empty.
    Background(std::function<T(Progress&)> work, std::function<void()> done)
        : shared_(std::make_shared<Shared>()),
          thread_([shared = shared_, work = std::move(work), done = std::move(done)] {
              std::this_thread::yield();  // in a page: this thread is one to be cut into slices
              try {
                  T result =
                      work(shared->progress);  // a named result: GCC 12 wrongly reports a deleted temporary
                  shared->result.emplace(std::move(result));
              } catch (const std::bad_alloc&) {
                  shared->result.emplace(Error{"", "out of memory"});  // too short to need memory
              } catch (const std::exception& error) {
                  shared->result.emplace(Error{"", error.what()});
              }
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

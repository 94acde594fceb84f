// Progress and cancellation of a long task. The thread that works writes; another thread reads and cancels.
#pragma once

#include <atomic>
#include <filesystem>
#include <thread>

#include "slipface/base/result.h"

namespace slipface {

class Progress {
  public:
    // Starts `stage`, a string literal that windows show ("Reading faces"). It covers the part from `begin`
    // to `end` of the whole task, both from 0 to 1.
    void begin(const char* stage, double begin, double end) {
        stage_ = stage;
        begin_ = begin;
        end_ = end;
        fraction_ = begin;
    }
    // `done`: fraction of the current stage, 0 to 1.
    void advance(double done) { fraction_ = begin_ + (end_ - begin_) * done; }

    const char* stage() const { return stage_; }
    double fraction() const { return fraction_; }  // of the whole task, 0 to 1

    // Requests that the task stop. It does so at the next opportunity, discards its work and returns an
    // error.
    void cancel() { cancelled_ = true; }
    // The task asks this often. Each time it gives way to other threads that wait for its processor.
    bool cancelled() const {
        std::this_thread::yield();
        return cancelled_;
    }

  private:
    std::atomic<const char*> stage_ = "";
    std::atomic<double> begin_ = 0.0, end_ = 1.0, fraction_ = 0.0;
    std::atomic<bool> cancelled_ = false;
};

// The same functions for a task that may have no Progress (a null pointer).
inline void begin_stage(Progress* progress, const char* stage, double begin, double end) {
    if (progress != nullptr) progress->begin(stage, begin, end);
}
inline void advance(Progress* progress, double done) {
    if (progress != nullptr) progress->advance(done);
}
inline bool cancelled(const Progress* progress) {
    return progress != nullptr && progress->cancelled();
}

// The error that a cancelled task returns.
inline Error cancelled_error(const std::filesystem::path& path) {
    return {path.string(), "was not opened: it was cancelled"};
}

}  // namespace slipface

// How far a long task is, and the wish to stop it. One thread works and writes, another looks and cancels.
#pragma once

#include <atomic>
#include <filesystem>

#include "slipface/base/result.h"

namespace slipface {

class Progress {
  public:
    // The task has come to `stage` (a literal, as windows show it: "Reading faces"), which is the part from
    // `begin` to `end` of the whole, 0 to 1.
    void begin(const char* stage, double begin, double end) {
        stage_ = stage;
        begin_ = begin;
        end_ = end;
        fraction_ = begin;
    }
    // `done` of the stage, 0 to 1.
    void advance(double done) { fraction_ = begin_ + (end_ - begin_) * done; }

    const char* stage() const { return stage_; }
    double fraction() const { return fraction_; }  // 0 to 1, of the whole

    // The task stops at the next opportunity and returns an error; what it had made is thrown away.
    void cancel() { cancelled_ = true; }
    bool cancelled() const { return cancelled_; }

  private:
    std::atomic<const char*> stage_ = "";
    std::atomic<double> begin_ = 0.0, end_ = 1.0, fraction_ = 0.0;
    std::atomic<bool> cancelled_ = false;
};

// The same where nobody looks.
inline void begin_stage(Progress* progress, const char* stage, double begin, double end) {
    if (progress != nullptr) progress->begin(stage, begin, end);
}
inline void advance(Progress* progress, double done) {
    if (progress != nullptr) progress->advance(done);
}
inline bool cancelled(const Progress* progress) {
    return progress != nullptr && progress->cancelled();
}

// What a task that was cancelled returns.
inline Error cancelled_error(const std::filesystem::path& path) {
    return {path.string(), "was not opened: it was cancelled"};
}

}  // namespace slipface

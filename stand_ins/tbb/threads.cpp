#include "threads.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace slipface_threads {
namespace {

std::size_t processor_threads() {
    static const std::size_t count = std::max(1U, std::thread::hardware_concurrency());
    return count;
}

struct Job {
    const std::function<void(std::size_t)>& body;
    const std::size_t parts;
    std::size_t room;  // for helpers that may still join
    std::atomic<std::size_t> next{0};
    std::size_t helpers = 0;  // at work now
    std::exception_ptr failure;
};

class Pool {
  public:
    void run(Job& job) {
        {
            const std::lock_guard lock(mutex_);
            for (; threads_ < job.room; ++threads_)
                std::thread([this] { help(); }).detach();
            jobs_.push_back(&job);
        }
        work_.notify_all();
        take_parts(job);
        std::unique_lock lock(mutex_);
        // No thread joins any more. A thread at work finishes its part of this job and waits for no other
        // job's caller.
        std::erase(jobs_, &job);
        ended_.wait(lock, [&] { return job.helpers == 0; });
    }

  private:
    void take_parts(Job& job) {
        for (std::size_t part; (part = job.next.fetch_add(1)) < job.parts;) {
            try {
                job.body(part);
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (!job.failure) job.failure = std::current_exception();
                job.next = job.parts;
            }
        }
    }
    Job* open_job() const {
        for (Job* const job : jobs_)
            if (job->room > 0 && job->next < job->parts) return job;
        return nullptr;
    }
    void help() {
        std::unique_lock lock(mutex_);
        for (;;) {
            work_.wait(lock, [&] { return open_job() != nullptr; });
            Job& job = *open_job();
            --job.room;
            ++job.helpers;
            lock.unlock();
            take_parts(job);
            lock.lock();
            if (--job.helpers == 0) ended_.notify_all();
        }
    }

    std::mutex mutex_;
    std::condition_variable work_, ended_;
    std::vector<Job*> jobs_;
    std::size_t threads_ = 0;
};

// Never destroyed: at the end of a process Windows stops the threads before it lets libraries clean up.
Pool& pool() {
    static Pool* const only = new Pool;
    return *only;
}

std::mutex limits_mutex;
std::multiset<std::size_t>& limits() {
    static std::multiset<std::size_t> all;
    return all;
}
thread_local std::size_t arena = 0;  // 0: none

}  // namespace

void run(std::size_t parts, const std::function<void(std::size_t)>& body) {
    const std::size_t threads = std::min(parts, allowed());
    if (threads <= 1) {
        for (std::size_t part = 0; part < parts; ++part)
            body(part);
        return;
    }
    Job job{.body = body, .parts = parts, .room = threads - 1};
    pool().run(job);
    if (job.failure) std::rethrow_exception(job.failure);
}

std::size_t allowed() {
    return std::min(limit(), arena > 0 ? arena : processor_threads());
}

std::size_t limit() {
    const std::lock_guard lock(limits_mutex);
    return limits().empty() ? processor_threads() : *limits().begin();
}

void add_limit(std::size_t threads) {
    const std::lock_guard lock(limits_mutex);
    limits().insert(std::max<std::size_t>(threads, 1));
}

void remove_limit(std::size_t threads) {
    const std::lock_guard lock(limits_mutex);
    limits().erase(limits().find(std::max<std::size_t>(threads, 1)));
}

Arena::Arena(std::size_t threads) : before_(arena) {
    arena = std::max<std::size_t>(threads, 1);
}

Arena::~Arena() {
    arena = before_;
}

}  // namespace slipface_threads

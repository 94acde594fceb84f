#include "slipface/base/parallel.h"

#include <algorithm>
#include <exception>
#include <mutex>

#include "own_threads.h"

namespace slipface {

namespace {

JobSystem host;

struct Portions {
    const std::function<void(std::size_t, std::size_t)>& body;
    std::size_t count, portions;
    std::once_flag first{};
    std::exception_ptr thrown{};

    // Nothing is thrown through the program's job system.
    static void run(void* data, std::size_t i) noexcept {
        Portions& all = *static_cast<Portions*>(data);
        try {
            all.body(all.count * i / all.portions, all.count * (i + 1) / all.portions);
        } catch (...) {
            std::call_once(all.first, [&] { all.thrown = std::current_exception(); });
        }
    }
};

}  // namespace

void set_job_system(const JobSystem& jobs) {
    host = jobs;
}

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
    grain = std::max<std::size_t>(grain, 1);
    if (count == 0) return;
    if (count <= grain) return body(0, count);
    if (host.run == nullptr) return run_on_own_threads(count, grain, body);
    // Some more than threads, so that one that is late holds up little.
    const auto most = static_cast<std::size_t>(4 * std::max(1, host.threads));
    Portions all{body, count, std::min(most, (count + grain - 1) / grain)};
    host.run(host.user, all.portions, Portions::run, &all);
    if (all.thrown) std::rethrow_exception(all.thrown);
}

int parallel_threads() {
    return host.run == nullptr ? own_threads() : std::max(1, host.threads);
}

}  // namespace slipface

#include "calls.h"
#include "slipface/base/parallel.h"

using namespace slipface;
using namespace slipface::c;

slipface_status slipface_set_jobs(slipface_run_jobs run_jobs, void* user, uint32_t threads,
                                  slipface_error* error) {
    return run(error, [&] {
        constexpr std::uint32_t most = 4096;
        if (run_jobs != nullptr && (threads == 0 || threads > most))
            refuse(SLIPFACE_WRONG_ARGUMENT, "threads: found {}, expected 1 to {}", threads, most);
        set_job_system({run_jobs, user, static_cast<int>(threads)});
    });
}

// Threads of a page that has only one. The linker puts these in place of emscripten's, which fail.
//
// A thread's function runs at once, on the caller's. Where the browser can suspend a call (JavaScript Promise
// Integration), one that yields is cut into slices: pthread_create() returns after the first, and the page
// draws and takes events between the others. In other browsers, and in node, it ends before pthread_create()
// returns. A join does not wait for a thread that is suspended: the thread must own all it uses
// (document/background.h).
#include <emscripten.h>
#include <errno.h>
#include <pthread.h>
#include <spawn.h>
#include <stdlib.h>

extern "C" {

// Of emscripten: the stack in memory, which is not suspended with a call. It grows down.
void* stackSave();
void stackRestore(void* top);

struct Call {
    void* (*function)(void*);
    void* argument;
    char* stack;
    void* caller;  // the stack of who let it run
    bool sliced, ended, joined;
};

constexpr size_t stack_bytes = 2 << 20;  // as much as the page's own
constexpr size_t stack_alignment = 16;   // as compiled code expects it
constexpr double slice_ms = 12.0;
static Call* running = nullptr;
static double slice_end_ms = 0.0;

EM_JS(int, page_suspends_calls, (), { return typeof Slipface == "object" && Slipface.suspends ? 1 : 0; });
EM_JS(void, begin_call, (Call * call), { Slipface.begin_call(call); });
// Comes back when the page has had its turn: page.js makes it a function that suspends its caller.
EM_JS(void, page_turn, (), { return Slipface.turn(); });

static void free_call(Call* call) {
    free(call->stack);
    delete call;
}

// page.js makes it a function that can be suspended.
EMSCRIPTEN_KEEPALIVE void slipface_call(Call* call) {
    stackRestore(call->stack + stack_bytes);
    call->function(call->argument);
    stackRestore(call->caller);
    running = nullptr;
    call->ended = true;
    if (call->joined) free_call(call);
}

int slipface_in_slices() {
    return running != nullptr && running->sliced ? 1 : 0;
}

// Ends the slice if it is long enough.
void slipface_turn() {
    Call* const call = running;
    if (slipface_in_slices() == 0 || emscripten_get_now() < slice_end_ms) return;
    void* const top = stackSave();
    running = nullptr;
    stackRestore(call->caller);
    page_turn();
    call->caller = stackSave();
    stackRestore(top);
    running = call;
    slice_end_ms = emscripten_get_now() + slice_ms;
}

int __wrap_sched_yield() {
    if (running != nullptr) running->sliced = true;
    slipface_turn();
    return 0;
}

int __wrap_pthread_create(pthread_t* thread, const pthread_attr_t*, void* (*function)(void*),
                          void* argument) {
    char* const stack = page_suspends_calls() != 0
                            ? static_cast<char*>(aligned_alloc(stack_alignment, stack_bytes))
                            : nullptr;
    Call* const call = new Call{function, argument, stack, stackSave(), false, false, false};
    *thread = reinterpret_cast<pthread_t>(call);
    if (stack == nullptr) {
        function(argument);
        call->ended = true;
        return 0;
    }
    void* const top = stackSave();
    Call* const outer = running;
    running = call;
    slice_end_ms = emscripten_get_now() + slice_ms;
    begin_call(call);
    stackRestore(top);
    running = outer;
    return 0;
}

int __wrap_pthread_join(pthread_t thread, void**) {
    Call* const call = reinterpret_cast<Call*>(thread);
    call->joined = true;
    if (call->ended) free_call(call);
    return 0;
}

int __wrap_pthread_detach(pthread_t thread) {
    return __wrap_pthread_join(thread, nullptr);
}

// Nor are there other processes. The callers say which program they cannot run.
int posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                 char* const*, char* const*) {
    return ENOSYS;
}
}

// Threads of a page that has only one: the function runs at once, on the caller's. The linker puts these in
// place of emscripten's, which fail.
#include <errno.h>
#include <pthread.h>
#include <spawn.h>

extern "C" {

int __wrap_pthread_create(pthread_t* thread, const pthread_attr_t*, void* (*function)(void*),
                          void* argument) {
    static unsigned long last = 0;
    *thread = reinterpret_cast<pthread_t>(++last);
    function(argument);
    return 0;
}

int __wrap_pthread_join(pthread_t, void**) {
    return 0;
}

int __wrap_pthread_detach(pthread_t) {
    return 0;
}

// Nor are there other processes. The callers say which program they cannot run.
int posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                 char* const*, char* const*) {
    return ENOSYS;
}
}

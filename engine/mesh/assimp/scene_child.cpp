#include "assimp/scene_child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <new>

#include "assimp/soup_bytes.h"
#include "bsp/import_bsp.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "slipface/mesh/formats.h"
#include "slipface/mesh/scene_child.h"

extern char** environ;

namespace slipface {
namespace {

constexpr int answer_fd = 3;
constexpr int out_of_memory = 3, out_of_stack = 4, cannot_write = 5;  // exit codes of the child

std::vector<std::string>& child_command() {
    static std::vector<std::string> command;
    return command;
}

struct Limits {
    std::size_t memory;  // bytes of address space
    unsigned seconds;    // of processor time
};

// Files of other programs grow to about 20 times their size in assimp.
Limits limits_for(std::size_t file_size) {
    return {(std::size_t{2} << 30) + 64 * file_size, 10 + static_cast<unsigned>(file_size >> 20)};
}

struct Child {
    pid_t pid = -1;
    int from = -1;
};

Result<Child> start_child(const std::string& location, const Limits& limits, std::size_t max_warnings) {
    int out[2];
    if (::pipe2(out, O_CLOEXEC) != 0) return Error{location, "cannot be read: no pipe to a reader"};
    std::vector<std::string> line = child_command();
    line.insert(line.end(), {location, std::to_string(limits.memory), std::to_string(limits.seconds),
                             std::to_string(max_warnings)});
    std::vector<char*> words;
    for (std::string& word : line)
        words.push_back(word.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    // What assimp prints would only confuse; dup2 to the same number would leave it to be closed.
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int high = ::fcntl(out[1], F_DUPFD_CLOEXEC, answer_fd + 1);
    posix_spawn_file_actions_adddup2(&actions, high, answer_fd);
    Child child;
    const int failure = ::posix_spawn(&child.pid, words[0], &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(out[1]);
    if (high >= 0) ::close(high);
    if (failure != 0) {
        ::close(out[0]);
        return Error{location,
                     fmt::format("cannot be read: no process for a reader ({})", std::strerror(failure))};
    }
    child.from = out[0];
    return child;
}

// Everything that the child writes until it ends. False: cancelled, or more than `limit` bytes.
bool receive(int from, std::string& bytes, std::size_t limit, Progress* progress) {
    std::vector<char> block(std::size_t{1} << 20);
    for (;;) {
        pollfd ready{from, POLLIN, 0};
        const int events = ::poll(&ready, 1, 50);
        if (cancelled(progress)) return false;
        if (events <= 0) continue;
        const ssize_t read = ::read(from, block.data(), block.size());
        if (read < 0 && errno == EINTR) continue;
        if (read <= 0) return true;
        if (bytes.size() + static_cast<std::size_t>(read) > limit) return false;
        bytes.append(block.data(), static_cast<std::size_t>(read));
    }
}

// How a child ended that gave no answer.
std::string reason_of(int status, const Limits& limits) {
    const std::string memory = fmt::format("needs more than {} MB of memory to read", limits.memory >> 20);
    if (WIFEXITED(status) && WEXITSTATUS(status) == out_of_memory) return memory;
    if (WIFEXITED(status) && WEXITSTATUS(status) == out_of_stack) return "is nested too deeply for assimp";
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        return fmt::format("takes longer to read than {} s of processor time", limits.seconds);
    if (WIFSIGNALED(status))
        return fmt::format("crashes assimp ({}); the file may be damaged", ::strsignal(WTERMSIG(status)));
    return fmt::format("could not be read: the reader ended with code {}", WEXITSTATUS(status));
}

}  // namespace

void read_scenes_in_child(std::vector<std::string> command) {
    child_command() = std::move(command);
}

std::optional<Result<ImportedSoup>> import_scene_in_child(const std::filesystem::path& path,
                                                          std::string_view bytes, WarningList& warnings,
                                                          Progress* progress) {
    if (child_command().empty()) return std::nullopt;
    const std::string location = path.string();
    const Limits limits = limits_for(bytes.size());
    const Result<Child> child = start_child(location, limits, warnings.room());
    if (!child) return child.error();
    std::string answered;
    const bool received = receive(child->from, answered, limits.memory, progress);
    ::close(child->from);
    if (!received) ::kill(child->pid, SIGKILL);
    int status = 0;
    while (::waitpid(child->pid, &status, 0) < 0 && errno == EINTR) {
    }
    if (cancelled(progress)) return cancelled_error(path);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return Error{location, reason_of(status, limits)};
    std::optional<SceneAnswer> answer = answer_from_bytes(answered);
    if (!answer) return Error{location, "could not be read: the reader's answer is damaged"};
    if (answer->error) return *answer->error;
    if (!(answer->stamp == file_stamp(bytes))) return Error{location, "changed while it was read"};
    for (Diagnostic& warning : answer->warnings)
        warnings.add(warning.location, std::move(warning.message));
    return std::move(answer->scene);
}

namespace {

// In the child: a signal on a stack of its own says whether the program's stack was used up.
const char* stack_top = nullptr;

void end_on_fault(int signal, siginfo_t* info, void*) {
    rlimit stack{};
    ::getrlimit(RLIMIT_STACK, &stack);
    const char* const fault = static_cast<const char*>(info->si_addr);
    const std::ptrdiff_t depth = stack_top - fault;
    if (depth > 0 && static_cast<rlim_t>(depth) > stack.rlim_cur - (1U << 20)) ::_exit(out_of_stack);
    ::signal(signal, SIG_DFL);
    ::raise(signal);
}

void watch_stack() {
    static std::array<char, 1 << 16> own_stack;
    const char here = 0;
    stack_top = &here;
    const stack_t alternative{.ss_sp = own_stack.data(), .ss_flags = 0, .ss_size = own_stack.size()};
    ::sigaltstack(&alternative, nullptr);
    struct sigaction action {};
    action.sa_sigaction = end_on_fault;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    for (const int signal : {SIGSEGV, SIGBUS})
        ::sigaction(signal, &action, nullptr);
}

void set_limit(int resource, rlim_t limit) {
    const rlimit both{limit, limit};
    ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

void set_limits(const Limits& limits) {
    set_limit(RLIMIT_CORE, 0);
    set_limit(RLIMIT_CPU, limits.seconds);
    set_limit(RLIMIT_STACK, 8U << 20);
#if !defined(__SANITIZE_ADDRESS__)  // which reserves terabytes for itself
    set_limit(RLIMIT_AS, limits.memory);
#endif
    std::set_new_handler([] { ::_exit(out_of_memory); });
    watch_stack();
}

bool write_all(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(answer_fd, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

SceneAnswer read_answer(const std::filesystem::path& path, std::size_t max_warnings) {
    SceneAnswer answer;
    Result<std::string> bytes = read_file(path, max_geometry_bytes);
    if (!bytes) {
        answer.error = bytes.error();
        return answer;
    }
    answer.stamp = file_stamp(*bytes);
    std::string extension = to_lower(path.extension().string());
    extension.erase(0, 1);
    WarningList warnings(max_warnings);
    Result<ImportedSoup> scene = extension == "bsp"
                                     ? import_bsp(*bytes, path.string(), warnings, nullptr)
                                     : read_scene(path, extension, std::move(*bytes), warnings, nullptr);
    if (scene) {
        answer.scene = std::move(*scene);
    } else {
        answer.error = scene.error();
    }
    answer.warnings = warnings.take(path.string());
    return answer;
}

}  // namespace

int read_scene_as_child(const std::vector<std::string>& arguments) {
    if (arguments.size() != 4) return 64;
    const auto memory = parse_int(arguments[1]), seconds = parse_int(arguments[2]),
               max_warnings = parse_int(arguments[3]);
    if (!memory || !seconds || !max_warnings) return 64;
    set_limits({static_cast<std::size_t>(*memory), static_cast<unsigned>(*seconds)});
    const SceneAnswer answer = read_answer(arguments[0], static_cast<std::size_t>(*max_warnings));
    return write_all(answer_to_bytes(answer)) ? 0 : cannot_write;
}

}  // namespace slipface

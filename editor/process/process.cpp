#include "process/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <string_view>
#include <system_error>
#include <thread>

extern char** environ;

namespace slipface {

namespace {

constexpr auto first_look = std::chrono::milliseconds(2), longest_look = std::chrono::milliseconds(50);

std::vector<char*> pointers_to(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

// A shell sets the limits and becomes the program: a process can limit none but itself.
std::vector<std::string> with_limits(const ProcessLimits& limits, const std::vector<std::string>& words) {
    std::vector<std::string> line{"/bin/sh", "-c",
                                  fmt::format("ulimit -c 0; ulimit -t {}; ulimit -v {}; exec \"$@\"",
                                              limits.processor_s, limits.memory_bytes / 1024),
                                  "sh"};
    line.insert(line.end(), words.begin(), words.end());
    return line;
}

std::vector<std::string> environment_with(const std::vector<std::pair<std::string, std::string>>& added) {
    std::vector<std::string> variables;
    for (char** variable = environ; *variable != nullptr; ++variable)
        variables.emplace_back(*variable);
    for (const auto& [name, value] : added) {
        std::erase_if(variables, [&, known = name + "="](const std::string& variable) {
            return variable.starts_with(known);
        });
        variables.push_back(name + "=" + value);
    }
    return variables;
}

void connect(posix_spawn_file_actions_t& actions, int number, const Stream& stream) {
    const int how = number == STDIN_FILENO ? O_RDONLY : O_WRONLY | O_CREAT | O_TRUNC;
    if (const int* const descriptor = std::get_if<int>(&stream))
        posix_spawn_file_actions_adddup2(&actions, *descriptor, number);
    else if (const auto* const file = std::get_if<std::filesystem::path>(&stream))
        posix_spawn_file_actions_addopen(&actions, number, file->c_str(), how, 0666);
    else
        posix_spawn_file_actions_addopen(&actions, number, "/dev/null", how, 0666);
}

int code_of(int status) {
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

std::pair<pid_t, int> wait(pid_t process, int options) {
    int status = 0;
    pid_t ended = 0;
    while ((ended = ::waitpid(process, &status, options)) < 0 && errno == EINTR) {
    }
    return {ended, ended > 0 ? code_of(status) : -1};
}

}  // namespace

Result<pid_t> start_process(const ProcessStart& start) {
    std::vector<std::string> words = start.words;
    words.insert(words.begin(), start.program.empty() ? "slipface" : start.program);
    if (start.limits) words = with_limits(*start.limits, words);
    std::vector<std::string> variables = environment_with(start.environment);
    const std::string program = start.limits            ? words.front()
                                : start.program.empty() ? "/proc/self/exe"
                                                        : start.program;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    connect(actions, STDIN_FILENO, start.in);
    connect(actions, STDOUT_FILENO, start.out);
    connect(actions, STDERR_FILENO, start.err);
    if (!start.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, start.folder.c_str());
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    if (start.limits) {
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setpgroup(&attributes, 0);
    }
    pid_t process = -1;
    const int failure = ::posix_spawnp(&process, program.c_str(), &actions, &attributes,
                                       pointers_to(words).data(), pointers_to(variables).data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0)
        return Error{start.folder.string(),
                     "cannot start another process: " + std::generic_category().message(failure)};
    return process;
}

int wait_for(pid_t process) {
    return wait(process, 0).second;
}

std::optional<int> wait_for(pid_t process, double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    auto pause = first_look;
    while (Clock::now() < end) {
        if (const auto [ended, code] = wait(process, WNOHANG); ended != 0) {
            ::kill(-process, SIGKILL);  // what it started and left behind
            return code;
        }
        std::this_thread::sleep_for(pause);
        pause = std::min(2 * pause, longest_look);
    }
    ::kill(-process, SIGKILL);
    wait(process, 0);
    return std::nullopt;
}

std::pair<pid_t, int> wait_for_any() {
    return wait(-1, 0);
}

std::string ending_text(int code) {
    if (code < 0) return "the process has ended";
    return code > 128 ? fmt::format("the process ended by signal {}", code - 128)
                      : fmt::format("the process ended with code {}", code);
}

}  // namespace slipface

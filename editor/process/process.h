// Starting other programs, and waiting for them: the one place where the editor does.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// Where a stream of a process goes: nowhere, an open descriptor of this process, or a file, written anew.
using Stream = std::variant<std::monostate, int, std::filesystem::path>;

// What a process and all that it starts may use. They get a process group of their own.
struct ProcessLimits {
    int processor_s = 0;             // seconds of processor time
    std::uint64_t memory_bytes = 0;  // address space
};

struct ProcessStart {
    std::vector<std::string> words;     // the arguments
    std::string program = {};           // searched for in PATH; empty: this program
    std::filesystem::path folder = {};  // in which it runs; empty: this process's
    std::vector<std::pair<std::string, std::string>> environment = {};  // besides this process's
    Stream in = {}, out = {}, err = 2;
    std::optional<ProcessLimits> limits = {};  // of another program
};

Result<pid_t> start_process(const ProcessStart& start);

// How a process ended: its exit code, or 128 + the signal that ended it. Below 0: there is no such process.
int wait_for(pid_t process);
// Ends a process that was started with limits, with all of its group, when it takes longer. Nothing: it did.
std::optional<int> wait_for(pid_t process, double seconds);
// Of all processes that were started the next that ends. Below 0: there is none.
std::pair<pid_t, int> wait_for_any();

// "the process ended by signal 11", "the process ended with code 1"
std::string ending_text(int code);

}  // namespace slipface

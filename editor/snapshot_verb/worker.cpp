#include "snapshot_verb/worker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <iostream>

#include "cli/exit_codes.h"
#include "goldens/report.h"
#include "process/process.h"
#include "slipface/base/files.h"

namespace slipface {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view renderer_mark = "#renderer ";

const char* kind_name(WorkKind kind) {
    constexpr std::array names{"check", "render", "approve"};
    return names[static_cast<std::size_t>(kind)];
}

GoldenResult failed(const std::string& name, const std::string& why) {
    GoldenResult result;
    result.name = name;
    result.state = GoldenState::failed;
    result.message = why;
    return result;
}

GoldenResult render_to_folder(const Snapshot& snapshot, const fs::path& out) {
    const Result<Rendering> rendering = snapshot.render();
    if (!rendering) return failed(snapshot.name, rendering.error().text());
    const fs::path path = out / (snapshot.name + (is_input(snapshot.name) ? ".json" : ".png"));
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (!is_input(snapshot.name))
        if (Status status = save_png(path, rendering->image); !status)
            return failed(snapshot.name, status.error().text());
    if (!rendering->numbers.empty()) {
        const fs::path numbers = out / (snapshot.name + ".json");
        if (Status status = write_file_atomic(numbers, rendering->numbers); !status)
            return failed(snapshot.name, status.error().text());
    }
    GoldenResult result;
    result.name = snapshot.name;
    result.state = GoldenState::same;
    result.message = path.string();
    return result;
}

GoldenResult approve(const Snapshot& snapshot, const WorkArguments& arguments) {
    const Result<Rendering> rendering = snapshot.render();
    if (!rendering) return failed(snapshot.name, rendering.error().text());
    const bool software = rendering->numbers.find("\"renderer\": {") == std::string::npos ||
                          rendering->numbers.find("llvmpipe") != std::string::npos;
    if (!software && !arguments.any_renderer)
        return failed(snapshot.name,
                      "not rendered by Mesa's llvmpipe: other machines give other pixels (use --any-renderer "
                      "to approve it)");
    const Result<Rendering> again = snapshot.render();
    if (!again) return failed(snapshot.name, again.error().text());
    if (const std::string unstable = what_repeats_otherwise(snapshot, *rendering, *again); !unstable.empty())
        return failed(snapshot.name, unstable + "; mask what changes by itself, or make it stand still");
    const auto written =
        approve_golden(arguments.suite.goldens, snapshot, *rendering,
                       {.force = arguments.force, .packed = !arguments.quick, .here = arguments.here});
    if (!written) return failed(snapshot.name, written.error().text());
    GoldenResult result;
    result.name = snapshot.name;
    result.state = GoldenState::same;
    for (const std::string& file : *written)
        result.message += (result.message.empty() ? "wrote " : ", ") + file;
    return result;
}

// One process and its current work.
struct Worker {
    pid_t pid = -1;
    int to = -1, from = -1;
    std::string name;    // its current snapshot
    std::string buffer;  // read, but not a complete line yet

    bool send(const std::string& next) {
        name = next;
        const std::string line = next + "\n";
        return ::write(to, line.data(), line.size()) == static_cast<ssize_t>(line.size());
    }
    std::string end() {  // how the process ended, as text
        if (to >= 0) ::close(to);
        if (from >= 0) ::close(from);
        to = from = -1;
        const int code = pid > 0 ? wait_for(pid) : -1;
        pid = -1;
        return ending_text(code);
    }
};

std::vector<std::string> worker_command(const WorkArguments& arguments) {
    std::vector<std::string> line{"snapshot", "worker",     "--kind", kind_name(arguments.kind),
                                  "--out",    arguments.out};
    if (arguments.twice) line.push_back("--twice");
    if (arguments.force) line.push_back("--force");
    if (arguments.quick) line.push_back("--quick");
    if (arguments.here) line.push_back("--here");
    if (arguments.any_renderer) line.push_back("--any-renderer");
    const std::vector<std::string> suite = arguments.suite.as_command_line();
    line.insert(line.end(), suite.begin(), suite.end());
    return line;
}

Result<Worker> start_worker(const WorkArguments& arguments) {
    int in[2], out[2];
    if (::pipe2(in, O_CLOEXEC) != 0) return Error{"worker", "cannot create a pipe"};
    if (::pipe2(out, O_CLOEXEC) != 0) {
        ::close(in[0]);
        ::close(in[1]);
        return Error{"worker", "cannot create a pipe"};
    }
    const Result<pid_t> process =
        start_process({.words = worker_command(arguments), .in = in[0], .out = out[1]});
    ::close(in[0]);
    ::close(out[1]);
    Worker worker{.pid = process ? *process : -1, .to = in[1], .from = out[0], .name = {}, .buffer = {}};
    if (process) return worker;
    worker.end();
    return process.error();
}

// Hands out names until none is left and all workers are idle.
class Pool {
  public:
    Pool(const WorkArguments& arguments, const std::vector<std::string>& names,
         const std::function<void(const GoldenResult&)>& done)
        : arguments_(arguments), left_(names.begin(), names.end()), done_(done) {}
    ~Pool() {
        for (Worker& worker : workers_)
            worker.end();
    }
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;

    Status run() {
        ::signal(SIGPIPE, SIG_IGN);
        const std::size_t wanted = std::min(left_.size(), static_cast<std::size_t>(arguments_.jobs));
        for (std::size_t i = 0; i < wanted; ++i)
            if (Status status = add(); !status) return status;
        while (!workers_.empty()) {
            std::vector<pollfd> ready;
            for (const Worker& worker : workers_)
                ready.push_back({worker.from, POLLIN, 0});
            if (::poll(ready.data(), ready.size(), -1) < 0) continue;
            for (std::size_t i = ready.size(); i-- > 0;)
                if (ready[i].revents != 0 && !read_from(i)) {
                    if (Status status = bury(i); !status) return status;
                }
        }
        return {};
    }
    std::string renderer;

  private:
    Status add() {
        Result<Worker> worker = start_worker(arguments_);
        if (!worker) return worker.error();
        workers_.push_back(*std::move(worker));
        next(workers_.back());
        return {};
    }
    void next(Worker& worker) {
        worker.name.clear();
        if (left_.empty()) {
            ::close(worker.to);
            worker.to = -1;
            return;
        }
        worker.send(left_.front());
        left_.pop_front();
    }
    // False when the process has ended.
    bool read_from(std::size_t index) {
        Worker& worker = workers_[index];
        std::array<char, 65536> bytes{};
        const ssize_t count = ::read(worker.from, bytes.data(), bytes.size());
        if (count <= 0) return false;
        worker.buffer.append(bytes.data(), static_cast<std::size_t>(count));
        for (std::size_t end = worker.buffer.find('\n'); end != std::string::npos;
             end = worker.buffer.find('\n')) {
            const std::string line = worker.buffer.substr(0, end);
            worker.buffer.erase(0, end + 1);
            if (line.starts_with(renderer_mark)) renderer = line.substr(renderer_mark.size());
            if (!line.starts_with('{')) continue;
            const Result<GoldenResult> result = entry_from_json(line, worker.name);
            done_(result ? *result : failed(worker.name, result.error().text()));
            next(worker);
        }
        return true;
    }
    Status bury(std::size_t index) {
        Worker worker = std::move(workers_[index]);
        workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(index));
        const std::string why = worker.end();
        if (!worker.name.empty()) done_(failed(worker.name, why));
        return left_.empty() ? Status() : add();
    }

    const WorkArguments& arguments_;
    std::deque<std::string> left_;
    const std::function<void(const GoldenResult&)>& done_;
    std::vector<Worker> workers_;
};

}  // namespace

GoldenResult do_work(Studio& studio, const WorkArguments& arguments, const std::string& name) {
    const Result<Snapshot> snapshot = studio.find(name);
    if (!snapshot) return failed(name, snapshot.error().text());
    const double before = studio.drawing_s();
    GoldenResult result;
    if (arguments.kind == WorkKind::render) {
        result = render_to_folder(*snapshot, arguments.out);
    } else if (arguments.kind == WorkKind::approve) {
        result = approve(*snapshot, arguments);
    } else {
        result = check_snapshot(*snapshot, arguments.suite.goldens, arguments.out, arguments.twice);
    }
    result.drawing_s = studio.drawing_s() - before;
    result.coverage = studio.new_coverage();
    return result;
}

Result<std::string> do_all_work(const WorkArguments& arguments, const SuiteSet& set,
                                const std::vector<std::string>& names,
                                const std::function<void(const GoldenResult&)>& done) {
    if (arguments.jobs <= 1 || names.size() <= 1) {
        Studio studio(set);
        for (const std::string& name : names)
            done(do_work(studio, arguments, name));
        return studio.renderer();
    }
    // One rendering thread per process, because there are as many processes as processors.
    ::setenv("LP_NUM_THREADS", "0", 0);
    Pool pool(arguments, names, done);
    if (Status status = pool.run(); !status) return status.error();
    return pool.renderer;
}

int run_worker(const WorkArguments& arguments) {
    Result<SuiteSet> set = load_suite_set(arguments.suite);
    if (!set) {
        std::cerr << "slipface: " << set.error().text() << "\n";
        return cli::exit_bad_input;
    }
    Studio studio(*std::move(set));
    bool sent = false;
    for (std::string name; std::getline(std::cin, name);) {
        const GoldenResult result = do_work(studio, arguments, name);
        if (!sent && !studio.renderer().empty()) {
            std::cout << renderer_mark << studio.renderer() << "\n";
            sent = true;
        }
        std::cout << entry_to_json(result) << "\n" << std::flush;
    }
    return cli::exit_fine;
}

}  // namespace slipface

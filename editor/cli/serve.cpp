// slipface serve: movement for other programs, by the stepping protocol of docs/course.md.
#include <fmt/format.h>

#include <iostream>
#include <map>

#include "cli/course_run.h"
#include "cli/guarded.h"
#include "cli/options.h"
#include "cli/verbs.h"
#include "slipface/base/files.h"
#include "slipface/base/version.h"

namespace slipface::cli {
namespace {

constexpr std::size_t max_line_bytes = std::size_t{64} << 20;
constexpr std::size_t max_runs = 1000;
constexpr std::size_t max_total_triangles = 8'000'000;  // of all open runs
constexpr std::size_t max_steps = 1'000'000;            // of a run of a file

void add_engine(OutputJson& json) {
    json["engine"] = "slipface";
    json["version"] = program_version();
    json["body"] = "ellipsoid";
    json["features"] = {"slope_limit", "steps", "snap", "moving", "jump"};
}

OutputJson error_json(const Refused& refused) {
    return {{"place", refused.place}, {"found", refused.found}, {"expected", refused.expected}};
}

// Errors of the parser name the byte, as nlohmann counts it.
OutputJson parsed(const std::string& text) {
    try {
        return OutputJson::parse(text);
    } catch (const OutputJson::exception& error) {
        throw Refused{"/", error.what(), "JSON"};
    }
}

class Server {
  public:
    // The answer to one line; never throws.
    OutputJson answer(const std::string& line) {
        ++lines_;
        OutputJson request;
        try {
            request = parsed(line);
            return answer_request({request, ""});
        } catch (const Refused& refused) {
            return refusal(request, error_json(refused));
        } catch (const std::exception& error) {
            return refusal(request, {{"place", "/"}, {"found", error.what()}, {"expected", "a request"}});
        }
    }
    OutputJson too_long() {
        ++lines_;
        return refusal({}, {{"place", "/"},
                            {"found", "a longer line"},
                            {"expected", fmt::format("at most {} bytes", max_line_bytes)}});
    }

  private:
    OutputJson refusal(const OutputJson& request, OutputJson error) const {
        OutputJson json{{"line", lines_}};
        if (request.is_object() && request.contains("run") && request["run"].is_string())
            json["run"] = request["run"];
        json["error"] = std::move(error);
        return json;
    }

    OutputJson answer_request(const Placed& request) {
        const std::string verb = request.member("do").text();
        if (verb == "hello") {
            request.need_object_of({"do", "protocol"});
            request.member("protocol").whole(course_protocol, course_protocol);
            OutputJson json{{"ok", verb}, {"protocol", course_protocol}};
            add_engine(json);
            return json;
        }
        if (verb == "load")
            request.need_object_of({"do", "run", "body", "feet", "settings", "meshes"});
        else if (verb == "step")
            request.need_object_of({"do", "run", "dt", "wish", "buttons", "poses"});
        else if (verb == "free")
            request.need_object_of({"do", "run"});
        else
            request.member("do").refuse("\"hello\", \"load\", \"step\" or \"free\"");
        const Placed place = request.member("run");
        const std::string name = place.text();
        OutputJson json{{"ok", verb}, {"run", name}};
        if (verb == "load") {
            load(request, name);
            return json;
        }
        const auto run = runs_.find(name);
        if (run == runs_.end()) place.refuse("the name of a loaded run");
        if (verb == "free") {
            triangles_ -= run->second->triangle_count();
            runs_.erase(run);
            return json;
        }
        const CourseRun::Answer answer = run->second->step(request);
        json["feet"] = vector_json(answer.feet);
        json["velocity"] = vector_json(answer.velocity);
        json["grounded"] = answer.grounded;
        return json;
    }

    // A name that is loaded already is loaded anew.
    void load(const Placed& request, const std::string& name) {
        const auto before = runs_.find(name);
        if (before == runs_.end() && runs_.size() >= max_runs)
            throw Refused{"/run", fmt::format("{} open runs", max_runs), "one that is freed first"};
        auto run = std::make_unique<CourseRun>(request);
        const std::size_t freed = before == runs_.end() ? 0 : before->second->triangle_count();
        const std::size_t total = triangles_ - freed + run->triangle_count();
        if (total > max_total_triangles)
            throw Refused{"/meshes", fmt::format("{} triangles in all open runs", total),
                          fmt::format("at most {}", max_total_triangles)};
        triangles_ = total;
        runs_.insert_or_assign(name, std::move(run));
    }

    std::map<std::string, std::unique_ptr<CourseRun>> runs_;
    std::size_t lines_ = 0, triangles_ = 0;
};

void write_line(std::ostream& out, const OutputJson& json) {
    // Flushed, because the other side waits for it.
    out << json.dump(-1, ' ', false, OutputJson::error_handler_t::replace) << std::endl;
}

int serve_lines(std::istream& in, std::ostream& out) {
    Server server;
    std::string line;
    bool cut = false;
    std::streambuf& bytes = *in.rdbuf();
    for (int c = bytes.sbumpc();; c = bytes.sbumpc()) {
        const bool ends = c == std::char_traits<char>::eof();
        if (!ends && c != '\n') {
            cut = cut || line.size() == max_line_bytes;
            if (!cut) line += static_cast<char>(c);
            continue;
        }
        if (cut)
            write_line(out, server.too_long());
        else if (line.find_first_not_of(" \t\r") != std::string::npos)
            write_line(out, server.answer(line));
        if (ends || !out) return exit_fine;
        line.clear();
        cut = false;
    }
}

// One run of a file: the feet after each tick.
OutputJson run_of_file(const Placed& run) {
    CourseRun course(run.member("load"));
    OutputJson feet = OutputJson::array(), grounded = OutputJson::array();
    const Placed steps = run.member("steps");
    const std::size_t count = steps.need_array(max_steps);
    for (std::size_t i = 0; i < count; ++i) {
        const Placed step = steps.item(i);
        step.need_object_of({"repeat", "dt", "wish", "buttons", "poses"});
        std::size_t repeat = 1;
        step.if_member("repeat", [&](const Placed& value) { repeat = value.whole(1, max_steps); });
        if (feet.size() + repeat > max_steps)
            step.refuse(fmt::format("at most {} ticks in a run", max_steps));
        for (; repeat > 0; --repeat) {
            const CourseRun::Answer answer = course.step(step);
            feet.push_back(vector_json(answer.feet));
            grounded.push_back(answer.grounded);
        }
    }
    return {{"feet", std::move(feet)}, {"grounded", std::move(grounded)}};
}

// Answers every run that can be answered; an error in one of them is its answer.
int serve_file(const std::filesystem::path& file, std::ostream& out, std::ostream& err) {
    const Result<std::string> text = read_file(file, max_line_bytes);
    if (!text) return cli::bad_input(err, text.error());
    OutputJson json{{"slipface_course_answer", course_protocol}};
    add_engine(json);
    bool all_fine = true;
    try {
        const OutputJson course = parsed(*text);
        const Placed root{course, ""};
        root.need_object_of({"slipface_course", "about", "runs"});
        root.member("slipface_course").whole(course_protocol, course_protocol);
        const Placed runs = root.member("runs");
        const std::size_t count = runs.need_array(100'000);
        OutputJson& answers = json["runs"] = OutputJson::object();
        for (std::size_t i = 0; i < count; ++i) {
            const Placed run = runs.item(i);
            run.need_object_of({"run", "about", "load", "steps"});
            const std::string name = run.member("run").text();
            if (answers.contains(name)) run.member("run").refuse("a name that no other run has");
            try {
                run.member("load").need_object_of({"body", "feet", "settings", "meshes"});
                answers[name] = run_of_file(run);
            } catch (const Refused& refused) {
                all_fine = false;
                answers[name] = {{"error", error_json(refused)}};
                print_error(err, {file.string() + ":" + refused.place,
                                  "found " + refused.found + ", expected " + refused.expected});
            }
        }
    } catch (const Refused& refused) {
        return cli::bad_input(err, {file.string() + ":" + refused.place,
                                    "found " + refused.found + ", expected " + refused.expected});
    }
    write_line(out, json);
    return all_fine ? exit_fine : exit_bad_input;
}

}  // namespace

void add_serve_verb(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand(
        "serve", "Step players for another program: JSON lines in and out (docs/course.md)");
    auto file = std::make_shared<std::filesystem::path>();
    add_path(*verb, "--file", *file, "Answer a course file instead of standard input")->type_name("FILE");
    verb->callback([file, &exit_code] {
        exit_code = guarded([&] {
            return file->empty() ? serve_lines(std::cin, std::cout) : serve_file(*file, std::cout, std::cerr);
        });
    });
}

}  // namespace slipface::cli

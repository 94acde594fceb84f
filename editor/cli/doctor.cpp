#include "slipface/doctor/doctor.h"

#include <fmt/format.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <limits>

#include "cli/format.h"
#include "cli/verbs.h"
#include "slipface/base/counted.h"
#include "slipface/level/level_file.h"
#include "slipface/reach/grades.h"

namespace slipface::cli {
namespace {

void print_doctor_json(const DoctorReport& report, const Grades* grades, std::ostream& out) {
    OutputJson json;
    json["problems"] = report.total();
    json["counts"] = OutputJson::object();
    for (const ProblemKindInfo& kind : problem_kinds())
        json["counts"][kind.name] = report.count(kind.kind);
    for (const ProblemKindInfo& kind : problem_kinds())
        if (report.untried_of(kind.kind) > 0) json["untried"][kind.name] = report.untried_of(kind.kind);
    json["list"] = OutputJson::array();
    for (const Problem& problem : report.problems) {
        OutputJson row{{"kind", info_of(problem.kind).name}, {"text", problem.text}};
        row["face"] = problem.face == no_id ? OutputJson(nullptr) : OutputJson(problem.face);
        row["other"] = problem.other == no_id ? OutputJson(nullptr) : OutputJson(problem.other);
        row["position"] = vector_json(problem.position);
        json["list"].push_back(std::move(row));
    }
    if (grades) {
        OutputJson& notes = (json["grades"] = {{"step_m", grades->limits.step_m},
                                               {"ledge_m", grades->limits.ledge_m},
                                               {"gap_m", grades->limits.gap_m},
                                               {"dropped", grades->dropped},
                                               {"jumped", grades->jumped},
                                               {"missed", grades->missed},
                                               {"notes", OutputJson::array()}})["notes"];
        for (const GradeNote& note : grades->notes)
            notes.push_back({{"face", note.face},
                             {"position", vector_json(note.position)},
                             {"reached", note.reached},
                             {"text", note.text}});
    }
    print_json(out, json);
}

void print_grades(const Grades& grades, std::ostream& out) {
    const JumpLimits& limits = grades.limits;
    out << fmt::format(
        "\nSteps up to {:.2f} m are walked, ledges up to {:.2f} m and gaps up to {:.2f} m jumped\n"
        "Of the regions apart, {} are dropped onto, {} jumped to, and {} missed by less than a tenth\n",
        limits.step_m, limits.ledge_m, limits.gap_m, grades.dropped, grades.jumped, grades.missed);
    for (const GradeNote& note : grades.notes)
        out << fmt::format("    face {}, at {}: {}\n", note.face, vector_text(note.position), note.text);
}

void print_doctor_text(const DoctorReport& report, std::ostream& out) {
    constexpr std::size_t max_shown = 20;
    for (const ProblemKindInfo& kind : problem_kinds()) {
        const std::size_t count = report.count(kind.kind);
        const std::size_t untried = report.untried_of(kind.kind);
        if (untried > 0)
            out << fmt::format("{}: {} were not tried, because there are too many\n", kind.label,
                               counted(untried, "more place"));
        if (count == 0) continue;
        out << fmt::format("{}: {}\n  {}\n", kind.label, count, kind.meaning);
        std::size_t shown = 0;
        for (const Problem& problem : report.problems) {
            if (problem.kind != kind.kind || ++shown > max_shown) continue;
            const std::string where = problem.face == no_id ? "" : fmt::format("face {}, ", problem.face);
            out << fmt::format("    {}at {}: {}\n", where, vector_text(problem.position), problem.text);
        }
        if (count > max_shown)
            out << fmt::format("    and {} more; --json lists up to {}\n", count - max_shown,
                               DoctorReport::max_listed);
        out << fmt::format("  {}\n", kind.remedy);
    }
    const std::size_t total = report.total();
    out << (total == 0 ? std::string("No problems found\n") : counted(total, "problem") + '\n');
}

// For a process that ends with this verb: freed memory is used again instead of being returned to the system
// and requested anew, page by page.
void keep_freed_memory() {
#ifdef __GLIBC__
    ::mallopt(M_MMAP_MAX, 0);
    ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace

int run_doctor(const DoctorOptions& options, std::ostream& out, std::ostream& err) {
    keep_freed_memory();
    const Result<LoadedLevel> loaded = load_level(options.level);
    if (!loaded) return bad_input(err, loaded.error());
    print_warnings(err, loaded->warnings);
    const DoctorReport report = examine(loaded->level);
    const Grades grades = options.grade ? grade(loaded->level) : Grades{};
    options.json ? print_doctor_json(report, options.grade ? &grades : nullptr, out)
                 : print_doctor_text(report, out);
    if (options.grade && !options.json) print_grades(grades, out);
    return report.total() == 0 ? exit_fine : exit_check_failed;
}

}  // namespace slipface::cli

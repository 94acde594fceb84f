#include <fmt/format.h>

#include "cli/format.h"
#include "cli/sweep_queries.h"
#include "cli/verbs.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "slipface/level/level_file.h"
#include "slipface/sim/probe_test.h"

namespace slipface::cli {
namespace {

using Answer = std::optional<Contact>;

const std::string& surface_name(const Level& level, SurfaceId surface) {
    return level.surfaces[surface].name;
}

OutputJson answer_json(const Answer& answer, const Level& level) {
    OutputJson json;
    json["hit"] = answer.has_value();
    if (!answer) return json;
    json["t"] = answer->t;
    json["normal"] = vector_json(answer->normal);
    json["point"] = vector_json(answer->point);
    json["triangle"] = answer->triangle;
    json["face"] = answer->face;
    json["feature"] = feature_name(answer->feature);
    json["surface"] = surface_name(level, answer->surface);
    return json;
}

void print_csv(const std::vector<Answer>& answers, const Level& level, std::ostream& out) {
    out << "hit,t,nx,ny,nz,px,py,pz,triangle,face,feature,surface\n";
    for (const Answer& answer : answers) {
        if (!answer) {
            out << "0,,,,,,,,,,,\n";
            continue;
        }
        const Vec3& n = answer->normal;
        const Vec3& p = answer->point;
        out << "1," << to_text(answer->t);
        for (const double number : {n.x(), n.y(), n.z(), p.x(), p.y(), p.z()})
            out << ',' << to_text(number);
        out << ',' << answer->triangle << ',' << answer->face << ',' << feature_name(answer->feature) << ','
            << csv_field(surface_name(level, answer->surface)) << '\n';
    }
}

void print_json_answers(const std::vector<Answer>& answers, const Level& level, bool single,
                        std::ostream& out) {
    if (single) return print_json(out, answer_json(answers.front(), level));
    // Row by row, so that a million results are not held as one document.
    out << "[";
    for (std::size_t i = 0; i < answers.size(); ++i) {
        out << (i == 0 ? "\n  " : ",\n  ")
            << answer_json(answers[i], level).dump(-1, ' ', false, OutputJson::error_handler_t::replace);
    }
    out << "\n]\n";
}

void print_one(const Answer& answer, const Level& level, std::ostream& out) {
    if (!answer) {
        out << "no hit\n";
        return;
    }
    print_row(out, "t", to_text(answer->t));
    print_row(out, "normal", vector_text(answer->normal));
    print_row(out, "point", vector_text(answer->point) + "  m");
    print_row(out, "triangle", std::to_string(answer->triangle));
    print_row(out, "face", std::to_string(answer->face));
    print_row(out, "feature", feature_name(answer->feature));
    print_row(out, "surface", surface_name(level, answer->surface));
}

void print_table(const std::vector<Answer>& answers, const Level& level, std::ostream& out) {
    out << fmt::format("{:>7}  {:>9}  {:>27}  {:>31}  {:>9}  {:>8}  {:<8}  {}\n", "query", "t", "normal",
                       "point", "triangle", "face", "feature", "surface");
    for (std::size_t i = 0; i < answers.size(); ++i) {
        if (!answers[i]) {
            out << fmt::format("{:>7}  {:>9}\n", i, "no hit");
            continue;
        }
        const Contact& contact = *answers[i];
        out << fmt::format("{:>7}  {:>9.6f}  {:>27}  {:>31}  {:>9}  {:>8}  {:<8}  {}\n", i, contact.t,
                           vector_text(contact.normal), vector_text(contact.point), contact.triangle,
                           contact.face, feature_name(contact.feature), surface_name(level, contact.surface));
    }
}

Result<std::vector<SweepQuery>> queries_of(const SweepOptions& options) {
    if (options.queries) return load_sweep_queries(*options.queries);
    return std::vector<SweepQuery>{
        {options.from.value_or(Vec3::Zero()), options.move.value_or(Vec3::Zero())}};
}

}  // namespace

int run_sweep(const SweepOptions& options, std::ostream& out, std::ostream& err) {
    const bool both = options.queries && (options.from || options.move);
    const bool neither = !options.queries && !(options.from && options.move);
    if (both || neither) {
        print_error(err, {"sweep", "expected either --from x,y,z with --move x,y,z, or --queries FILE.csv"});
        return exit_bad_usage;
    }
    if (!options.radii.allFinite() || !(options.radii.minCoeff() > 0.0)) {
        print_error(err, {"sweep: --radii", "expected three numbers above 0"});
        return exit_bad_usage;
    }
    const Result<std::vector<SweepQuery>> queries = queries_of(options);
    if (!queries) return bad_input(err, queries.error());
    const Result<LoadedLevel> loaded = load_level(options.level);
    if (!loaded) return bad_input(err, loaded.error());
    print_warnings(err, loaded->warnings);
    const Result<CollisionWorld> world = build_collision_world(loaded->level);
    if (!world) return bad_input(err, world.error());

    std::vector<Sweep> sweeps;
    sweeps.reserve(queries->size());
    for (const SweepQuery& query : *queries)
        sweeps.push_back({options.radii, query.from, query.move});
    std::vector<Answer> answers(sweeps.size());
    sweep_ellipsoids(*world, sweeps, answers);
    const bool single = !options.queries;
    switch (options.format) {
        case SweepFormat::json: print_json_answers(answers, loaded->level, single, out); break;
        case SweepFormat::csv: print_csv(answers, loaded->level, out); break;
        case SweepFormat::text:
            single ? print_one(answers.front(), loaded->level, out)
                   : print_table(answers, loaded->level, out);
            break;
    }
    return exit_fine;
}

int run_sweep_test(const std::filesystem::path& level, const std::filesystem::path& file, std::ostream& out,
                   std::ostream& err) {
    constexpr std::uint64_t max_bytes = 1 << 20;
    const Result<std::string> text = read_file(file, max_bytes);
    if (!text) return bad_input(err, text.error());
    const Result<ProbeTest> test = parse_probe_test(*text, file.string());
    if (!test) return bad_input(err, test.error());
    const Result<LoadedLevel> loaded = load_level(level);
    if (!loaded) return bad_input(err, loaded.error());
    print_warnings(err, loaded->warnings);
    if (test->level_fingerprint && *test->level_fingerprint != loaded->level.mesh.fingerprint())
        print_warnings(err, {{file.string(), "was written for other geometry"}});
    const Result<CollisionWorld> world = build_collision_world(loaded->level);
    if (!world) return bad_input(err, world.error());
    const std::vector<std::string> differences = run_probe_test(*test, {*world, loaded->level.surfaces});
    for (const std::string& difference : differences)
        print_error(err, {file.string(), difference});
    if (!differences.empty()) return exit_check_failed;
    out << "passed: " << test->sweeps.size() << " sweeps as expected\n";
    return exit_fine;
}

}  // namespace slipface::cli

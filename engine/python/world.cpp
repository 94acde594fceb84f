#include <algorithm>
#include <cmath>
#include <numeric>

#include "module.h"
#include "slipface/base/parallel.h"
#include "slipface/collision/filter.h"
#include "slipface/movement/crowd.h"

namespace slipface::python {
namespace {

using Triple = std::array<double, 3>;

std::string shape_of(const py::array& array) {
    std::string text = "(";
    for (py::ssize_t i = 0; i < array.ndim(); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
    return text + ")";
}

Vec3 finite(const Vec3& v, const char* name) {
    if (!v.allFinite()) throw py::value_error(std::string(name) + ": expected finite numbers");
    return v;
}
Vec3 positive(const Vec3& v, const char* name) {
    if (!(finite(v, name).minCoeff() > 0.0))
        throw py::value_error(std::string(name) + ": expected numbers above 0");
    return v;
}
Vec3 turned(const Vec3& v, const char* name) {
    if (finite(v, name).isZero(0.0))
        throw py::value_error(std::string(name) + ": found 0, expected a direction");
    return v;
}
double distance(double value, const char* name) {
    if (!(value >= 0.0)) throw py::value_error(std::string(name) + ": expected 0 or more");
    return value;
}

// Rows of three numbers: one for each query, or one row for all of them.
class Rows {
  public:
    Rows(const Array& array, const char* name) : data_(array.data()) {
        const bool one = array.ndim() == 1 && array.shape(0) == 3;
        if (!one && !(array.ndim() == 2 && array.shape(1) == 3))
            throw py::value_error(std::string(name) + ": found the shape " + shape_of(array) +
                                  ", expected (n, 3) or (3,)");
        count_ = one ? 1 : static_cast<std::size_t>(array.shape(0));
        repeats_ = one;
    }
    std::size_t count() const { return count_; }
    bool repeats() const { return repeats_; }
    // Before the work begins: each row as `check` has it.
    void each(const char* name, Vec3 (*check)(const Vec3&, const char*)) const {
        for (std::size_t i = 0; i < count_; ++i)
            check((*this)[i], name);
    }
    Vec3 operator[](std::size_t i) const {
        const double* const row = data_ + (repeats_ ? 0 : 3 * i);
        return {row[0], row[1], row[2]};
    }

  private:
    const double* data_;
    std::size_t count_ = 0;
    bool repeats_ = false;
};

template <class... More>
std::size_t common_count(const Rows& first, const More&... more) {
    std::size_t count = 1;
    bool fits = true;
    for (const Rows* rows : {&first, &more...}) {
        if (rows->repeats()) continue;
        fits = fits && (count == 1 || count == rows->count() || count == 0);
        count = rows->count();
    }
    for (const Rows* rows : {&first, &more...})
        fits = fits && (rows->repeats() || rows->count() == count);
    if (!fits)
        throw py::value_error("found arrays of different lengths, expected one length, or single rows");
    return count;
}

template <class T>
py::array_t<T> column(std::size_t count, std::size_t width = 1) {
    if (width == 1) return py::array_t<T>(static_cast<py::ssize_t>(count));
    return py::array_t<T>({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(width)});
}

std::shared_ptr<World> world_of(const Array& positions, const Indices& triangles,
                                const std::optional<py::array_t<std::uint32_t, py::array::forcecast>>& types,
                                const std::optional<Indices>& groups) {
    if (positions.ndim() != 2 || positions.shape(1) != 3 || triangles.ndim() != 2 || triangles.shape(1) != 3)
        throw py::value_error("found positions " + shape_of(positions) + " and triangles " +
                              shape_of(triangles) + ", expected (n, 3) and (m, 3)");
    const auto count = static_cast<std::size_t>(triangles.shape(0));
    const auto fits = [&](const py::array& array) {
        return array.ndim() == 1 && static_cast<std::size_t>(array.shape(0)) == count;
    };
    if ((types && !fits(*types)) || (groups && !fits(*groups)))
        throw py::value_error("found types or groups of another length than triangles");
    auto made = std::make_shared<World>();
    made->types = preset_surface_types();
    std::vector<Vec3f> corners;
    for (py::ssize_t i = 0; i < positions.shape(0); ++i)
        corners.emplace_back(Vec3(positions.at(i, 0), positions.at(i, 1), positions.at(i, 2)).cast<float>());
    std::vector<std::array<std::uint32_t, 3>> indices;
    for (py::ssize_t i = 0; i < triangles.shape(0); ++i)
        indices.push_back({triangles.at(i, 0), triangles.at(i, 1), triangles.at(i, 2)});
    std::vector<FaceId> faces(count);
    std::iota(faces.begin(), faces.end(), FaceId{0});
    made->collision = value_or_raise(CollisionWorld::build({corners, indices, faces}));
    apply_surface_rules(made->collision, made->types);
    for (std::size_t i = 0; i < count && types; ++i) {
        const std::uint32_t type = types->at(static_cast<py::ssize_t>(i));
        if (type >= made->types.size())
            throw py::value_error("triangle " + std::to_string(i) + ": found the type " +
                                  std::to_string(type) + ", expected one below " +
                                  std::to_string(made->types.size()));
        made->collision.set_face_surface(static_cast<FaceId>(i), static_cast<SurfaceId>(type));
    }
    if (groups) made->groups.assign(groups->data(), groups->data() + count);
    return made;
}

QueryFilter filter_of(World& world, const std::vector<std::string>& ignore, std::uint32_t groups) {
    QueryFilter filter;
    filter.groups = world.groups;
    filter.mask = groups;
    const std::vector<SurfaceType>& types = world.surfaces();
    for (const std::string& name : ignore) {
        const auto found = std::ranges::find(types, name, &SurfaceType::name);
        if (found == types.end()) throw py::value_error("found no type \"" + name + "\"");
        filter.ignored[static_cast<std::size_t>(found - types.begin())] = true;
    }
    return filter;
}

// Many sweeps of what does not move. Other Python threads run meanwhile.
py::dict sweeps(World& world, const Array& radii, const Array& starts, const Array& moves) {
    const Rows r(radii, "radii"), from(starts, "starts"), move(moves, "moves");
    const std::size_t count = common_count(r, from, move);
    r.each("radii", positive);
    from.each("starts", finite);
    move.each("moves", finite);
    auto t = column<double>(count);
    auto normal = column<double>(count, 3), point = column<double>(count, 3);
    auto triangle = column<std::int64_t>(count), face = column<std::int64_t>(count);
    auto type = column<std::uint8_t>(count);
    double *const to_t = t.mutable_data(), *const to_normal = normal.mutable_data(),
                  *const to_point = point.mutable_data();
    std::int64_t *const to_triangle = triangle.mutable_data(), *const to_face = face.mutable_data();
    std::uint8_t* const to_type = type.mutable_data();
    const MovementScene now = world.now();
    {
        const std::shared_lock lock(world.in_use);
        const py::gil_scoped_release others;
        constexpr std::size_t portion = 4096;
        std::vector<Sweep> some(std::min(count, portion));
        std::vector<std::optional<Contact>> found(some.size());
        for (std::size_t first = 0; first < count; first += portion) {
            const std::size_t many = std::min(portion, count - first);
            for (std::size_t i = 0; i < many; ++i)
                some[i] = {r[first + i], from[first + i], move[first + i]};
            sweep_ellipsoids(now.collision, std::span(some).first(many), found);
            for (std::size_t i = 0; i < many; ++i) {
                const std::size_t at = first + i;
                const Contact contact = found[i].value_or(Contact{.t = 2.0});
                to_t[at] = contact.t;
                for (std::size_t k = 0; k < 3; ++k) {
                    to_normal[3 * at + k] = contact.normal[static_cast<Eigen::Index>(k)];
                    to_point[3 * at + k] = contact.point[static_cast<Eigen::Index>(k)];
                }
                const bool numbered = contact.triangle < now.triangles.size();
                const TriangleId number = numbered ? now.triangles[contact.triangle] : contact.triangle;
                to_triangle[at] = found[i] ? std::int64_t{number} : -1;
                to_face[at] = found[i] ? std::int64_t{contact.face} : -1;
                to_type[at] = contact.surface;
            }
        }
    }
    using namespace py::literals;
    return py::dict("t"_a = t, "normal"_a = normal, "point"_a = point, "triangle"_a = triangle,
                    "face"_a = face, "type"_a = type);
}

py::dict rays(World& world, const Array& origins, const Array& directions, double max_t) {
    const Rows from(origins, "origins"), along(directions, "directions");
    const std::size_t count = common_count(from, along);
    from.each("origins", finite);
    along.each("directions", turned);
    distance(max_t, "max_t");
    auto t = column<double>(count);
    auto normal = column<double>(count, 3);
    auto face = column<std::int64_t>(count);
    double *const to_t = t.mutable_data(), *const to_normal = normal.mutable_data();
    std::int64_t* const to_face = face.mutable_data();
    const MovementScene now = world.now();
    {
        const std::shared_lock lock(world.in_use);
        const py::gil_scoped_release others;
        parallel_for(count, 256, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto hit = cast_ray(now.collision, from[i], along[i], max_t);
                to_t[i] = hit ? hit->t : -1.0;
                to_face[i] = hit ? std::int64_t{hit->face} : -1;
                for (std::size_t k = 0; k < 3; ++k)
                    to_normal[3 * i + k] = hit ? hit->normal[static_cast<Eigen::Index>(k)] : 0.0;
            }
        });
    }
    using namespace py::literals;
    return py::dict("t"_a = t, "normal"_a = normal, "face"_a = face);
}

py::dict contact_dict(World& world, const Contact& contact) {
    using namespace py::literals;
    return py::dict("t"_a = contact.t, "normal"_a = tuple(contact.normal), "point"_a = tuple(contact.point),
                    "triangle"_a = contact.triangle, "face"_a = contact.face,
                    "type"_a = world.surfaces()[contact.surface].name,
                    "feature"_a = feature_name(contact.feature));
}

void set_parameter(World& world, const std::string& type, const std::string& parameter,
                   const py::object& value) {
    const auto found = std::ranges::find(world.surfaces(), type, &SurfaceType::name);
    if (found == world.surfaces().end()) throw py::value_error("found no type \"" + type + "\"");
    const auto fields = surface_fields();
    const auto field = std::ranges::find(fields, std::string_view(parameter), &SurfaceField::name);
    if (field == fields.end()) throw py::value_error("found no parameter \"" + parameter + "\"");
    const auto in_range = [&](double number) {
        if (!(number >= field->minimum && number <= field->maximum))
            throw py::value_error(parameter + ": found " + std::to_string(number) + ", expected " +
                                  std::to_string(field->minimum) + " to " + std::to_string(field->maximum));
        return number;
    };
    const Change change(world);
    std::visit(
        [&](auto member) {
            using Value = std::remove_cvref_t<decltype((*found).*member)>;
            if constexpr (std::is_same_v<Value, bool>) {
                (*found).*member = value.cast<bool>();
            } else if constexpr (std::is_same_v<Value, Vec3>) {
                const auto numbers = value.cast<Triple>();
                for (const double number : numbers)
                    in_range(number);
                (*found).*member = vec(numbers);
            } else {
                (*found).*member = in_range(value.cast<double>());
            }
        },
        field->member);
    if (world.scene)
        world.scene->apply_surfaces();
    else
        apply_surface_rules(world.collision, world.types);
}

void set_face_type(World& world, FaceId face, const std::string& type) {
    const auto found = std::ranges::find(world.surfaces(), type, &SurfaceType::name);
    if (found == world.surfaces().end()) throw py::value_error("found no type \"" + type + "\"");
    const auto id = static_cast<SurfaceId>(found - world.surfaces().begin());
    const std::size_t faces = world.level ? world.level->mesh.face_count() : world.collision.triangle_count();
    if (face >= faces)
        throw py::index_error("found the face " + std::to_string(face) + ", expected one below " +
                              std::to_string(faces));
    const Change change(world);
    if (world.level) {
        world.level->overrides.resize(std::max<std::size_t>(world.level->overrides.size(), face + 1));
        world.level->overrides[face] = id;
        world.scene->apply_surfaces();
    } else {
        world.collision.set_face_surface(face, id);
    }
}

PlayerState player_at(World& world, const Triple& position) {
    if (!vec(position).allFinite()) throw py::value_error("position: expected finite numbers");
    PlayerState state;
    put_in_scene(world.now(), vec(position), state);
    return state;
}

void check_player(const MovementScene& now, const PlayerState& player, const std::array<double, 2>& wish) {
    if (!std::isfinite(wish[0]) || !std::isfinite(wish[1]))
        throw py::value_error("wish: expected finite numbers");
    if (player.ground_surface >= now.surfaces.size() ||
        (player.ground_platform != no_id && player.ground_platform >= now.platforms.size()))
        throw py::value_error("the player comes from another world");
}

ButtonSet buttons_of(bool jump, const std::vector<std::string>& names) {
    ButtonSet buttons(Button::jump, jump);
    for (const std::string& name : names) {
        const ButtonInfo* info = find_button(name);
        if (info == nullptr) {
            std::string known;
            for (const ButtonInfo& one : button_table())
                known += std::string(known.empty() ? "" : ", ") + one.name;
            throw py::value_error("buttons: found \"" + name + "\", expected some of " + known);
        }
        buttons.set(info->button);
    }
    return buttons;
}

PlayerState stepped(World& world, const PlayerState& player, const MovementSettings& settings,
                    const std::array<double, 2>& wish, bool jump, double dt, const py::object& trace,
                    const std::vector<std::string>& buttons) {
    if (!(dt >= 1e-4) || !std::isfinite(dt)) throw py::value_error("dt: expected 1e-4 or more");
    const MovementScene now = world.now();
    check_player(now, player, wish);
    TraceRecorder recorder;
    const PlayerState next =
        step(now, settings, player, {.wish = {wish[0], wish[1]}, .buttons = buttons_of(jump, buttons)}, dt,
             trace.is_none() ? nullptr : &recorder)
            .state;
    if (!trace.is_none())
        for (const TraceRecord& record : recorder.records)
            trace.attr("append")(record_dict(record));
    return next;
}

template <void (*Step)(const MovementScene&, std::span<CrowdMember>, double)>
std::vector<PlayerState> members_stepped(World& world, const std::vector<PlayerState>& players,
                                         const std::vector<MovementSettings>& settings,
                                         const std::vector<std::array<double, 2>>& wishes,
                                         const std::vector<bool>& jumps, double dt,
                                         const std::vector<std::vector<std::string>>& buttons) {
    if (!(dt >= 1e-4) || !std::isfinite(dt)) throw py::value_error("dt: expected 1e-4 or more");
    for (const std::size_t size :
         {settings.size(), wishes.size(), jumps.empty() ? players.size() : jumps.size(),
          buttons.empty() ? players.size() : buttons.size()})
        if (size != players.size())
            throw py::value_error("found " + std::to_string(size) + " for " + std::to_string(players.size()) +
                                  " players, expected settings, wishes, jumps and buttons for each player");
    const MovementScene now = world.now();
    std::vector<CrowdMember> crowd;
    for (std::size_t i = 0; i < players.size(); ++i) {
        check_player(now, players[i], wishes[i]);
        crowd.push_back({&settings[i],
                         players[i],
                         {.wish = {wishes[i][0], wishes[i][1]},
                          .buttons = buttons_of(!jumps.empty() && jumps[i],
                                                buttons.empty() ? std::vector<std::string>() : buttons[i])}});
    }
    {
        const std::shared_lock lock(world.in_use);
        const py::gil_scoped_release others;
        Step(now, crowd, dt);
    }
    std::vector<PlayerState> next;
    for (const CrowdMember& member : crowd)
        next.push_back(member.state);
    return next;
}

}  // namespace

py::dict record_dict(const TraceRecord& record) {
    using namespace py::literals;
    const auto contact = [](const std::optional<Contact>& of) -> py::object {
        if (!of) return py::none();
        return py::make_tuple(of->t, tuple(of->normal), of->face);
    };
    if (const auto* sweep = std::get_if<SweepRecord>(&record))
        return py::dict("kind"_a = "sweep", "name"_a = pass_name(sweep->pass), "from"_a = tuple(sweep->from),
                        "move"_a = tuple(sweep->move), "to"_a = tuple(sweep->reached),
                        "contact"_a = contact(sweep->contact));
    if (const auto* response = std::get_if<ResponseRecord>(&record))
        return py::dict("kind"_a = "response", "name"_a = rule_name(response->rule),
                        "before"_a = tuple(response->remainder_before),
                        "after"_a = tuple(response->remainder_after), "normal"_a = tuple(response->normal),
                        "face"_a = response->face);
    if (const auto* decision = std::get_if<DecisionRecord>(&record)) {
        const DecisionInfo& info = decision_info(decision->kind);
        return py::dict("kind"_a = "decision", "name"_a = info.hack, "text"_a = info.sentence,
                        "acted"_a = info.outcome == Outcome::acted, "value"_a = decision->value,
                        "limit"_a = decision->limit);
    }
    const auto& push = std::get<PushOutRecord>(record);
    return py::dict("kind"_a = "push_out", "name"_a = "push_out", "from"_a = tuple(push.from),
                    "to"_a = tuple(push.to), "free"_a = push.free);
}

void add_world(py::module_& module) {
    py::class_<PlayerState>(module, "Player", "A player at one moment; step() makes the next one.")
        .def_property_readonly("position", [](const PlayerState& p) { return tuple(p.position); })
        .def_property_readonly("velocity", [](const PlayerState& p) { return tuple(p.velocity); })
        .def_property_readonly(
            "motion", [](const PlayerState& p) { return tuple(motion_velocity(p)); },
            "Velocity of its own motion, without what presses it to the ground")
        .def_property_readonly("ground_normal", [](const PlayerState& p) { return tuple(p.ground_normal); })
        .def_property_readonly("ground_face",
                               [](const PlayerState& p) {
                                   return p.ground_face == no_id ? py::object(py::none())
                                                                 : py::object(py::int_(p.ground_face));
                               })
        .def_readonly("grounded", &PlayerState::grounded)
        .def_readonly("climbing", &PlayerState::climbing)
        .def_readonly("stuck", &PlayerState::stuck)
        .def_readonly("hanging", &PlayerState::hanging)
        .def_readonly("crouched", &PlayerState::crouched)
        .def_readonly("wants_to_stand", &PlayerState::wants_to_stand)
        .def_readonly("move_s", &PlayerState::move_s,
                      "Seconds that a dash, or a climb onto a ledge, lasts on")
        .def_readonly("hazard", &PlayerState::hazard)
        .def_readonly("trapped", &PlayerState::trapped)
        .def_readonly("crushed", &PlayerState::crushed)
        .def_property_readonly(
            "carrier",
            [](const PlayerState& p) {
                static constexpr std::array names{"level", "platform", "surface", "character"};
                return names[static_cast<std::size_t>(p.carrier)];
            },
            "What carries it, and what its velocity is relative to: level, platform, surface or character")
        .def_property_readonly(
            "air_frame", [](const PlayerState& p) { return tuple(p.air_frame); },
            "Velocity of the ground that was left; in the air the stick steers relative to it")
        .def("__eq__", [](const PlayerState& a, const PlayerState& b) { return a == b; });

    py::class_<World, std::shared_ptr<World>>(
        module, "World",
        "Triangles to collide with: positions (n, 3) in metres, triangles (m, 3), and for each "
        "triangle a type (0 default, 1 ice, ... as in World.types) and bits of groups.")
        .def(py::init(&world_of), py::arg("positions"), py::arg("triangles"), py::arg("types") = py::none(),
             py::arg("groups") = py::none())
        .def_property_readonly("types",
                               [](World& world) {
                                   py::list names;
                                   for (const SurfaceType& type : world.surfaces())
                                       names.append(type.name);
                                   return names;
                               })
        .def_property_readonly("triangle_count",
                               [](World& world) { return world.now().collision.triangle_count(); })
        .def("set_parameter", &set_parameter, py::arg("type"), py::arg("parameter"), py::arg("value"))
        .def("set_face_type", &set_face_type, py::arg("face"), py::arg("type"))
        .def(
            "set_time",
            [](World& world, double time, double dt) {
                if (!std::isfinite(time) || !(dt >= 0.0) || !std::isfinite(dt))
                    throw py::value_error("expected finite numbers, dt 0 or more");
                const Change change(world);
                world.time = time;
                world.dt = dt;
            },
            py::arg("time"), py::arg("dt") = 0.0,
            "Of a level: its platforms stand as in the step from time to time + dt")
        .def(
            "sweep",
            [](World& world, const Triple& radii, const Triple& start, const Triple& move,
               const std::vector<std::string>& ignore, std::uint32_t groups) -> py::object {
                const auto contact = sweep_ellipsoid(world.now().collision, positive(vec(radii), "radii"),
                                                     finite(vec(start), "start"), finite(vec(move), "move"),
                                                     filter_of(world, ignore, groups));
                return contact ? py::object(contact_dict(world, *contact)) : py::object(py::none());
            },
            py::arg("radii"), py::arg("start"), py::arg("move"),
            py::arg("ignore") = std::vector<std::string>{}, py::arg("groups") = ~std::uint32_t{0},
            "The first contact, or None")
        .def(
            "hits",
            [](World& world, const Triple& radii, const Triple& start, const Triple& move) {
                const CollisionWorld& in = world.now().collision;
                const Vec3 body = positive(vec(radii), "radii"), from = finite(vec(start), "start"),
                           along = finite(vec(move), "move");
                std::vector<Contact> all(find_sweep_hits(in, body, from, along, {}));
                find_sweep_hits(in, body, from, along, all);
                py::list list;
                for (const Contact& contact : all)
                    list.append(contact_dict(world, contact));
                return list;
            },
            py::arg("radii"), py::arg("start"), py::arg("move"),
            "Each triangle's contact, the earliest first")
        .def("sweeps", &sweeps, py::arg("radii"), py::arg("starts"), py::arg("moves"),
             "Many sweeps at once: arrays t (2: nothing was hit), normal, point, triangle, face (-1), type. "
             "Arrays of "
             "float64 in rows are read where they are.")
        .def("rays", &rays, py::arg("origins"), py::arg("directions"),
             py::arg("max_t") = std::numeric_limits<double>::infinity(),
             "Many rays at once: arrays t (-1: nothing was hit), normal, face")
        .def(
            "closest",
            [](World& world, const Triple& point, double max_distance) -> py::object {
                const auto found = closest_point(world.now().collision, finite(vec(point), "point"),
                                                 distance(max_distance, "max_distance"));
                if (!found) return py::none();
                using namespace py::literals;
                return py::dict("distance"_a = found->distance, "point"_a = tuple(found->point),
                                "face"_a = found->face);
            },
            py::arg("point"), py::arg("max_distance") = std::numeric_limits<double>::infinity())
        .def(
            "overlaps",
            [](World& world, const Triple& radii, const Triple& centre) {
                const Vec3 body = positive(vec(radii), "radii"), at = finite(vec(centre), "centre");
                std::vector<Overlap> all(find_overlaps(world.now().collision, body, at, {}));
                find_overlaps(world.now().collision, body, at, all);
                py::list faces;
                for (const Overlap& one : all)
                    faces.append(one.face);
                return faces;
            },
            py::arg("radii"), py::arg("centre"), "The faces that an ellipsoid at rest overlaps")
        .def("player", &player_at, py::arg("position"), "A player at rest with its centre there")
        .def("step", &stepped, py::arg("player"), py::arg("settings"),
             py::arg("wish") = std::array<double, 2>{}, py::arg("jump") = false, py::arg("dt") = 1.0 / 60.0,
             py::arg("trace") = py::none(), py::arg("buttons") = std::vector<std::string>{},
             "The player dt seconds later. wish: (x, z), a fraction of the walking speed. trace: a list, to "
             "which "
             "what happened is appended. buttons: names of those that are held besides jump")
        .def("step_many", &members_stepped<step_many>, py::arg("players"), py::arg("settings"),
             py::arg("wishes"), py::arg("jumps") = std::vector<bool>{}, py::arg("dt") = 1.0 / 60.0,
             py::arg("buttons") = std::vector<std::vector<std::string>>{},
             "The players dt seconds later; they pass through each other. Lists of one length")
        .def(
            "step_crowd", &members_stepped<step_crowd>, py::arg("players"), py::arg("settings"),
            py::arg("wishes"), py::arg("jumps") = std::vector<bool>{}, py::arg("dt") = 1.0 / 60.0,
            py::arg("buttons") = std::vector<std::vector<std::string>>{},
            "The players dt seconds later; they push each other and stand on each other. Lists of one length")
        .def(
            "change_body",
            [](World& world, const PlayerState& player, const MovementSettings& settings,
               const Triple& radii) -> py::object {
                const auto changed = change_body(world.now(), settings, player, vec(radii));
                return changed ? py::cast(*changed) : py::object(py::none());
            },
            py::arg("player"), py::arg("settings"), py::arg("radii"), "The player with another body, or None")
        .def(
            "put_player",
            [](World& world, const PlayerState& player, const MovementSettings& settings,
               double farthest) -> py::object {
                const auto put = put_player(world.now(), settings, player, farthest);
                return put ? py::cast(*put) : py::object(py::none());
            },
            py::arg("player"), py::arg("settings"), py::arg("farthest"),
            "A new player at the player's position or the nearest free place, or None");
}

}  // namespace slipface::python

// What was done to the faces of a level and of its props' meshes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "goldens/acts.h"
#include "goldens/face_list.h"
#include "slipface/base/counted.h"

namespace slipface {

namespace {

using Point = std::array<float, 3>;

Point point_of(const std::array<float, 5>& corner) {
    return {corner[0], corner[1], corner[2]};
}

double apart(const Point& a, const Point& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        sum += (double{b[i]} - a[i]) * (double{b[i]} - a[i]);
    return std::sqrt(sum);
}

std::vector<Point> points_of(const FaceList& faces) {
    std::set<Point> points;
    for (const FaceFact& face : faces)
        for (const auto& corner : face.corners)
            points.insert(point_of(corner));
    return {points.begin(), points.end()};
}

// Equal for faces with the same corners, however they are turned or flipped.
std::vector<Point> corner_set(const FaceFact& face) {
    std::vector<Point> points;
    for (const auto& corner : face.corners)
        points.push_back(point_of(corner));
    std::sort(points.begin(), points.end());
    return points;
}

std::vector<Point> loop_of(const FaceFact& face) {
    std::vector<Point> points;
    for (const auto& corner : face.corners)
        points.push_back(point_of(corner));
    std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
    return points;
}

std::set<std::array<float, 5>> texture_corners(const FaceFact& face) {
    return {face.corners.begin(), face.corners.end()};
}

// Faces of one kind of change, over all objects.
struct Change {
    std::size_t faces = 0;
    double largest = 0.0;  // metres
    std::vector<std::string> objects;
};

class Geometry {
  public:
    Geometry(bool types_follow, std::vector<Act>& acts) : types_follow_(types_follow), acts_(acts) {}

    // `where` names the mesh of props that both are; empty: the level.
    void compare(const Numbers& before, const Numbers& after, const std::string& where) {
        where_ = where;
        changes_.clear();
        if (scaled(before, after)) return;
        std::set<std::string> renamed;
        for (const auto& [name, was] : before.items()) {
            if (const Numbers& is = member_of(after, name); !is.is_null()) {
                if (member_of(was, "hash") != member_of(is, "hash")) compare_object(name, was, is);
                continue;
            }
            std::string text = "was removed";
            for (const auto& [other, value] : after.items())
                if (member_of(value, "hash") == member_of(was, "hash") && !before.contains(other) &&
                    renamed.insert(other).second) {
                    text = fmt::format("was renamed `{}`", other);
                    break;
                }
            say(ActKind::input, fmt::format("{} {}", label(name), text));
        }
        for (const auto& [name, is] : after.items())
            if (!before.contains(name) && !renamed.contains(name))
                say(ActKind::input, fmt::format("{} was added", label(name)));
        for (const auto& [what, change] : changes_)
            say(what.first, sentence(what.second, change));
    }

  private:
    void say(ActKind kind, const std::string& text) {
        acts_.push_back({kind, where_.empty() ? text : fmt::format("{} (in {})", text, where_)});
    }
    static std::string label(const std::string& name) {
        return name.empty() ? "the object without a name" : fmt::format("object `{}`", name);
    }
    static std::string names_of(const Change& change) {
        constexpr std::size_t most = 3;
        std::string text;
        for (std::size_t i = 0; i < std::min(most, change.objects.size()); ++i)
            text += (i > 0 ? ", " : "") +
                    (change.objects[i].empty() ? std::string("the level") : "`" + change.objects[i] + "`");
        return change.objects.size() > most
                   ? text + fmt::format(" and {} others", change.objects.size() - most)
                   : text;
    }
    static std::string sentence(const std::string& what, const Change& change) {
        if (what == "vertex")
            return fmt::format("{} of {} moved {}{:.3g} m",
                               change.faces == 1 ? "a vertex" : counted(change.faces, "vertex", "vertices"),
                               names_of(change), change.faces == 1 ? "" : "by up to ", change.largest);
        if (what == "object")
            return fmt::format("{} {} moved {:.3g} m", change.objects.size() == 1 ? "object" : "objects",
                               names_of(change), change.largest);
        return fmt::format("{} of {} {}", counted(change.faces, "face"), names_of(change),
                           change.faces == 1 && what.starts_with("have ") ? "has" + what.substr(4) : what);
    }
    Change& note(ActKind kind, const std::string& what, const std::string& object, std::size_t faces,
                 double moved = 0.0) {
        Change& change = changes_[{kind, what}];
        change.faces += faces;
        change.largest = std::max(change.largest, moved);
        if (change.objects.empty() || change.objects.back() != object) change.objects.push_back(object);
        return change;
    }

    // All objects by one factor, as after an export in other units.
    bool scaled(const Numbers& before, const Numbers& after) {
        double least = 1e30, most = -1e30;
        bool differs = false;
        if (before.size() != after.size()) return false;
        for (const auto& [name, was] : before.items()) {
            const Numbers& is = member_of(after, name);
            const auto a = face_list_of(was), b = face_list_of(is);
            if (!a || !b) return false;
            differs = differs || member_of(was, "hash") != member_of(is, "hash");
            const std::vector<Point> p = points_of(*a), q = points_of(*b);
            if (p.size() != q.size()) return false;
            for (std::size_t i = 0; i < p.size(); ++i)
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    if ((p[i][axis] == 0.0f) != (q[i][axis] == 0.0f)) return false;
                    if (p[i][axis] == 0.0f) continue;
                    const double ratio = double{q[i][axis]} / p[i][axis];
                    least = std::min(least, ratio);
                    most = std::max(most, ratio);
                }
        }
        if (!differs || least <= 0.0 || most - least > 1e-5 * most || std::abs(most - 1.0) < 1e-6)
            return false;
        const double percent = 100.0 * (0.5 * (least + most) - 1.0);
        say(ActKind::input,
            std::abs(percent) < 50.0
                ? fmt::format("the geometry was scaled by {:.3g} %", percent)
                : fmt::format("the geometry was scaled by a factor of {:.4g}", 0.5 * (least + most)));
        return true;
    }

    void compare_object(const std::string& name, const Numbers& was, const Numbers& is) {
        const auto a = face_list_of(was), b = face_list_of(is);
        if (!a || !b) {
            note(ActKind::input, "changed", name,
                 member_of(is, "faces").is_number() ? is["faces"].get<std::size_t>() : 0);
            return;
        }
        // Faces with the same corners are the same face.
        std::map<std::vector<Point>, std::vector<const FaceFact*>> there;
        for (const FaceFact& face : *b)
            there[corner_set(face)].push_back(&face);
        FaceList gone, come;
        for (const FaceFact& face : *a) {
            auto found = there.find(corner_set(face));
            if (found == there.end() || found->second.empty()) {
                gone.push_back(face);
                continue;
            }
            auto& same = found->second;
            const auto equal =
                std::find_if(same.begin(), same.end(), [&](const FaceFact* one) { return *one == face; });
            const auto partner = equal == same.end() ? same.begin() : equal;
            compare_faces(name, face, **partner);
            same.erase(partner);
        }
        for (const auto& [corners, rest] : there)
            for (const FaceFact* face : rest)
                come.push_back(*face);
        std::sort(come.begin(), come.end());
        if (gone.empty() && come.empty()) return;
        if (gone.empty()) return void(note(ActKind::input, "were added", name, come.size()));
        if (come.empty()) return void(note(ActKind::input, "were removed", name, gone.size()));
        if (gone.size() != come.size()) {
            note(ActKind::input, "were removed", name, gone.size());
            return void(note(ActKind::input, "were added", name, come.size()));
        }
        compare_points(name, *a, *b, gone.size());
    }

    void compare_points(const std::string& name, const FaceList& a, const FaceList& b, std::size_t faces) {
        const std::vector<Point> p = points_of(a), q = points_of(b);
        if (p.size() == q.size()) {
            const double moved = apart(p[0], q[0]);
            bool together = moved > 0.0;
            for (std::size_t i = 0; i < p.size() && together; ++i)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    together = together && std::abs((double{q[i][axis]} - p[i][axis]) -
                                                    (double{q[0][axis]} - p[0][axis])) <
                                               1e-6 * (1.0 + std::abs(double{p[i][axis]}));
            if (together) return void(note(ActKind::input, "object", name, 1, moved));
        }
        std::vector<Point> left, arrived;
        std::set_difference(p.begin(), p.end(), q.begin(), q.end(), std::back_inserter(left));
        std::set_difference(q.begin(), q.end(), p.begin(), p.end(), std::back_inserter(arrived));
        if (left.empty() || left.size() != arrived.size() || left.size() > 1000)
            return void(note(ActKind::input, "have other corners", name, faces));
        double largest = 0.0;
        const std::size_t count = left.size();
        for (const Point& from : left) {
            const auto to = std::min_element(
                arrived.begin(), arrived.end(),
                [&](const Point& x, const Point& y) { return apart(from, x) < apart(from, y); });
            largest = std::max(largest, apart(from, *to));
            arrived.erase(to);
        }
        note(ActKind::input, "vertex", name, count, largest);
    }

    void compare_faces(const std::string& name, const FaceFact& a, const FaceFact& b) {
        if (a == b) return;
        if (loop_of(a) != loop_of(b))
            note(ActKind::input, "were flipped", name, 1);
        else if (a.material == b.material && texture_corners(a) != texture_corners(b))
            note(ActKind::input, "changed texture coordinates", name, 1);
        if (a.material != b.material)
            note(ActKind::input, fmt::format("changed material `{}` to `{}`", a.material, b.material), name,
                 1);
        if (a.type != b.type)
            note(types_follow_ || a.material != b.material ? ActKind::effect : ActKind::input,
                 fmt::format("changed {} to {}", a.type, b.type), name, 1);
    }

    bool types_follow_;  // from rules or props, which have acts of their own
    std::vector<Act>& acts_;
    std::string where_;
    std::map<std::pair<ActKind, std::string>, Change> changes_;
};

// Platforms of an object that is gone move nothing, which is why it matters.
void add_platforms_without_faces(const Numbers& before, const Numbers& after, std::vector<Act>& acts) {
    for (const auto& [name, platform] : member_of(member_of(after, "members"), "platforms").items()) {
        const Numbers& group = member_of(platform, "group");
        if (!group.is_string()) continue;
        const auto object = group.get<std::string>();
        const bool was = member_of(before, "objects").contains(object),
                   is = member_of(after, "objects").contains(object);
        if (!was || is) continue;
        for (Act& act : acts)
            if (act.text.starts_with(fmt::format("object `{}` was ", object)))
                act.text += fmt::format(": platform `{}` moves nothing", name);
    }
}

}  // namespace

void add_geometry_acts(const Numbers& before, const Numbers& after, std::vector<Act>& acts) {
    const Numbers &was = member_of(before, "members"), &is = member_of(after, "members");
    const bool types_follow = member_of(was, "rules") != member_of(is, "rules") ||
                              member_of(was, "surfaces") != member_of(is, "surfaces");
    Geometry geometry(types_follow, acts);
    geometry.compare(member_of(before, "objects"), member_of(after, "objects"), "");
    const Numbers &meshes = member_of(before, "meshes"), &now = member_of(after, "meshes");
    for (const auto& [file, objects] : meshes.items())
        if (now.contains(file)) geometry.compare(objects, now[file], file);
    for (const auto& [file, objects] : now.items())
        if (!meshes.contains(file))
            acts.push_back({ActKind::effect, fmt::format("the mesh {} is new", file)});
    for (const auto& [file, objects] : meshes.items())
        if (!now.contains(file)) acts.push_back({ActKind::effect, fmt::format("the mesh {} is gone", file)});
    add_platforms_without_faces(before, after, acts);
}

}  // namespace slipface

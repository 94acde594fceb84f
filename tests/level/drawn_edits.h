// Levels drawn at random, and what modelling tools do to them: each face of the result knows which one it
// was.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <map>
#include <set>

#include "level/faces.h"

namespace slipface::test {

// Random numbers that are the same with every library.
class Draw {
  public:
    explicit Draw(std::uint64_t seed) : state_(seed * 2654435761u + 88172645463325252u) {}
    std::uint64_t next() {
        state_ ^= state_ << 13;
        state_ ^= state_ >> 7;
        return state_ ^= state_ << 17;
    }
    int from(int low, int high) {
        return low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1));
    }
    float within(float low, float high) {
        return low + (high - low) * static_cast<float>(next() % 100'000) / 1e5f;
    }
    bool one_in(int count) { return from(1, count) == 1; }
    template <class List>
    void shuffle(List& list) {
        for (std::size_t i = list.size(); i > 1; --i)
            std::swap(list[i - 1], list[next() % i]);
    }

  private:
    std::uint64_t state_;
};

namespace edits {

struct Side {
    std::vector<std::uint32_t> corners;
    int material = 0;
    std::size_t object = 0;
    int type = -1;  // that it should have; no_type: of several old faces with different ones
    std::size_t was = no_id;
};

inline constexpr int no_type = -2;

struct Scene {
    std::vector<Vec3f> points;
    std::vector<Side> faces;
    std::vector<std::string> names;  // of objects
    bool soup = false;               // each corner its own vertex, as in an STL

    Vec3f middle(const Side& face) const {
        Vec3f sum = Vec3f::Zero();
        for (const std::uint32_t corner : face.corners)
            sum += points[corner];
        return sum / static_cast<float>(face.corners.size());
    }
};

inline MeshPtr mesh_of(const Scene& scene) {
    PolygonSoup soup;
    soup.face_first_corner.push_back(0);
    if (!scene.soup) soup.vertex_position = scene.points;
    for (int material = 0; material < 3; ++material) {
        soup.materials.emplace_back().name =
            std::array{"stone", "wood", "tiles"}[static_cast<std::size_t>(material)];
    }
    soup.groups = scene.names;
    for (const Side& face : scene.faces) {
        for (const std::uint32_t corner : face.corners) {
            if (scene.soup)
                soup.corner_position.push_back(scene.points[corner]);
            else
                soup.corner_vertex.push_back(corner);
        }
        soup.face_first_corner.push_back(
            static_cast<std::uint32_t>(scene.soup ? soup.corner_position.size() : soup.corner_vertex.size()));
        soup.face_material.push_back(scene.soup ? 0u : static_cast<std::uint32_t>(face.material));
        soup.face_group.push_back(static_cast<std::uint32_t>(face.object));
    }
    Result<MeshPtr> mesh = build_mesh(std::move(soup));
    if (!mesh) {
        ADD_FAILURE() << mesh.error().text();
        return nullptr;
    }
    return *mesh;
}

// Levels

inline std::size_t add_object(Scene& scene, const std::string& name) {
    scene.names.push_back(name);
    return scene.names.size() - 1;
}

// A sheet of rows x columns quads in the object, `at` row and column; a column behind the last is the first
// one again if it is `round`.
template <class At>
void add_sheet(Scene& scene, std::size_t object, int material, int rows, int columns, bool round,
               const At& at) {
    const auto first = static_cast<std::uint32_t>(scene.points.size());
    const int across = columns + (round ? 0 : 1);
    for (int r = 0; r <= rows; ++r)
        for (int c = 0; c < across; ++c)
            scene.points.push_back(at(r, c));
    const auto index = [&](int r, int c) {
        return first + static_cast<std::uint32_t>(r * across + c % across);
    };
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
            scene.faces.push_back(
                {{index(r, c), index(r, c + 1), index(r + 1, c + 1), index(r + 1, c)}, material, object});
}

inline void merge_points(Scene& scene) {
    std::map<std::array<float, 3>, std::uint32_t> known;
    std::vector<std::uint32_t> now;
    std::vector<Vec3f> points;
    for (const Vec3f& point : scene.points) {
        const auto [place, added] =
            known.try_emplace({point.x(), point.y(), point.z()}, static_cast<std::uint32_t>(points.size()));
        if (added) points.push_back(point);
        now.push_back(place->second);
    }
    for (Side& face : scene.faces)
        for (std::uint32_t& corner : face.corners)
            corner = now[corner];
    scene.points = std::move(points);
}

// A box whose sides are n x m x k quads; `inside`: a room.
inline void add_box(Scene& scene, std::size_t object, int material, const Vec3f& low, const Vec3f& size,
                    const std::array<int, 3>& n, bool inside = false) {
    Scene box;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int end : {0, 1}) {
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            const bool back = (end == 1) == inside;
            add_sheet(box, object, material, n[u], n[v], false, [&](int r, int c) {
                Vec3f point = low;
                const auto set = [&](std::size_t a, float part) {
                    point[static_cast<int>(a)] += part * size[static_cast<int>(a)];
                };
                set(axis, static_cast<float>(end));
                set(u, static_cast<float>(back ? r : n[u] - r) / static_cast<float>(n[u]));
                set(v, static_cast<float>(c) / static_cast<float>(n[v]));
                return point;
            });
        }
    merge_points(box);
    const auto first = static_cast<std::uint32_t>(scene.points.size());
    scene.points.insert(scene.points.end(), box.points.begin(), box.points.end());
    for (Side face : box.faces) {
        for (std::uint32_t& corner : face.corners)
            corner += first;
        scene.faces.push_back(face);
    }
}

// A prism, cylinder, cone or dome of `sides` around and `rings` high.
inline void add_hull(Scene& scene, std::size_t object, int material, const Vec3f& at, int sides, int rings,
                     float radius, float height, bool dome) {
    const auto first = static_cast<std::uint32_t>(scene.points.size());
    const auto count = static_cast<std::uint32_t>(sides);
    add_sheet(scene, object, material, rings, sides, true, [&](int r, int c) {
        const float angle = 6.2831853f * static_cast<float>(c) / static_cast<float>(sides);
        const float up = static_cast<float>(r) / static_cast<float>(dome ? rings + 1 : rings);
        const float out = radius * (dome ? std::cos(1.5707963f * up) : 1.0f);
        return Vec3f(at + Vec3f(out * std::cos(angle), height * (dome ? std::sin(1.5707963f * up) : up),
                                out * std::sin(angle)));
    });
    std::vector<std::uint32_t> rim(count);
    std::iota(rim.begin(), rim.end(), first);
    scene.faces.push_back({rim, material, object});
    std::iota(rim.begin(), rim.end(), first + static_cast<std::uint32_t>(rings) * count);
    if (!dome) {
        std::reverse(rim.begin(), rim.end());
        scene.faces.push_back({rim, material, object});
        return;
    }
    scene.points.push_back(at + Vec3f(0, height, 0));
    for (std::uint32_t c = 0; c < count; ++c)
        scene.faces.push_back(
            {{rim[c], rim[(c + 1) % count], static_cast<std::uint32_t>(scene.points.size() - 1)},
             material,
             object});
}

inline Vec3f somewhere(Draw& draw, float far = 20) {
    return {draw.within(-far, far), draw.within(0, 2), draw.within(-far, far)};
}

inline Scene floor_of_tiles(Draw& draw) {
    Scene scene;
    const Vec3f at = somewhere(draw);
    const float tile = draw.one_in(2) ? 2.0f : draw.within(0.5f, 4);
    add_sheet(scene, add_object(scene, "floor"), 0, draw.from(3, 40), draw.from(1, 12), false,
              [&](int r, int c) {
                  return Vec3f(at + tile * Vec3f(static_cast<float>(r), 0, static_cast<float>(c)));
              });
    return scene;
}

inline Scene corridor(Draw& draw) {
    Scene scene;
    const Vec3f at = somewhere(draw);
    const int rows = draw.from(4, 60), columns = draw.from(1, 4), high = draw.from(1, 3);
    const bool one = draw.one_in(2);
    const std::size_t whole = one ? add_object(scene, "corridor") : 0;
    const auto sheet = [&](const char* name, int across, const Vec3f& from, const Vec3f& way) {
        const std::size_t object = one ? whole : add_object(scene, name);
        add_sheet(scene, object, one ? 0 : draw.from(0, 1), rows, across, false, [&](int r, int c) {
            return Vec3f(at + from +
                         2.0f * (Vec3f(static_cast<float>(r), 0, 0) + static_cast<float>(c) * way));
        });
    };
    const float wide = 2.0f * static_cast<float>(columns), tall = 2.0f * static_cast<float>(high);
    sheet("floor", columns, Vec3f::Zero(), Vec3f(0, 0, 1));
    sheet("left", high, Vec3f::Zero(), Vec3f(0, 1, 0));
    sheet("right", high, Vec3f(0, tall, wide), Vec3f(0, -1, 0));
    sheet("ceiling", columns, Vec3f(0, tall, wide), Vec3f(0, 0, -1));
    merge_points(scene);
    return scene;
}

inline Scene crates(Draw& draw, bool named, bool grid) {
    Scene scene;
    const int count = draw.from(2, 60);
    const Vec3f size(draw.within(0.5f, 2), draw.within(0.5f, 2),
                     draw.one_in(2) ? 1.0f : draw.within(0.5f, 2));
    const int n = draw.from(1, 2);
    if (draw.one_in(2)) {
        add_sheet(scene, add_object(scene, "ground"), 0, 1, 1, false, [](int r, int c) {
            return Vec3f(-50 + 300 * static_cast<float>(r), 0, -50 + 100 * static_cast<float>(c));
        });
    }
    const std::size_t all = named ? 0 : add_object(scene, "crates");
    for (int i = 0; i < count; ++i)
        add_box(scene, named ? add_object(scene, fmt::format("crate{:02}", i)) : all, 1,
                Vec3f(4.0f * static_cast<float>(i), 0, grid ? 0.0f : draw.within(-9, 9)), size, {n, n, n});
    return scene;
}

inline Scene hull(Draw& draw) {
    Scene scene;
    const std::size_t object = add_object(scene, draw.one_in(2) ? "hull" : "");
    const Vec3f at = draw.one_in(2) ? Vec3f(0, 0, 0) : somewhere(draw);
    switch (draw.from(0, 3)) {
        case 0: {
            const int n = draw.from(1, 10);
            const float edge = draw.within(1, 8);
            const bool cube = draw.one_in(2);
            add_box(scene, object, 0, at,
                    cube ? Vec3f::Constant(edge) : Vec3f(edge, draw.within(1, 8), 2 * edge),
                    {n, cube ? n : draw.from(1, 6), n});
            break;
        }
        case 1:
            add_hull(scene, object, 0, at, draw.from(3, 8), draw.from(1, 8), 3, draw.within(1, 6), false);
            break;
        case 2:
            add_hull(scene, object, 0, at, draw.from(9, 48), draw.from(1, 12), 4, draw.within(1, 9), false);
            break;
        default:
            add_hull(scene, object, 0, at, draw.from(6, 32), draw.from(2, 10), 5, draw.within(2, 6), true);
    }
    return scene;
}

inline Scene heightfield(Draw& draw) {
    Scene scene;
    const Vec3f at = somewhere(draw);
    add_sheet(scene, add_object(scene, "terrain"), 0, draw.from(8, 40), draw.from(8, 40), false,
              [&](int r, int c) {
                  return Vec3f(at + Vec3f(static_cast<float>(r), draw.within(0, 1), static_cast<float>(c)));
              });
    return scene;
}

inline Scene stairs(Draw& draw) {
    Scene scene;
    const int steps = draw.from(4, 60), columns = draw.from(1, 4);
    const float high = draw.within(0.1f, 0.3f), deep = draw.within(0.2f, 0.5f);
    const Vec3f at = somewhere(draw);
    add_sheet(scene, add_object(scene, "stairs"), 0, 2 * steps, columns, false, [&](int r, int c) {
        return Vec3f(at + Vec3f(deep * static_cast<float>(r / 2), high * static_cast<float>((r + 1) / 2),
                                static_cast<float>(c)));
    });
    return scene;
}

inline Scene rooms(Draw& draw) {
    Scene scene;
    const Vec3f at = draw.one_in(2) ? Vec3f(-10, 0, -10) : somewhere(draw);
    const int n = draw.from(2, 9);
    for (int i = 0; i < draw.from(1, 3); ++i) {
        const Vec3f low = at + Vec3f::Constant(static_cast<float>(2 * i));
        add_box(scene, add_object(scene, fmt::format("room{}", i)), i % 3, low,
                Vec3f::Constant(20.0f - 4.0f * static_cast<float>(i)), {n, n, n}, true);
    }
    for (int i = 0; i < draw.from(0, 6); ++i)
        add_box(scene, add_object(scene, fmt::format("crate{}", i)), 1,
                at + somewhere(draw, 5) + Vec3f(9, 0, 9), Vec3f(1, draw.within(0.5f, 2), 1.2f), {1, 1, 1});
    return scene;
}

inline Scene mixture(Draw& draw) {
    Scene scene;
    const auto add = [&](Scene part, const Vec3f& by) {
        const auto first = static_cast<std::uint32_t>(scene.points.size());
        const std::size_t object = scene.names.size();
        for (const std::string& name : part.names)
            scene.names.push_back(fmt::format("{}.{}", name, scene.names.size()));
        for (const Vec3f& point : part.points)
            scene.points.push_back(point + by);
        for (Side face : part.faces) {
            for (std::uint32_t& corner : face.corners)
                corner += first;
            face.object += object;
            scene.faces.push_back(face);
        }
    };
    add(rooms(draw), {0, 0, 0});
    add(stairs(draw), {60, 0, 0});
    add(crates(draw, true, true), {0, 0, 90});
    add(hull(draw), {-60, 0, 0});
    add(hull(draw), {-60, 0, 60});
    return scene;
}

inline Scene any_level(Draw& draw) {
    switch (draw.from(0, 9)) {
        case 0: return floor_of_tiles(draw);
        case 1: return corridor(draw);
        case 2: return crates(draw, true, draw.one_in(2));
        case 3: return crates(draw, false, draw.one_in(2));
        case 4: return hull(draw);
        case 5: return heightfield(draw);
        case 6: return stairs(draw);
        case 7: return rooms(draw);
        default: return mixture(draw);
    }
}

inline Scene objects(Draw& draw) {
    return draw.one_in(2) ? crates(draw, true, draw.one_in(2)) : mixture(draw);
}

inline void paint(Draw& draw, Scene& scene) {
    const int how = draw.from(0, 3);
    std::vector<int> of_object;
    for (std::size_t i = 0; i < scene.names.size(); ++i)
        of_object.push_back(draw.one_in(3) ? draw.from(0, 6) : -1);
    for (std::size_t i = 0; i < scene.faces.size(); ++i) {
        Side& face = scene.faces[i];
        face.was = i;
        if (how == 0 && scene.names.size() > 1)
            face.type = of_object[face.object];
        else if (draw.one_in(how == 1 ? 12 : 3))
            face.type = draw.from(0, how == 2 ? 1 : 6);
    }
    if (std::all_of(scene.faces.begin(), scene.faces.end(), [](const Side& face) { return face.type < 0; }))
        scene.faces[draw.next() % scene.faces.size()].type = 3;
}

// Edits

inline std::vector<std::uint32_t> points_of(const Scene& scene, std::size_t object) {
    std::vector<std::uint32_t> points;
    for (const Side& face : scene.faces)
        if (face.object == object) points.insert(points.end(), face.corners.begin(), face.corners.end());
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

// The box's middle, its lower part as `low`.
inline Vec3f centre_of(const Scene& scene, const std::vector<std::uint32_t>& points) {
    Vec3f low = Vec3f::Constant(1e9f), high = -low;
    for (const std::uint32_t point : points) {
        low = low.cwiseMin(scene.points[point]);
        high = high.cwiseMax(scene.points[point]);
    }
    return 0.5f * (low + high);
}

inline std::vector<std::uint32_t> all_points(const Scene& scene) {
    std::vector<std::uint32_t> all(scene.points.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

using Change = std::function<Vec3f(const Vec3f&)>;

inline void change(Scene& scene, const std::vector<std::uint32_t>& points, const Change& by) {
    for (const std::uint32_t point : points)
        scene.points[point] = by(scene.points[point]);
}

inline void turn_about(Scene& scene, const std::vector<std::uint32_t>& points, float degrees) {
    const Vec3f centre = centre_of(scene, points);
    const int quarters = static_cast<int>(std::lround(degrees / 90.0f));
    const bool exact = std::abs(degrees - 90.0f * static_cast<float>(quarters)) < 1e-3f;
    const float c = exact ? std::array{1.0f, 0.0f, -1.0f, 0.0f}[static_cast<std::size_t>(quarters % 4)]
                          : std::cos(degrees * 0.0174532925f);
    const float s = exact ? std::array{0.0f, 1.0f, 0.0f, -1.0f}[static_cast<std::size_t>(quarters % 4)]
                          : std::sin(degrees * 0.0174532925f);
    change(scene, points, [&](const Vec3f& p) {
        const Vec3f d = p - centre;
        return Vec3f(centre + Vec3f(c * d.x() - s * d.z(), d.y(), s * d.x() + c * d.z()));
    });
}

template <class Key>
void sort_faces(Scene& scene, const Key& key) {
    std::stable_sort(scene.faces.begin(), scene.faces.end(),
                     [&](const Side& a, const Side& b) { return key(a) < key(b); });
}

inline void sort_by_place(Scene& scene) {
    sort_faces(scene, [&](const Side& face) {
        const Vec3f middle = scene.middle(face);
        return std::tuple(face.object, std::round(1e3f * middle.x()), std::round(1e3f * middle.z()),
                          middle.y());
    });
}

inline void sort_objects(Scene& scene) {
    sort_faces(scene, [](const Side& face) { return face.object; });
}

// The points in another order: [new] old.
inline void renumber(Scene& scene, const std::vector<std::uint32_t>& order) {
    std::vector<std::uint32_t> now(order.size());
    std::vector<Vec3f> points;
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        now[order[i]] = i;
        points.push_back(scene.points[order[i]]);
    }
    scene.points = std::move(points);
    for (Side& face : scene.faces)
        for (std::uint32_t& corner : face.corners)
            corner = now[corner];
}

inline void shuffle_points(Scene& scene, Draw& draw) {
    std::vector<std::uint32_t> order = all_points(scene);
    draw.shuffle(order);
    renumber(scene, order);
}

inline void split_points(Scene& scene) {
    std::vector<Vec3f> points;
    for (Side& face : scene.faces)
        for (std::uint32_t& corner : face.corners) {
            points.push_back(scene.points[corner]);
            corner = static_cast<std::uint32_t>(points.size() - 1);
        }
    scene.points = std::move(points);
}

inline void triangulate(Scene& scene, bool other, std::size_t object = no_id) {
    std::vector<Side> faces;
    for (const Side& face : scene.faces) {
        if (object != no_id && face.object != object) {
            faces.push_back(face);
            continue;
        }
        std::vector<std::uint32_t> corners = face.corners;
        if (other && corners.size() == 4) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
        for (std::size_t c = 2; c < corners.size(); ++c) {
            faces.push_back(face);
            faces.back().corners = {corners[0], corners[c - 1], corners[c]};
        }
    }
    scene.faces = std::move(faces);
}

// As a program does that builds the whole anew: points and faces in the order of their places.
inline void regenerate(Scene& scene) {
    merge_points(scene);
    std::vector<std::uint32_t> order = all_points(scene);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const Vec3f &p = scene.points[a], &q = scene.points[b];
        return std::tuple(std::round(1e4f * p.x()), std::round(1e4f * p.y()), p.z()) <
               std::tuple(std::round(1e4f * q.x()), std::round(1e4f * q.y()), q.z());
    });
    renumber(scene, order);
    for (Side& face : scene.faces)
        std::rotate(face.corners.begin(), std::min_element(face.corners.begin(), face.corners.end()),
                    face.corners.end());
    sort_faces(scene, [](const Side& face) { return std::pair(face.object, face.corners); });
}

inline std::size_t an_object(const Scene& scene, Draw& draw) {
    return draw.next() % scene.names.size();
}

inline void delete_faces(Scene& scene, const std::function<bool(const Side&)>& gone) {
    std::vector<Side> left;
    for (const Side& face : scene.faces)
        if (!gone(face)) left.push_back(face);
    if (!left.empty()) scene.faces = std::move(left);
}

// All points beyond the middle of two neighbouring ones along x.
inline float a_cut(const Scene& scene, Draw& draw) {
    std::vector<float> xs;
    for (const Vec3f& point : scene.points)
        xs.push_back(point.x());
    std::sort(xs.begin(), xs.end());
    xs.erase(std::unique(xs.begin(), xs.end(), [](float a, float b) { return b - a < 1e-3f; }), xs.end());
    if (xs.size() < 2) return xs.front();
    const std::size_t at = draw.next() % (xs.size() - 1);
    return 0.5f * (xs[at] + xs[at + 1]);
}

// A floor or corridor of which rows come or go: all of its sheets are `rows` long along x.
inline void rows_in_or_out(Scene& scene, Draw& draw, bool in, bool close_up) {
    float tile = 1e9f, low = 1e9f, high = -1e9f;
    for (const Side& face : scene.faces) {
        const float x = scene.middle(face).x();
        low = std::min(low, x);
        high = std::max(high, x);
        tile = std::min(tile, 2.0f * std::abs(scene.points[face.corners[0]].x() - x));
    }
    const int rows = static_cast<int>(std::lround((high - low) / tile)) + 1;
    const int count = draw.from(1, std::max(1, std::min(3, rows - 2))), at = draw.from(0, rows - count);
    const auto row = [&](const Side& face) {
        return static_cast<int>(std::lround((scene.middle(face).x() - low) / tile));
    };
    std::vector<Side> faces;
    const float by = static_cast<float>(count) * tile;
    std::vector<Side> old = scene.faces;
    std::vector<int> rows_of;
    for (const Side& face : old)
        rows_of.push_back(row(face));
    const auto shifted = [&](Side face, float x) {
        for (std::uint32_t& corner : face.corners) {
            scene.points.push_back(scene.points[corner] + Vec3f(x, 0, 0));
            corner = static_cast<std::uint32_t>(scene.points.size() - 1);
        }
        return face;
    };
    for (std::size_t i = 0; i < old.size(); ++i) {
        const int r = rows_of[i];
        if (in) {
            if (r == at && (i == 0 || rows_of[i - 1] != at)) {
                std::vector<Side> added;
                for (std::size_t k = i; k < old.size() && rows_of[k] == at; ++k) {
                    added.push_back(old[k]);
                    added.back().type = -1;
                    added.back().was = no_id;
                }
                for (int n = 0; n < count; ++n)
                    for (const Side& face : added)
                        faces.push_back(shifted(face, static_cast<float>(n) * tile));
            }
            faces.push_back(r >= at ? shifted(old[i], by) : old[i]);
        } else if (r < at) {
            faces.push_back(old[i]);
        } else if (r >= at + count) {
            faces.push_back(close_up ? shifted(old[i], -by) : old[i]);
        }
    }
    if (faces.empty()) return;
    scene.faces = std::move(faces);
    merge_points(scene);
}

inline void extrude_or_inset(Scene& scene, Draw& draw, bool extrude) {
    const std::size_t count = scene.faces.size();
    for (int k = 0; k < draw.from(1, 6); ++k) {
        const std::size_t i = draw.next() % count;
        const Side face = scene.faces[i];
        if (face.corners.size() < 4) continue;
        const Vec3f middle = scene.middle(face);
        const Vec3f across = (scene.points[face.corners[1]] - scene.points[face.corners[0]])
                                 .cross(scene.points[face.corners[2]] - scene.points[face.corners[1]]);
        const Vec3f up = draw.within(0.3f, 2) * across.normalized();
        std::vector<std::uint32_t> top;
        for (const std::uint32_t corner : face.corners) {
            const Vec3f point = scene.points[corner];
            scene.points.push_back(extrude ? Vec3f(point + up) : Vec3f(middle + 0.7f * (point - middle)));
            top.push_back(static_cast<std::uint32_t>(scene.points.size() - 1));
        }
        for (std::size_t c = 0; c < top.size(); ++c) {
            const std::size_t next = (c + 1) % top.size();
            Side side{{face.corners[c], face.corners[next], top[next], top[c]}, face.material, face.object};
            if (!extrude) side.type = no_type;  // the rim was the face, too, or is new
            scene.faces.push_back(side);
        }
        scene.faces[i].corners = top;
    }
    sort_objects(scene);
}

// Quads become two or four.
inline void cut_quads(Scene& scene, bool in_four, bool in_place) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, added] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(scene.points.size()));
        if (added) scene.points.push_back(0.5f * (scene.points[a] + scene.points[b]));
        return place->second;
    };
    std::vector<Side> faces, later;
    for (const Side& face : scene.faces) {
        faces.push_back(face);
        if (face.corners.size() != 4) continue;
        const std::vector<std::uint32_t> c = face.corners;
        std::vector<std::vector<std::uint32_t>> pieces;
        if (in_four) {
            const auto centre = static_cast<std::uint32_t>(scene.points.size());
            scene.points.push_back(scene.middle(face));
            for (std::size_t k = 0; k < 4; ++k)
                pieces.push_back({c[k], middle(c[k], c[(k + 1) % 4]), centre, middle(c[(k + 3) % 4], c[k])});
        } else {
            const std::uint32_t a = middle(c[0], c[1]), b = middle(c[2], c[3]);
            pieces = {{c[0], a, b, c[3]}, {a, c[1], c[2], b}};
        }
        faces.back().corners = pieces[0];
        for (std::size_t k = 1; k < pieces.size(); ++k) {
            Side piece = face;
            piece.corners = pieces[k];
            (in_place ? faces : later).push_back(piece);
        }
    }
    faces.insert(faces.end(), later.begin(), later.end());
    scene.faces = std::move(faces);
    sort_objects(scene);
}

// Neighbours in the list that share an edge become one.
inline void merge_quads(Scene& scene, Draw& draw) {
    std::vector<Side> faces;
    for (std::size_t i = 0; i < scene.faces.size(); ++i) {
        Side face = scene.faces[i];
        if (i + 1 < scene.faces.size() && draw.one_in(2)) {
            const Side& next = scene.faces[i + 1];
            const auto& a = face.corners;
            const auto& b = next.corners;
            if (a.size() == 4 && b.size() == 4 && a[1] == b[0] && a[2] == b[3] &&
                face.object == next.object) {
                if (next.type != face.type) face.type = no_type;
                face.corners = {a[0], b[1], b[2], a[3]};
                ++i;
            }
        }
        faces.push_back(face);
    }
    scene.faces = std::move(faces);
}

inline void exchange_places(Scene& scene, const std::vector<std::size_t>& list,
                            const std::vector<std::size_t>& to) {
    std::vector<Vec3f> centres;
    for (const std::size_t object : list)
        centres.push_back(centre_of(scene, points_of(scene, object)));
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Vec3f by = centres[to[i]] - centres[i];
        change(scene, points_of(scene, list[i]), [&](const Vec3f& p) { return Vec3f(p + by); });
    }
}

// Objects whose names begin with "crate".
inline std::vector<std::size_t> crates_of(const Scene& scene) {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < scene.names.size(); ++i)
        if (scene.names[i].starts_with("crate")) list.push_back(i);
    return list;
}

struct Kind {
    const char* name;
    std::function<Scene(Draw&)> level;
    std::function<void(Scene&, Draw&)> edit;
    bool ordered;  // names and order are kept: 99 % is right
};

inline std::vector<Kind> kinds() {
    const auto turned = [](float degrees) {
        return [=](Scene& s, Draw&) { turn_about(s, all_points(s), degrees); };
    };
    const auto of_one =
        [](const std::function<void(Scene&, Draw&, const std::vector<std::uint32_t>&)>& edit) {
            return [=](Scene& s, Draw& d) { edit(s, d, points_of(s, an_object(s, d))); };
        };
    const auto then = [](const auto& a, const auto& b) {
        return [=](Scene& s, Draw& d) {
            a(s, d);
            b(s, d);
        };
    };
    const std::function<void(Scene&, Draw&)> reversed = [](Scene& s, Draw&) {
        std::reverse(s.faces.begin(), s.faces.end());
        sort_objects(s);
    };
    const std::function<void(Scene&, Draw&)> sorted = [](Scene& s, Draw&) { sort_by_place(s); };
    const std::function<void(Scene&, Draw&)> shuffled_faces = [](Scene& s, Draw& d) {
        d.shuffle(s.faces);
        sort_objects(s);
    };
    const std::function<void(Scene&, Draw&)> moved = [](Scene& s, Draw& d) {
        const Vec3f by = d.one_in(2) ? Vec3f(2, 0, 0) : somewhere(d);
        change(s, all_points(s), [&](const Vec3f& p) { return Vec3f(p + by); });
    };
    const auto mirror = [](Scene& s, const std::vector<std::uint32_t>& points) {
        const Vec3f centre = centre_of(s, points);
        change(s, points, [&](const Vec3f& p) { return Vec3f(2 * centre.x() - p.x(), p.y(), p.z()); });
    };
    const auto flip = [](Scene& s, std::size_t object) {
        for (Side& face : s.faces)
            if (object == no_id || face.object == object)
                std::reverse(face.corners.begin(), face.corners.end());
    };
    const std::function<void(Scene&, Draw&)> tools = [](Scene& s, Draw&) { regenerate(s); };
    const auto named_crates = [](Draw& d) { return crates(d, true, d.one_in(2)); };
    const auto joined_crates = [](Draw& d) { return crates(d, false, d.one_in(2)); };
    const auto tiles_or_corridor = [](Draw& d) { return d.one_in(2) ? floor_of_tiles(d) : corridor(d); };
    const std::function<void(Scene&, Draw&)> half_moved = [](Scene& s, Draw& d) {
        const float cut = a_cut(s, d), by = d.one_in(2) ? 4.0f : d.within(0.3f, 5);
        change(s, all_points(s),
               [&](const Vec3f& p) { return Vec3f(p.x() > cut ? p + Vec3f(by, 0, 0) : p); });
    };
    return {
        {"faces reversed", any_level, reversed, false},
        {"faces sorted by place", any_level, sorted, false},
        {"faces sorted by material", mixture,
         [](Scene& s, Draw&) {
             sort_faces(s, [](const Side& f) { return std::pair(f.material, f.object); });
         },
         true},
        {"faces shuffled", any_level, shuffled_faces, false},
        {"faces and corners shuffled", any_level,
         [=](Scene& s, Draw& d) {
             shuffled_faces(s, d);
             for (Side& f : s.faces)
                 std::rotate(f.corners.begin(), f.corners.begin() + d.from(0, 2), f.corners.end());
         },
         false},
        {"hull, faces reversed", hull, reversed, false},
        {"hull, faces sorted", hull, sorted, false},
        {"hull, faces shuffled", hull, shuffled_faces, false},
        {"tiles reversed", tiles_or_corridor, reversed, false},
        {"vertices shuffled", any_level, [](Scene& s, Draw& d) { shuffle_points(s, d); }, true},
        {"vertices merged", any_level, [](Scene& s, Draw&) { merge_points(s); }, true},
        {"vertices split", any_level, [](Scene& s, Draw&) { split_points(s); }, true},
        {"faces and vertices shuffled", any_level,
         [=](Scene& s, Draw& d) {
             shuffled_faces(s, d);
             shuffle_points(s, d);
         },
         false},
        {"objects in another order", objects,
         [](Scene& s, Draw& d) {
             std::vector<std::size_t> order(s.names.size());
             std::iota(order.begin(), order.end(), 0u);
             d.shuffle(order);
             sort_faces(s, [&](const Side& f) { return order[f.object]; });
         },
         true},
        {"objects renamed", objects,
         [](Scene& s, Draw& d) {
             for (std::string& name : s.names)
                 if (d.one_in(3)) name += "_new";
         },
         true},
        {"all objects renamed", objects,
         [](Scene& s, Draw&) {
             for (std::string& name : s.names)
                 name = fmt::format("mesh{}", &name - s.names.data());
         },
         false},
        {"objects joined", objects,
         [](Scene& s, Draw&) {
             for (Side& f : s.faces)
                 f.object = 0;
         },
         true},
        {"moved", any_level, moved, true},
        {"turned by a quarter", any_level, turned(90), true},
        {"turned by a half", any_level, turned(180), true},
        {"hull turned by a half", hull, turned(180), true},
        {"hull turned by a quarter", hull, turned(90), true},
        {"turned by any angle", any_level,
         [](Scene& s, Draw& d) { turn_about(s, all_points(s), d.within(1, 359)); }, true},
        {"mirrored", any_level, [=](Scene& s, Draw&) { mirror(s, all_points(s)); }, true},
        {"mirrored and flipped", any_level,
         [=](Scene& s, Draw&) {
             mirror(s, all_points(s));
             flip(s, no_id);
         },
         true},
        {"scaled", any_level,
         [](Scene& s, Draw& d) {
             const float by = d.one_in(2) ? 0.01f : d.within(0.5f, 3);
             change(s, all_points(s), [&](const Vec3f& p) { return Vec3f(by * p); });
         },
         true},
        {"scaled along an axis", any_level,
         [](Scene& s, Draw& d) {
             const Vec3f by(d.within(0.5f, 3), 1, 1);
             change(s, all_points(s), [&](const Vec3f& p) { return Vec3f(by.cwiseProduct(p)); });
         },
         true},
        {"flipped", any_level, [=](Scene& s, Draw&) { flip(s, no_id); }, true},
        {"an object moved", objects, of_one([](Scene& s, Draw& d, const auto& points) {
             const Vec3f by = d.one_in(2) ? Vec3f(4, 0, 0) : somewhere(d);
             change(s, points, [&](const Vec3f& p) { return Vec3f(p + by); });
         }),
         true},
        {"an object turned", objects, of_one([](Scene& s, Draw& d, const auto& points) {
             turn_about(s, points, 90.0f * static_cast<float>(d.from(1, 3)));
         }),
         true},
        {"an object mirrored", objects,
         of_one([=](Scene& s, Draw&, const auto& points) { mirror(s, points); }), true},
        {"an object scaled", objects, of_one([](Scene& s, Draw& d, const auto& points) {
             const Vec3f centre = centre_of(s, points);
             const float by = d.within(0.5f, 2);
             change(s, points, [&](const Vec3f& p) { return Vec3f(centre + by * (p - centre)); });
         }),
         true},
        {"an object flipped", objects, [=](Scene& s, Draw& d) { flip(s, an_object(s, d)); }, true},
        {"an object deleted", objects,
         [](Scene& s, Draw& d) {
             const std::size_t gone = an_object(s, d);
             delete_faces(s, [&](const Side& f) { return f.object == gone; });
         },
         true},
        {"a joined crate deleted", joined_crates,
         [](Scene& s, Draw& d) {
             std::size_t per = 6;
             while (per < s.faces.size() &&
                    s.faces[s.faces.size() - per].corners[0] != s.faces[s.faces.size() - 6].corners[0] &&
                    per < 24)
                 per += 6;
             const float cut = 4.0f * static_cast<float>(d.from(0, 5));
             delete_faces(s, [&](const Side& f) {
                 const float x = s.middle(f).x();
                 return x > cut - 0.5f && x < cut + 2.5f && s.names[f.object] == "crates";
             });
         },
         true},
        {"an object duplicated", objects,
         [](Scene& s, Draw& d) {
             const std::size_t from = an_object(s, d), copy = s.names.size();
             s.names.push_back(s.names[from] + ".001");
             const Vec3f by(d.within(3, 30), 0, 40);
             const std::vector<Side> faces = s.faces;
             std::map<std::uint32_t, std::uint32_t> now;
             for (Side f : faces) {
                 if (f.object != from) continue;
                 for (std::uint32_t& corner : f.corners) {
                     const auto [place, added] =
                         now.try_emplace(corner, static_cast<std::uint32_t>(s.points.size()));
                     if (added) s.points.push_back(s.points[corner] + by);
                     corner = place->second;
                 }
                 f.object = copy;
                 f.type = -1;
                 f.was = no_id;
                 s.faces.push_back(f);
             }
         },
         true},
        {"crates changed places", named_crates,
         [](Scene& s, Draw& d) {
             const std::vector<std::size_t> list = crates_of(s);
             std::vector<std::size_t> to(list.size());
             std::iota(to.begin(), to.end(), 0u);
             d.shuffle(to);
             exchange_places(s, list, to);
         },
         true},
        {"two crates changed places", named_crates,
         [](Scene& s, Draw& d) {
             const std::vector<std::size_t> list = crates_of(s);
             std::vector<std::size_t> to(list.size());
             std::iota(to.begin(), to.end(), 0u);
             std::swap(to[d.next() % to.size()], to[d.next() % to.size()]);
             exchange_places(s, list, to);
         },
         true},
        {"a crate where another was deleted", named_crates,
         [](Scene& s, Draw& d) {
             const std::vector<std::size_t> list = crates_of(s);
             const std::size_t gone = d.next() % list.size(),
                               other = (gone + 1 + d.next() % (list.size() - 1)) % list.size();
             exchange_places(s, {list[other], list[gone]}, {1, 0});
             delete_faces(s, [&](const Side& f) { return f.object == list[gone]; });
         },
         true},
        {"a joined crate moved", joined_crates,
         [](Scene& s, Draw& d) {
             const float at = 4.0f * static_cast<float>(d.from(0, 5));
             const Vec3f by =
                 d.one_in(2) ? Vec3f(4.0f * static_cast<float>(d.from(-3, 3)), 0, 0) : somewhere(d);
             change(s, all_points(s), [&](const Vec3f& p) {
                 return Vec3f(p.x() > at - 0.5f && p.x() < at + 2.5f && p.z() > -40 && p.z() < 40 ? p + by
                                                                                                  : p);
             });
         },
         false},
        {"rows inserted", tiles_or_corridor, [](Scene& s, Draw& d) { rows_in_or_out(s, d, true, true); },
         false},
        {"rows removed, closed up", tiles_or_corridor,
         [](Scene& s, Draw& d) { rows_in_or_out(s, d, false, true); }, false},
        {"rows removed", tiles_or_corridor, [](Scene& s, Draw& d) { rows_in_or_out(s, d, false, false); },
         true},
        {"stretched", tiles_or_corridor, half_moved, true},
        {"half moved", [=](Draw& d) { return d.one_in(2) ? joined_crates(d) : mixture(d); }, half_moved,
         false},
        {"tiles deleted", tiles_or_corridor,
         [](Scene& s, Draw& d) { delete_faces(s, [&](const Side&) { return d.one_in(10); }); }, false},
        {"first row deleted, one appended", floor_of_tiles,
         [](Scene& s, Draw&) {
             const float tile = (s.points[s.faces[0].corners[0]] - s.points[s.faces[0].corners[3]]).norm();
             change(s, all_points(s), [&](const Vec3f& p) { return Vec3f(p + Vec3f(tile, 0, 0)); });
         },
         false},
        {"made higher", [](Draw& d) { return d.one_in(2) ? rooms(d) : corridor(d); },
         [](Scene& s, Draw& d) {
             const float middle = centre_of(s, all_points(s)).y(), by = d.within(0.1f, 3);
             change(s, all_points(s),
                    [&](const Vec3f& p) { return Vec3f(p.y() > middle ? p + Vec3f(0, by, 0) : p); });
         },
         true},
        {"a vertex moved", any_level,
         [](Scene& s, Draw& d) { s.points[d.next() % s.points.size()] += 0.1f * somewhere(d, 5); }, true},
        {"rounded to a tenth of a millimetre", any_level,
         [](Scene& s, Draw&) {
             change(s, all_points(s),
                    [](const Vec3f& p) { return Vec3f((1e4f * p).array().round() / 1e4f); });
         },
         true},
        {"triangulated", any_level, [](Scene& s, Draw& d) { triangulate(s, d.one_in(2)); }, false},
        {"triangulated and moved", any_level,
         then([](Scene& s, Draw& d) { triangulate(s, d.one_in(2)); }, moved), false},
        {"an object triangulated", objects,
         [](Scene& s, Draw& d) { triangulate(s, d.one_in(2), an_object(s, d)); }, false},
        {"quads merged", [=](Draw& d) { return d.one_in(2) ? tiles_or_corridor(d) : hull(d); }, merge_quads,
         false},
        {"extruded", any_level, [](Scene& s, Draw& d) { extrude_or_inset(s, d, true); }, false},
        {"inset", any_level, [](Scene& s, Draw& d) { extrude_or_inset(s, d, false); }, false},
        {"cut in two", any_level, [](Scene& s, Draw& d) { cut_quads(s, false, d.one_in(2)); }, false},
        {"subdivided", any_level, [](Scene& s, Draw& d) { cut_quads(s, true, d.one_in(2)); }, false},
        {"tiles sorted and moved", tiles_or_corridor, then(sorted, moved), false},
        {"hull sorted and turned", hull,
         [](Scene& s, Draw& d) {
             turn_about(s, all_points(s), 90.0f * static_cast<float>(d.from(0, 3)));
             sort_by_place(s);
         },
         false},
        {"hull regenerated and turned", hull,
         [](Scene& s, Draw& d) {
             turn_about(s, all_points(s),
                        d.one_in(2) ? 90.0f * static_cast<float>(d.from(0, 3)) : d.within(1, 90));
             regenerate(s);
         },
         false},
        {"regenerated", any_level, tools, false},
        {"regenerated and half moved", joined_crates, then(half_moved, tools), false},
        {"regenerated, in triangles", any_level, then([](Scene& s, Draw&) { triangulate(s, false); }, tools),
         false},
        {"as a soup of triangles", any_level,
         [](Scene& s, Draw&) {
             triangulate(s, false);
             split_points(s);
             for (Side& f : s.faces)
                 f.material = 0;
         },
         false},
    };
}

struct Tally {
    std::size_t faces = 0, painted = 0;
    std::size_t right = 0, asked = 0, asked_wrong = 0, listed = 0;  // asked: guesses and questions
    std::size_t wrong = 0, strangers = 0, lost = 0;                 // in silence
    std::vector<std::size_t> silent_faces;                          // of one edit
    std::size_t silent() const { return wrong + strangers + lost; }
    void add(const Tally& o) {
        faces += o.faces;
        painted += o.painted;
        right += o.right;
        asked += o.asked;
        asked_wrong += o.asked_wrong;
        listed += o.listed;
        wrong += o.wrong;
        strangers += o.strangers;
        lost += o.lost;
    }
};

inline Level painted_level(const Scene& scene) {
    Level level;
    level.mesh_path = "folder/test.obj";
    level.file_path = "folder/test.slipface.json";
    level.mesh = mesh_of(scene);
    for (const Side& face : scene.faces)
        level.overrides.push_back(face.type < 0
                                      ? std::optional<SurfaceId>()
                                      : std::optional<SurfaceId>(static_cast<SurfaceId>(face.type)));
    return level;
}

inline LoadedLevel read_back(const std::string& text, const Scene& scene) {
    Result<LoadedLevel> loaded = level_from_json(text, "test.slipface.json", mesh_of(scene));
    if (loaded) return std::move(*loaded);
    ADD_FAILURE() << loaded.error().text();
    return {};
}

// What became of the paint of `before`.
inline Tally tally(const Scene& before, const Scene& after, const LoadedLevel& loaded) {
    Tally sum;
    std::map<std::array<long, 3>, int> listed;
    const auto place = [](const Vec3& at) -> std::array<long, 3> {
        return {std::lround(1e3 * at.x()), std::lround(1e3 * at.y()), std::lround(1e3 * at.z())};
    };
    for (const Orphan& orphan : loaded.level.orphans)
        ++listed[place(orphan.key.centroid)];
    const auto is_listed = [&](std::size_t was) {
        const Vec3 at = before.middle(before.faces[was]).cast<double>();
        for (int k = 0; k < 27; ++k)
            if (listed.contains(place(at + 1e-3 * Vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)))) return true;
        return false;
    };
    // A type on a guess or in a question is none that was lost in silence.
    std::set<int> asked_types;
    const auto is_asked = [&](std::size_t i) {
        const auto in = [&](const std::vector<FaceId>& list) {
            return std::binary_search(list.begin(), list.end(), static_cast<FaceId>(i));
        };
        return in(loaded.level.guessed) || in(loaded.second.faces);
    };
    for (std::size_t i = 0; i < after.faces.size(); ++i)
        if (loaded.level.overrides.at(i) && is_asked(i)) asked_types.insert(int{*loaded.level.overrides[i]});
    for (std::size_t i = 0; i < after.faces.size(); ++i) {
        const Side& face = after.faces[i];
        if (face.type == no_type) continue;
        const auto& found = loaded.level.overrides.at(i);
        const int type = found ? int{*found} : -1;
        const bool asked = is_asked(i) || (type < 0 && asked_types.contains(face.type));
        ++sum.faces;
        sum.painted += face.type >= 0 ? 1 : 0;
        if (asked) {
            ++sum.asked;
            sum.asked_wrong += type != face.type ? 1 : 0;
        } else if (type == face.type) {
            sum.right += face.type >= 0 ? 1 : 0;
        } else if (type >= 0) {
            sum.silent_faces.push_back(i);
            ++(face.type < 0 ? sum.strangers : sum.wrong);
        } else if (is_listed(face.was)) {
            ++sum.listed;
        } else {
            sum.silent_faces.push_back(i);
            ++sum.lost;
        }
    }
    return sum;
}

}  // namespace edits
}  // namespace slipface::test

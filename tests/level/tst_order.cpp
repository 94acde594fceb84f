// Edits after which names and the order of faces say what each face was, whatever stands at its place. The
// levels are drawn; what each edit makes of each face is known, because it is made here.
#include <fmt/format.h>

#include <chrono>
#include <functional>

#include "level/faces.h"

namespace slipface::test::order {
namespace {

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

  private:
    std::uint64_t state_;
};

// A piece of a level: a row of columns of tiles, as a floor has them, or the sides of a box.
struct Sheet {
    int rows = 0, columns = 0;
    std::vector<std::vector<Vec3f>> points;  // [row][column]
};

constexpr float tile = 2.0f;

Sheet flat_sheet(int rows, int columns, const Vec3f& at) {
    Sheet sheet{rows, columns, {}};
    for (int r = 0; r <= rows; ++r) {
        sheet.points.emplace_back();
        for (int c = 0; c <= columns; ++c)
            sheet.points.back().push_back(at + tile * Vec3f(static_cast<float>(r), 0, static_cast<float>(c)));
    }
    return sheet;
}

void add_sheet(const Sheet& sheet, const std::string& object, Faces& faces) {
    for (std::size_t r = 0; r < static_cast<std::size_t>(sheet.rows); ++r)
        for (std::size_t c = 0; c < static_cast<std::size_t>(sheet.columns); ++c) {
            faces.push_back(quad(sheet.points[r][c], sheet.points[r][c + 1], sheet.points[r + 1][c + 1],
                                 sheet.points[r + 1][c]));
            faces.back().object = object;
        }
}

void add_box(const Vec3f& low, const Vec3f& size, const std::string& object, Faces& faces) {
    const auto at = [&](int x, int y, int z) -> Vec3f {
        return low +
               size.cwiseProduct(Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)));
    };
    const Faces sides = {quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)),
                         quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)),
                         quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)),
                         quad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)),
                         quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)),
                         quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1))};
    for (Face side : sides) {
        side.object = object;
        faces.push_back(side);
    }
}

void paint(Draw& draw, Faces& faces) {
    for (Face& face : faces)
        if (draw.one_in(3)) face.painted = draw.from(0, 6);
}

void move(Face& face, const Vec3f& by) {
    for (Vec3f& corner : face.corners)
        corner += by;
}

// A corridor: floor, two walls and a ceiling as one object, or as four.
Faces corridor(Draw& draw, int rows) {
    Faces faces;
    const int columns = draw.from(1, 4), high = draw.from(1, 3);
    const bool one = draw.one_in(2);
    const auto name = [&](const char* part) { return one ? std::string("corridor") : std::string(part); };
    const Vec3f at(draw.within(-20, 20), 0, draw.within(-20, 20));
    Sheet floor = flat_sheet(rows, columns, at), wall = flat_sheet(rows, high, at);
    add_sheet(floor, name("floor"), faces);
    for (auto& row : wall.points)
        for (std::size_t c = 0; c < row.size(); ++c)
            row[c] = Vec3f(row[c].x(), tile * static_cast<float>(c), at.z());
    add_sheet(wall, name("wall"), faces);
    for (auto& row : floor.points)
        for (Vec3f& point : row)
            point.y() = tile * static_cast<float>(high);
    add_sheet(floor, name("ceiling"), faces);
    return faces;
}

struct Edit {
    Faces before, after;  // `after` with the types that its faces should have
};

// All that lies behind a plane across the corridor moves along it.
Edit stretched(Draw& draw) {
    Edit edit;
    const int rows = draw.from(4, 40), cut = draw.from(1, rows - 1);
    edit.before = corridor(draw, rows);
    paint(draw, edit.before);
    float low = 1e9f;
    for (const Face& face : edit.before)
        low = std::min(low, face.corners[0].x());
    const float behind = low + tile * (static_cast<float>(cut) - 0.5f);
    const float by = draw.one_in(2) ? tile * static_cast<float>(draw.from(1, 3)) : draw.within(0.3f, 5);
    edit.after = edit.before;
    for (Face& face : edit.after)
        for (Vec3f& corner : face.corners)
            if (corner.x() > behind) corner.x() += by;
    return edit;
}

// The upper half of all vertices rises.
Edit made_higher(Draw& draw) {
    Edit edit;
    edit.before = corridor(draw, draw.from(3, 20));
    for (int i = 0; i < draw.from(0, 5); ++i)
        add_box(Vec3f(draw.within(-20, 20), 0, draw.within(-20, 20)), Vec3f(1, 0.9f, 1),
                fmt::format("crate{}", i), edit.before);
    paint(draw, edit.before);
    const float by = draw.one_in(2) ? tile : draw.within(0.1f, 3);
    edit.after = edit.before;
    for (Face& face : edit.after)
        for (Vec3f& corner : face.corners)
            if (corner.y() > 1) corner.y() += by;
    return edit;
}

// Rows of tiles of random lengths, each row of one length: some are taken out or come in, and what is behind
// them closes up or makes room.
Edit rows_in_and_out(Draw& draw) {
    Edit edit;
    const int rows = draw.from(6, 40), columns = draw.from(1, 6);
    struct Row {
        float length;
        std::vector<int> types;
    };
    std::vector<Row> list;
    const auto drawn_row = [&](bool painted) {
        Row row{draw.within(0.5f, 4), {}};
        for (int c = 0; c < columns; ++c)
            row.types.push_back(painted && draw.one_in(3) ? draw.from(0, 6) : -1);
        return row;
    };
    for (int r = 0; r < rows; ++r)
        list.push_back(drawn_row(true));
    const auto built = [&](const std::vector<Row>& from) {
        Faces faces;
        float x = 0;
        for (const Row& row : from) {
            for (int c = 0; c < columns; ++c) {
                const float z = static_cast<float>(c);
                faces.push_back(
                    quad({x, 0, z}, {x, 0, z + 1}, {x + row.length, 0, z + 1}, {x + row.length, 0, z}));
                faces.back().painted = row.types[static_cast<std::size_t>(c)];
                faces.back().object = "floor";
            }
            x += row.length;
        }
        return faces;
    };
    edit.before = built(list);
    const int at = draw.from(0, rows - 3), count = draw.from(1, 2);
    const auto place = list.begin() + at;
    if (draw.one_in(2))
        list.erase(place, place + count);
    else
        for (int i = 0; i < count; ++i)
            list.insert(list.begin() + at, drawn_row(false));
    edit.after = built(list);
    return edit;
}

// Equal crates, named and in one order: all change places, or one is deleted and another one put there.
Edit crates(Draw& draw, bool deleted) {
    Edit edit;
    const int count = draw.from(2, 30);
    std::vector<Vec3f> places;
    for (int i = 0; i < count; ++i)
        places.push_back(Vec3f(3.0f * static_cast<float>(i), 0, static_cast<float>(draw.from(-9, 9))));
    const auto built = [&](const std::vector<Vec3f>& at, int without) {
        Faces faces;
        faces.push_back(quad({-50, 0, -50}, {-50, 0, 50}, {150, 0, 50}, {150, 0, -50}));
        faces.back().object = "ground";
        for (int i = 0; i < count; ++i)
            if (i != without)
                add_box(at[static_cast<std::size_t>(i)], Vec3f(1, 1, 1), fmt::format("crate{:02}", i), faces);
        return faces;
    };
    edit.before = built(places, -1);
    paint(draw, edit.before);
    std::vector<Vec3f> moved = places;
    const int gone = deleted ? draw.from(0, count - 1) : -1;
    if (deleted) {
        const int other = (gone + draw.from(1, count - 1)) % count;
        moved[static_cast<std::size_t>(other)] = places[static_cast<std::size_t>(gone)];
    } else {
        for (std::size_t i = moved.size(); i > 1; --i)
            std::swap(moved[i - 1], moved[draw.next() % i]);
    }
    edit.after = built(moved, gone);
    std::size_t from = 0;
    for (Face& face : edit.after) {
        while (edit.before[from].object != face.object)
            ++from;
        face.painted = edit.before[from++].painted;
    }
    return edit;
}

// The objects come in another order; nothing moved.
Edit reordered(Draw& draw) {
    Edit edit = crates(draw, false);
    std::vector<std::string> objects;
    for (const Face& face : edit.before)
        if (objects.empty() || objects.back() != face.object) objects.push_back(face.object);
    for (std::size_t i = objects.size(); i > 1; --i)
        std::swap(objects[i - 1], objects[draw.next() % i]);
    edit.after.clear();
    for (const std::string& object : objects)
        for (const Face& face : edit.before)
            if (face.object == object) edit.after.push_back(face);
    return edit;
}

// Tiles of which the first row is deleted and one more appended at the end. It could as well have moved.
Edit first_gone_one_more(Draw& draw) {
    Edit edit;
    const int rows = draw.from(3, 30), columns = draw.from(1, 5);
    const Vec3f at(draw.within(-9, 9), 0, 0);
    add_sheet(flat_sheet(rows, columns, at), "floor", edit.before);
    paint(draw, edit.before);
    add_sheet(flat_sheet(rows, columns, at + Vec3f(tile, 0, 0)), "floor", edit.after);
    const auto row = static_cast<std::size_t>(columns);
    for (std::size_t i = 0; i + row < edit.after.size(); ++i)
        edit.after[i].painted = edit.before[i + row].painted;
    return edit;
}

// Each face in triangles, in the order of the faces, and all moved.
Edit in_triangles(Draw& draw) {
    Edit edit;
    edit.before = corridor(draw, draw.from(3, 30));
    paint(draw, edit.before);
    const Vec3f by = draw.one_in(2) ? Vec3f(tile, 0, 0) : Vec3f(0, 0, 0);
    for (const Face& face : edit.before) {
        for (std::size_t c = 2; c < face.corners.size(); ++c) {
            Face triangle = face;
            triangle.corners = {face.corners[0], face.corners[c - 1], face.corners[c]};
            move(triangle, by);
            edit.after.push_back(triangle);
        }
    }
    return edit;
}

// Crates of one object, some of which move.
Edit half_moved(Draw& draw) {
    Edit edit;
    const int count = draw.from(4, 30), first = draw.from(1, count - 1);
    const bool by_one = draw.one_in(3);
    const Vec3f by =
        by_one ? Vec3f(3, 0, 0) : Vec3f(draw.within(-9, 9), draw.within(0, 3), draw.within(-9, 9));
    for (int i = 0; i < count; ++i)
        add_box(Vec3f(3.0f * static_cast<float>(i), 0, 0), Vec3f(1, 1.5f, 2), "crates", edit.before);
    paint(draw, edit.before);
    edit.after = edit.before;
    for (std::size_t i = 6 * static_cast<std::size_t>(first); i < edit.after.size(); ++i)
        move(edit.after[i], by);
    return edit;
}

// A symmetric room with crates in it, turned by 180 degrees about its middle.
Edit half_turned(Draw& draw) {
    Edit edit;
    const int rows = draw.from(2, 12), columns = draw.from(2, 12);
    const Vec3f middle = tile / 2 * Vec3f(static_cast<float>(rows), 0, static_cast<float>(columns));
    Sheet floor = flat_sheet(rows, columns, -middle);
    add_sheet(floor, "room", edit.before);
    for (auto& row : floor.points)
        for (Vec3f& point : row)
            point.y() = 4;
    add_sheet(floor, "room", edit.before);
    for (int i = 0; i < draw.from(0, 5); ++i)
        add_box(Vec3f(draw.within(-1, 1), 0, draw.within(-1, 1)).cwiseProduct(middle), Vec3f(1, 0.9f, 0.8f),
                fmt::format("crate{}", i), edit.before);
    paint(draw, edit.before);
    edit.after = edit.before;
    for (Face& face : edit.after)
        for (Vec3f& corner : face.corners)
            corner = Vec3f(-corner.x(), corner.y(), -corner.z());
    return edit;
}

// Tiles of a floor go, or rows come at its end; all others are where they were. Rows could have come
// elsewhere as well, if what is beyond made room.
Edit tiles_gone_or_more(Draw& draw, bool more) {
    Edit edit;
    const int rows = draw.from(3, 30), columns = draw.from(1, 8);
    const Vec3f at(draw.within(-9, 9), 0, 0);
    add_sheet(flat_sheet(rows, columns, at), "floor", edit.before);
    paint(draw, edit.before);
    if (!more) {
        for (const Face& face : edit.before)
            if (!draw.one_in(10)) edit.after.push_back(face);
    } else {
        add_sheet(flat_sheet(rows + draw.from(1, 4), columns, at), "floor", edit.after);
        for (std::size_t i = 0; i < edit.before.size(); ++i)
            edit.after[i].painted = edit.before[i].painted;
    }
    return edit;
}

struct Outcome {
    std::size_t painted = 0, right = 0, guessed = 0, listed = 0, silent = 0, strangers = 0;
    std::size_t edits = 0, right_if_asked = 0;  // edits: all paint right in one of the two readings
};

// Whether all faces have their type in the level's reading, or in its second one.
bool is_right_if_asked(const Edit& edit, const LoadedLevel& loaded) {
    std::vector<std::optional<SurfaceId>> second = loaded.level.overrides;
    for (std::size_t i = 0; i < loaded.second.faces.size(); ++i)
        second.at(loaded.second.faces[i]) = loaded.second.types[i];
    bool first_is_right = true, second_is_right = true;
    for (std::size_t i = 0; i < edit.after.size(); ++i) {
        const auto type_in = [&](const auto& types) { return types.at(i) ? int{*types.at(i)} : -1; };
        first_is_right = first_is_right && type_in(loaded.level.overrides) == edit.after[i].painted;
        second_is_right = second_is_right && type_in(second) == edit.after[i].painted;
    }
    return first_is_right || second_is_right;
}

// What became of the paint. `right` ones include guesses.
void add_outcome(const Edit& edit, Outcome& of) {
    const LoadedLevel loaded = rematch(edit.before, edit.after);
    ++of.edits;
    of.right_if_asked += is_right_if_asked(edit, loaded) ? 1 : 0;
    for (std::size_t i = 0; i < edit.after.size(); ++i) {
        const int wanted = edit.after[i].painted;
        const auto& found = loaded.level.overrides.at(i);
        const int type = found ? int{*found} : -1;
        const bool guess = std::binary_search(loaded.level.guessed.begin(), loaded.level.guessed.end(),
                                              static_cast<FaceId>(i));
        of.painted += wanted >= 0 ? 1 : 0;
        of.guessed += guess ? 1 : 0;
        if (type == wanted)
            of.right += wanted >= 0 ? 1 : 0;
        else if (type < 0)
            ++of.listed;
        else if (!guess)
            ++(wanted < 0 ? of.strangers : of.silent);
    }
}

struct Kind {
    const char* name;
    std::function<Edit(Draw&)> make;
    bool proved;    // names and order say all; else what they say may be a question
    bool followed;  // what they say is what was done
};

std::vector<Kind> kinds() {
    return {{"a corridor made longer", stretched, true, true},
            {"a room made higher", made_higher, true, true},
            {"rows in and out", rows_in_and_out, true, true},
            {"crates that changed places", [](Draw& draw) { return crates(draw, false); }, true, true},
            {"a crate where another was deleted", [](Draw& draw) { return crates(draw, true); }, true, true},
            {"objects in another order", reordered, true, true},
            {"triangulated", in_triangles, true, true},
            {"tiles deleted", [](Draw& draw) { return tiles_gone_or_more(draw, false); }, true, true},
            {"rows added at the end", [](Draw& draw) { return tiles_gone_or_more(draw, true); }, false, true},
            {"some crates of an object moved", half_moved, false, true},
            {"a symmetric room turned in its place", half_turned, false, true},
            {"first row deleted, one appended", first_gone_one_more, false, false}};
}

TEST(Order, ProvesWhatPlacesContradict) {
    for (const Kind& kind : kinds()) {
        Outcome with;
        for (std::uint64_t seed = 1; seed <= 400; ++seed) {
            Draw draw(seed);
            add_outcome(kind.make(draw), with);
        }
        EXPECT_EQ(with.silent + with.strangers, 0u) << kind.name;
        EXPECT_TRUE(!kind.followed || 100 * with.right >= 99 * with.painted) << kind.name;
        EXPECT_TRUE(!kind.proved || 50 * with.guessed <= with.painted)
            << kind.name << ": " << with.guessed << " of " << with.painted;
        EXPECT_GE(with.right_if_asked, with.edits - with.edits / 10) << kind.name;
    }
}

// Reading takes 0.07 s where nothing is left to search for.
TEST(Order, AHundredThousandFacesTakeNoTwoSeconds) {
    Faces before;
    const int side = 316;
    for (int i = 0; i < 10; ++i)
        add_sheet(flat_sheet(side, side / 10, Vec3f(0, static_cast<float>(i), 0)), fmt::format("floor{}", i),
                  before);
    Draw draw(1);
    paint(draw, before);
    Faces after = before;
    for (Face& face : after)
        for (Vec3f& corner : face.corners)
            if (corner.x() > static_cast<float>(side)) corner.x() += tile;
    const std::string text = level_to_json(level_of(before));
    const MeshPtr mesh = mesh_of(after);
    const auto start = std::chrono::steady_clock::now();
    const Result<LoadedLevel> loaded = level_from_json(text, "test.slipface.json", mesh);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    ASSERT_TRUE(loaded) << loaded.error().text();
    EXPECT_TRUE(wrong_faces(after, *loaded).empty());
    EXPECT_LT(taken.count(), 2.0);
}

}  // namespace
}  // namespace slipface::test::order

// Sheets of tiles that an edit merged into few faces with no corner left at the rim, and that moved, too:
// only their areas say where they went.
#include <array>
#include <map>

#include "faces.h"

namespace slipface::test {
namespace {

using Random = std::mt19937;

double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

// Tiles of a flat sheet: position (column, row) is at origin + column * right + row * up.
struct Sheet {
    int columns, rows;
    Vec3 origin, right, up;
    std::vector<Face> tiles;  // materials and types only; row by row

    std::vector<double> heights;  // of a hill, of each corner, row by row; else none

    Vec3 at(double column, double row) const {
        const Vec3 flat = origin + column * right + row * up;
        if (heights.empty()) return flat;
        const auto corner = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns + 1) +
                            static_cast<std::size_t>(column);
        return flat + Vec3(0, heights[corner], 0);
    }
    Face face(double left, double low, double right_end, double high) const {
        Face face;
        for (const auto& [column, row] :
             {std::pair{left, low}, {right_end, low}, {right_end, high}, {left, high}})
            face.corners.push_back(at(column, row).cast<float>());
        return face;
    }
};

// Patches of three by three tiles have one material and one type.
Sheet random_sheet(Random& random, const Vec3& origin, const Vec3& right, const Vec3& up) {
    Sheet sheet{
        9 + static_cast<int>(random() % 6), 7 + static_cast<int>(random() % 6), origin, right, up, {}, {}};
    std::map<std::pair<int, int>, Face> patches;
    for (int row = 0; row < sheet.rows; ++row) {
        for (int column = 0; column < sheet.columns; ++column) {
            const auto [patch, added] = patches.try_emplace({column / 3, row / 3});
            if (added) patch->second.material = random() % 2 == 0 ? "stone" : "wood";
            if (added) patch->second.painted = static_cast<int>(random() % 6) - 1;
            sheet.tiles.push_back(patch->second);
        }
    }
    return sheet;
}

void add_tiles(const Sheet& sheet, Faces& faces) {
    for (int row = 0; row < sheet.rows; ++row) {
        for (int column = 0; column < sheet.columns; ++column) {
            Face face = sheet.face(column, row, column + 1, row + 1);
            const Face& tile = sheet.tiles[static_cast<std::size_t>(row * sheet.columns + column)];
            face.material = tile.material;
            face.painted = tile.painted;
            faces.push_back(face);
        }
    }
}

// The sheet cut into rectangles of up to `most` by `most` tiles, a flat one's rim drawn in by less than a
// fifth of a tile. Each has the material of its middle tile and is painted with the type of most of its area;
// -2: none has clearly most.
void add_merged(const Sheet& sheet, Random& random, Faces& faces, unsigned most = 3) {
    const auto inside = [&](int position, int end) {
        const double rim = sheet.heights.empty() ? between(random, 0.05, 0.2) : 0.0;
        return position == 0 ? rim : position == end ? end - rim : position;
    };
    for (int low = 0, high = 0; low < sheet.rows; low = high) {
        high = std::min(sheet.rows, low + 1 + static_cast<int>(random() % most));
        for (int left = 0, end = 0; left < sheet.columns; left = end) {
            end = std::min(sheet.columns, left + 1 + static_cast<int>(random() % most));
            Face face = sheet.face(inside(left, sheet.columns), inside(low, sheet.rows),
                                   inside(end, sheet.columns), inside(high, sheet.rows));
            std::map<int, int> count;
            for (int row = low; row < high; ++row)
                for (int column = left; column < end; ++column)
                    ++count[sheet.tiles[static_cast<std::size_t>(row * sheet.columns + column)].painted];
            face.material =
                sheet.tiles[static_cast<std::size_t>((low + high) / 2 * sheet.columns + (left + end) / 2)]
                    .material;
            face.painted = -2;
            for (const auto& [type, tiles] : count)
                if (tiles > 0.6 * (high - low) * (end - left)) face.painted = type;
            faces.push_back(face);
        }
    }
}

struct Count {
    std::size_t clear = 0, right = 0, wrong = 0;
    void add(const Faces& after, const LoadedLevel& loaded) {
        for (std::size_t i = 0; i < after.size(); ++i) {
            const auto& type = loaded.level.overrides.at(i);
            if (after[i].painted >= 0) {
                ++clear;
                right += type && int{*type} == after[i].painted ? 1 : 0;
            }
            wrong += after[i].painted != -2 && type && int{*type} != after[i].painted ? 1 : 0;
        }
    }
};

Faces moved(Faces faces, const Eigen::Affine3d& motion) {
    for (Face& face : faces)
        for (Vec3f& corner : face.corners)
            corner = (motion * corner.cast<double>()).cast<float>();
    return rounded(faces);
}

Eigen::Affine3d random_turn(Random& random, const Vec3& axis) {
    return Eigen::Translation3d(between(random, -9, 9), between(random, -2, 2), between(random, -9, 9)) *
           Eigen::AngleAxisd(between(random, 0.1, 3), axis);
}

TEST(Area, AMergedFloorThatTurnedIsFound) {
    Count count;
    for (unsigned seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const double tile = between(random, 0.5, 3);
        const Sheet floor = random_sheet(random, Vec3(3, 0.2, 5), Vec3(tile, 0, 0), Vec3(0, 0, -tile));
        Faces before, after;
        add_tiles(floor, before);
        add_merged(floor, random, after);
        after = moved(after, random_turn(random, Vec3::UnitY()));
        count.add(after, rematch(before, after));
    }
    EXPECT_GT(count.clear, 500u);
    EXPECT_GT(static_cast<double>(count.right), 0.95 * static_cast<double>(count.clear));
    EXPECT_LE(100 * count.wrong, count.clear);
}

// A floor and walls, some of them alike.
TEST(Area, AMergedLevelThatTurnedAsAWholeIsFound) {
    Count count;
    for (unsigned seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const double tile = between(random, 0.5, 3);
        std::vector<Sheet> sheets{random_sheet(random, Vec3(3, 0.2, 5), Vec3(tile, 0, 0), Vec3(0, 0, -tile))};
        for (int i = 0; i < 4; ++i) {
            const Vec3 origin(between(random, -40, 40), between(random, 0, 3), between(random, -40, 40));
            const bool along = random() % 2 == 0;
            sheets.push_back(random_sheet(random, origin, along ? Vec3(tile, 0, 0) : Vec3(0, 0, tile),
                                          Vec3(0, 0.7 * tile, 0)));
        }
        Faces before, after;
        for (const Sheet& sheet : sheets) {
            add_tiles(sheet, before);
            add_merged(sheet, random, after);
        }
        const Vec3 axis = Vec3(between(random, -1, 1), 1, between(random, -1, 1)).normalized();
        after = moved(after, random_turn(random, axis));
        count.add(after, rematch(before, after));
    }
    EXPECT_GT(count.clear, 2000u);
    EXPECT_GT(static_cast<double>(count.right), 0.95 * static_cast<double>(count.clear));
    EXPECT_LE(100 * count.wrong, count.clear);
}

TEST(Area, AMergedHillThatTurnedIsFound) {
    Count count;
    for (unsigned seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const double tile = between(random, 0.5, 3);
        Sheet hill = random_sheet(random, Vec3(3, 0.2, 5), Vec3(tile, 0, 0), Vec3(0, 0, -tile));
        for (int i = 0; i < (hill.columns + 1) * (hill.rows + 1); ++i)
            hill.heights.push_back(between(random, 0, 0.4 * tile));
        for (Face& patch : hill.tiles)
            patch.material = "grass";
        Faces before, after;
        add_tiles(hill, before);
        add_merged(hill, random, after, 2);
        after = moved(after, random_turn(random, Vec3::UnitY()));
        count.add(after, rematch(before, after));
    }
    EXPECT_GT(count.clear, 1000u);
    EXPECT_GT(static_cast<double>(count.right), 0.8 * static_cast<double>(count.clear));
    EXPECT_LE(50 * count.wrong, count.clear);
}

// Of a hill that was decimated few faces are left in the plane of an old one.
TEST(Area, AMergedHillKeepsItsTypes) {
    Count count;
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const double tile = between(random, 0.3, 2), height = between(random, 0.4, 0.7);
        Sheet hill = random_sheet(random, Vec3(3, 0.2, 5), Vec3(tile, 0, 0), Vec3(0, 0, -tile));
        for (int i = 0; i < (hill.columns + 1) * (hill.rows + 1); ++i)
            hill.heights.push_back(between(random, 0, height * tile));
        for (Face& patch : hill.tiles)
            patch.material = "grass";
        Faces before, after;
        add_tiles(hill, before);
        add_merged(hill, random, after, 3 + static_cast<unsigned>(random() % 2));
        count.add(after, rematch(before, after));
    }
    EXPECT_GT(count.clear, 800u);
    EXPECT_GT(static_cast<double>(count.right), 0.985 * static_cast<double>(count.clear));
    EXPECT_LE(200 * count.wrong, count.clear);
}

// A voxel remesh of walls that enclose nothing leaves shells of some of them, of one material.
TEST(Area, WhatIsLeftOfARemeshedHallKeepsItsTypes) {
    Count count;
    for (unsigned seed = 0; seed < 10; ++seed) {
        Random random(seed);
        const double tile = between(random, 0.5, 2);
        const double width = 5 * tile, depth = 6 * tile;
        Sheet floor = random_sheet(random, Vec3(3, 0.2, 5), Vec3(tile, 0, 0), Vec3(0, 0, -tile));
        floor.columns = 5;
        floor.rows = 6;
        std::vector<Sheet> walls;
        for (const bool far : {false, true}) {
            walls.push_back(random_sheet(random, floor.origin + Vec3(far ? width : 0, 0, 0),
                                         Vec3(0, 0, -tile), Vec3(0, tile, 0)));
            walls.back().columns = 6;
            walls.push_back(random_sheet(random, floor.origin + Vec3(0, 0, far ? -depth : 0),
                                         Vec3(tile, 0, 0), Vec3(0, tile, 0)));
            walls.back().columns = 5;
        }
        Faces before, after;
        for (Face& face : floor.tiles)
            face.material = "wood";
        add_tiles(floor, before);
        const std::size_t first = random() % 4, left = 1 + random() % 2;
        for (std::size_t i = 0; i < walls.size(); ++i) {
            Sheet& wall = walls[i];
            wall.rows = 3;
            for (Face& face : wall.tiles)
                face.material = "plaster";
            add_tiles(wall, before);
            if ((i + 4 - first) % 4 >= left) continue;
            // Voxels of 0.4 tiles, so that some lie across a border.
            for (int row = 1; row < 7; ++row) {
                for (int column = 1; column < 2 * wall.columns; ++column) {
                    Face face = wall.face(0.4 * column, 0.4 * row, 0.4 * (column + 1), 0.4 * (row + 1));
                    face.material = "wood";
                    Face back = face;
                    std::reverse(back.corners.begin(), back.corners.end());
                    const auto whole = [](int at) { return (2 * at) % 5 < 4; };
                    face.painted = -2;
                    if (whole(column) && whole(row))
                        face.painted =
                            wall.tiles[static_cast<std::size_t>(2 * row / 5 * wall.columns + 2 * column / 5)]
                                .painted;
                    after.push_back(face);
                    after.push_back(back);
                }
            }
        }
        count.add(after, rematch(before, after));
    }
    EXPECT_GT(count.clear, 300u);
    EXPECT_GT(static_cast<double>(count.right), 0.98 * static_cast<double>(count.clear));
    EXPECT_LE(200 * count.wrong, count.clear);
}

// Remeshing gives a part many faces of one material, whatever it was made of. Another part keeps its
// materials.
TEST(Area, ARemeshedFloorKeepsItsTypesThoughNotItsMaterials) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        Random random(seed);
        Faces before, after;
        const Sheet floor = random_sheet(random, Vec3(3, 0.2, 5), Vec3(1, 0, 0), Vec3(0, 0, -1));
        const Sheet other = random_sheet(random, Vec3(40, 1, 5), Vec3(1, 0, 0), Vec3(0, 0, -1));
        add_tiles(floor, before);
        add_tiles(other, before);
        for (int row = 0; row < 2 * floor.rows; ++row) {
            for (int column = 0; column < 2 * floor.columns; ++column) {
                Face face = floor.face(0.5 * column, 0.5 * row, 0.5 * (column + 1), 0.5 * (row + 1));
                face.painted =
                    floor.tiles[static_cast<std::size_t>(row / 2 * floor.columns + column / 2)].painted;
                after.push_back(face);
            }
        }
        add_tiles(other, after);
        EXPECT_TRUE(wrong_faces(after, rematch(before, after)).empty()) << seed;
    }
}

// The eight corners of a box, each up to `bent` of its size off, as six faces of one type.
Faces box(const Vec3& low, double size, int type, double bent, Random& random) {
    std::vector<Vec3f> corners;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner = Vec3(i & 1, i >> 1 & 1, i >> 2);
        const Vec3 by(between(random, -bent, bent), between(random, -bent, bent),
                      between(random, -bent, bent));
        corners.emplace_back((low + size * (corner + by)).cast<float>());
    }
    Faces faces;
    for (const std::array<std::size_t, 4>& side : {std::array<std::size_t, 4>{0, 4, 6, 2},
                                                   {1, 3, 7, 5},
                                                   {0, 1, 5, 4},
                                                   {2, 6, 7, 3},
                                                   {0, 2, 3, 1},
                                                   {4, 5, 7, 6}}) {
        Face face;
        for (const std::size_t corner : side)
            face.corners.push_back(corners[corner]);
        face.material = "metal";
        face.painted = type;
        faces.push_back(face);
    }
    return faces;
}

// Uneven ground, most of its area in huge tiles at its rim, which an edit bent; of the others it left half as
// they were. Of small boxes it left no corner in its place. The few tiles say where all of it went.
TEST(Area, SmallModelsFollowTheirLevel) {
    Count tiles, boxes;
    for (unsigned seed = 0; seed < 30; ++seed) {
        Random random(seed);
        constexpr int side = 12;
        std::vector<double> steps{0.0};
        for (int i = 0; i < side; ++i)
            steps.push_back(steps.back() + (i == 0 || i + 1 == side ? 40.0 : between(random, 1, 3)));
        std::map<std::pair<int, int>, std::pair<Vec3, Vec3>> corners;  // before and after
        for (int i = 0; i <= side; ++i) {
            for (int k = 0; k <= side; ++k) {
                const Vec3 corner(steps[static_cast<std::size_t>(i)], between(random, 0, 0.5),
                                  -steps[static_cast<std::size_t>(k)]);
                const bool rim = std::min(i, k) < 2 || std::max(i, k) > side - 2;
                const double by = rim ? 9.0 : random() % 8 == 0 ? 0.3 : 0.0;
                const Vec3 off(between(random, -by, by), between(random, -by, by), between(random, -by, by));
                corners[{i, k}] = {corner, corner + off};
            }
        }
        Faces before, after, models, bent;
        for (int i = 0; i < side; ++i) {
            for (int k = 0; k < side; ++k) {
                Face old, left;
                for (const auto& at : {std::pair{i, k}, {i + 1, k}, {i + 1, k + 1}, {i, k + 1}}) {
                    old.corners.push_back(corners[at].first.cast<float>());
                    left.corners.push_back(corners[at].second.cast<float>());
                }
                old.painted = left.painted = static_cast<int>(random() % 6) - 1;
                const bool rim = std::min(i, k) < 2 || std::max(i, k) > side - 3;
                if (rim) left.painted = -2;  // bent too much to tell
                before.push_back(old);
                after.push_back(left);
            }
        }
        for (int i = 0; i < 12; ++i) {
            const Vec3 low(between(random, 42, 60), between(random, 1, 4), -between(random, 42, 60));
            const double size = between(random, 0.3, 0.8);
            const int type = static_cast<int>(random() % 5);
            for (const Face& face : box(low, size, type, 0.0, random))
                models.push_back(face);
            for (const Face& face : box(low, size, type, 0.12, random))
                bent.push_back(face);
        }
        before.insert(before.end(), models.begin(), models.end());
        const std::size_t ground = after.size();
        after.insert(after.end(), bent.begin(), bent.end());
        after = moved(after, random_turn(random, Vec3::UnitY()));
        const LoadedLevel loaded = rematch(before, after);
        for (std::size_t i = 0; i < after.size(); ++i) {
            const auto& type = loaded.level.overrides.at(i);
            Count& count = i < ground ? tiles : boxes;
            count.clear += after[i].painted >= 0 ? 1 : 0;
            count.right += after[i].painted >= 0 && type && int{*type} == after[i].painted ? 1 : 0;
            count.wrong += after[i].painted != -2 && type && int{*type} != after[i].painted ? 1 : 0;
        }
    }
    EXPECT_GT(tiles.right, tiles.clear * 95 / 100);
    EXPECT_GT(boxes.right, boxes.clear * 90 / 100);
    EXPECT_LE(100 * (tiles.wrong + boxes.wrong), tiles.clear + boxes.clear);
}

// Remeshing rounds the edges of boxes, so that no face of a small one is left in its plane. What is nearest
// to a side that was not painted has no type.
TEST(Area, ARemeshedBoxKeepsItsTypesAtItsRoundedEdges) {
    Count count;
    for (unsigned seed = 0; seed < 20; ++seed) {
        Random random(seed);
        Faces before, after;
        for (int i = 0; i < 6; ++i) {
            const Vec3 low(4.0 * i, between(random, 0, 2), between(random, -9, 9));
            const double size = between(random, 0.5, 2);
            constexpr int cells = 6;
            for (int axis = 0; axis < 3; ++axis) {
                for (const bool far : {false, true}) {
                    const int type = static_cast<int>(random() % 6) - 1;
                    const auto at = [&](double u, double v) {  // of a unit cube
                        Vec3 point;
                        point[axis] = far ? 1.0 : 0.0;
                        point[(axis + 1) % 3] = far ? u : v;
                        point[(axis + 2) % 3] = far ? v : u;
                        return point;
                    };
                    const auto rounded_off = [&](const Vec3& point) {
                        const Vec3 inner = point.cwiseMax(0.4).cwiseMin(0.6);
                        return Vec3(inner + 0.4 * (point - inner).normalized());
                    };
                    const auto add = [&](Faces& faces, double u, double v, double step, bool round) {
                        Face face;
                        face.material = "wood";
                        face.painted = type;
                        for (const auto& [a, b] :
                             {std::pair{u, v}, {u + step, v}, {u + step, v + step}, {u, v + step}})
                            face.corners.push_back(
                                (low + size * (round ? rounded_off(at(a, b)) : at(a, b))).cast<float>());
                        faces.push_back(face);
                    };
                    add(before, 0, 0, 1, false);
                    for (int row = 0; row < cells; ++row)
                        for (int column = 0; column < cells; ++column)
                            add(after, 1.0 * row / cells, 1.0 * column / cells, 1.0 / cells, true);
                }
            }
        }
        count.add(after, rematch(before, after));
    }
    EXPECT_GT(count.clear, 1000u);
    EXPECT_GT(static_cast<double>(count.right), 0.95 * static_cast<double>(count.clear));
    EXPECT_LE(100 * count.wrong, count.clear);
}

// Of a box's side, the part from (u, v) to (u_end, v_end), each from 0 to 1.
Face part_of_side(const Aabb& box, int axis, bool far, double u, double v, double u_end, double v_end) {
    Face face;
    for (const auto& [a, b] : {std::pair{u, v}, {u_end, v}, {u_end, v_end}, {u, v_end}}) {
        Vec3 at;  // of a unit cube
        at[axis] = far ? 1.0 : 0.0;
        at[(axis + 1) % 3] = far ? a : b;
        at[(axis + 2) % 3] = far ? b : a;
        face.corners.emplace_back((box.min + box.size().cwiseProduct(at)).cast<float>());
    }
    return face;
}

// A desk of boards in two materials, a few millimetres apart. Voxels make one piece of one material of them.
TEST(Area, BoardsOfOneObjectThatGrewTogetherKeepTheirTypes) {
    Count count;
    for (unsigned seed = 0; seed < 20; ++seed) {
        Random random(seed);
        Faces before = tiles(5, -3.0f), after = before;
        const double depth = between(random, 0.5, 1), height = between(random, 0.5, 1);
        std::vector<Aabb> boards;
        std::vector<std::array<int, 6>> types;
        for (double from = 0; boards.size() < 2 + seed % 4;) {
            const double to = from + between(random, 0.3, 1);
            boards.push_back({Vec3(from, 0, 0), Vec3(to, height, depth)});
            from = to + 0.004;
            for (int& type : types.emplace_back())
                type = static_cast<int>(random() % 6) - 1;
        }
        const Aabb all{boards.front().min, boards.back().max};
        for (std::size_t i = 0; i < 6; ++i) {
            const int axis = static_cast<int>(i) / 2;
            const bool far = i % 2 == 1;
            for (std::size_t k = 0; k < boards.size(); ++k) {
                before.push_back(part_of_side(boards[k], axis, far, 0, 0, 1, 1));
                before.back().material = k % 2 == 0 ? "wood" : "metal";
                before.back().painted = types[k][i];
                before.back().object = "desk";
            }
            constexpr int cells = 16;
            for (int cell = 0; cell < cells * cells; ++cell) {
                const double u = 1.0 * (cell % cells) / cells, v = 1.0 * (cell / cells) / cells;
                Face face = part_of_side(all, axis, far, u, v, u + 1.0 / cells, v + 1.0 / cells);
                face.material = "wood";
                face.object = "desk";
                face.painted = axis == 0 ? types[far ? boards.size() - 1 : 0][i] : -2;
                for (std::size_t k = 0; k < boards.size(); ++k) {
                    Aabb covered;
                    for (const Vec3f& corner : face.corners)
                        covered.add(corner.cast<double>());
                    if (axis > 0 && covered.min.x() >= boards[k].min.x() - 1e-3 &&
                        covered.max.x() <= boards[k].max.x() + 1e-3)
                        face.painted = types[k][i];
                }
                after.push_back(face);
            }
        }
        count.add(after, rematch(before, after));
    }
    EXPECT_GT(count.clear, 10000u);
    EXPECT_GT(static_cast<double>(count.right), 0.98 * static_cast<double>(count.clear));
    EXPECT_LE(100 * count.wrong, count.clear);
}

// A square floor of one material and without a rim that says more looks the same after each quarter turn.
TEST(Area, AMergedFloorThatLooksTheSameTurnedIsListed) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        Random random(seed);
        Sheet floor = random_sheet(random, Vec3(3, 0.2, 5), Vec3(1, 0, 0), Vec3(0, 0, -1));
        floor.columns = floor.rows = 7;
        for (Face& tile : floor.tiles)
            tile.material = "stone";
        Faces before, after;
        add_tiles(floor, before);
        add_merged(floor, random, after);
        Count count;
        after = moved(after, random_turn(random, Vec3::UnitY()));
        count.add(after, rematch(before, after));
        EXPECT_EQ(count.wrong, 0u) << seed;
    }
}

// Square sheets of two halves look the same turned about by a half. Where three of them make an object, their
// places say how it turned; the objects beside it stay.
TEST(Area, TheSheetsOfADecimatedObjectTurnTogether) {
    Count count;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        Random random(seed);
        Faces before, object;
        for (int i = 0; i < 6; ++i) {
            const bool turns = i < 3;
            const Vec3 along =
                Vec3(between(random, 0.5, 1), between(random, -0.5, 0.5), between(random, -1, 1))
                    .normalized();
            Sheet sheet{
                8,  8, 12.0 * Vec3(turns ? i : 3 * i, turns ? i % 2 : 0, 0), along, along.unitOrthogonal(),
                {}, {}};
            for (int tile = 0; tile < 64; ++tile)
                sheet.tiles.push_back({{}, "stone", tile < 32 ? 1 : 2});
            add_tiles(sheet, before);
            const std::size_t first = before.size() - 64;
            for (std::size_t k = first; k < before.size(); ++k)
                before[k].object = turns ? "chair" : "other" + std::to_string(i);
            if (turns) add_merged(sheet, random, object);
        }
        Faces after = moved(object, random_turn(random, Vec3::UnitY()));
        for (Face& face : after)
            face.object = "chair";
        after.insert(after.end(), before.begin() + 3 * 64, before.end());
        count.add(after, rematch(before, after));
    }
    EXPECT_GT(static_cast<double>(count.right), 0.98 * static_cast<double>(count.clear));
    EXPECT_LE(static_cast<double>(count.wrong), 0.01 * static_cast<double>(count.clear));
}

// Of an object that was decimated and turned, hardly a face is left; of its copy elsewhere all are.
TEST(Area, ADecimatedObjectIsNotItsCopy) {
    Count count;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        Random random(seed);
        Sheet hill = random_sheet(random, Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1));
        for (int corner = 0; corner < (hill.columns + 1) * (hill.rows + 1); ++corner)
            hill.heights.push_back(between(random, 0, 0.8));
        Sheet copy = hill;
        copy.origin += Vec3(between(random, 20, 40), 0, between(random, -40, 40));
        for (Face& tile : copy.tiles)
            tile.painted = static_cast<int>(random() % 6) - 1;
        Faces before, after, kept;
        add_tiles(hill, before);
        add_merged(hill, random, after);
        add_tiles(copy, kept);
        for (Face& face : kept)
            face.object = "copy";
        before.insert(before.end(), kept.begin(), kept.end());
        after = moved(after, random_turn(random, Vec3::UnitY()));
        after.insert(after.end(), kept.begin(), kept.end());
        count.add(after, rematch(before, after));
    }
    EXPECT_GT(static_cast<double>(count.right), 0.9 * static_cast<double>(count.clear));
    EXPECT_LE(100 * count.wrong, count.clear);
}

}  // namespace
}  // namespace slipface::test

// Sheets of tiles that a decimation or a remesh made into other faces, and that moved, too. What is not found
// is listed, and what is found is a guess.
#include <functional>
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

Sheet random_floor(Random& random, double tile) {
    return random_sheet(random, Vec3(3, 0.2, 5), Vec3(tile, 0, 0), Vec3(0, 0, -tile));
}

Sheet random_hill(Random& random, double tile) {
    Sheet hill = random_floor(random, tile);
    for (int i = 0; i < (hill.columns + 1) * (hill.rows + 1); ++i)
        hill.heights.push_back(between(random, 0, 0.7 * tile));
    for (Face& patch : hill.tiles)
        patch.material = "grass";
    return hill;
}

struct Edit {
    Faces before, after;
};

Edit merged(const std::vector<Sheet>& sheets, Random& random) {
    Edit edit;
    for (const Sheet& sheet : sheets) {
        add_tiles(sheet, edit.before);
        add_merged(sheet, random, edit.after);
    }
    return edit;
}

Edit turned(Edit edit, Random& random) {
    const Vec3 axis = Vec3(between(random, -1, 1), 1, between(random, -1, 1)).normalized();
    edit.after = moved(edit.after, random_turn(random, axis));
    return edit;
}

// A floor and walls, some of them alike.
Edit merged_level(Random& random) {
    const double tile = between(random, 0.5, 3);
    std::vector<Sheet> sheets{random_floor(random, tile)};
    for (int i = 0; i < 4; ++i) {
        const Vec3 origin(between(random, -40, 40), between(random, 0, 3), between(random, -40, 40));
        const bool along = random() % 2 == 0;
        sheets.push_back(random_sheet(random, origin, along ? Vec3(tile, 0, 0) : Vec3(0, 0, tile),
                                      Vec3(0, 0.7 * tile, 0)));
    }
    return merged(sheets, random);
}

// Many faces of one material, whatever the sheet was made of.
Edit remeshed_floor(Random& random) {
    Edit edit;
    const Sheet floor = random_floor(random, 1);
    add_tiles(floor, edit.before);
    for (int row = 0; row < 2 * floor.rows; ++row) {
        for (int column = 0; column < 2 * floor.columns; ++column) {
            edit.after.push_back(floor.face(0.5 * column, 0.5 * row, 0.5 * (column + 1), 0.5 * (row + 1)));
            edit.after.back().painted =
                floor.tiles[static_cast<std::size_t>(row / 2 * floor.columns + column / 2)].painted;
        }
    }
    return edit;
}

// Of the object hardly a face is left; of its copy elsewhere all are.
Edit merged_beside_its_copy(Random& random) {
    const Sheet hill = random_hill(random, 1);
    Sheet copy = hill;
    copy.origin += Vec3(between(random, 20, 40), 0, between(random, -40, 40));
    for (Face& tile : copy.tiles)
        tile.painted = static_cast<int>(random() % 6) - 1;
    Edit edit = turned(merged({hill}, random), random);
    Faces kept;
    add_tiles(copy, kept);
    for (Face& face : kept)
        face.object = "copy";
    edit.before.insert(edit.before.end(), kept.begin(), kept.end());
    edit.after.insert(edit.after.end(), kept.begin(), kept.end());
    return edit;
}

TEST(Area, WhatAnEditMadeOfOtherFacesIsNeverWrongInSilence) {
    const auto size = [](Random& random) { return between(random, 0.5, 3); };
    const std::vector<std::function<Edit(Random&)>> kinds{
        [&](Random& random) { return turned(merged({random_floor(random, size(random))}, random), random); },
        [&](Random& random) { return turned(merged({random_hill(random, size(random))}, random), random); },
        [&](Random& random) { return merged({random_hill(random, size(random))}, random); },
        [](Random& random) { return turned(merged_level(random), random); },
        merged_level,
        remeshed_floor,
        merged_beside_its_copy};
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        for (unsigned seed = 0; seed < 20; ++seed) {
            Random random(seed);
            const Edit edit = kinds[kind](random);
            const LoadedLevel loaded = rematch(edit.before, edit.after);
            for (std::size_t i = 0; i < edit.after.size(); ++i) {
                const auto& type = loaded.level.overrides.at(i);
                const bool guess = std::binary_search(loaded.level.guessed.begin(),
                                                      loaded.level.guessed.end(), static_cast<FaceId>(i));
                EXPECT_TRUE(edit.after[i].painted == -2 || !type || int{*type} == edit.after[i].painted ||
                            guess)
                    << "kind " << kind << ", seed " << seed << ", face " << i;
            }
        }
    }
}

}  // namespace
}  // namespace slipface::test

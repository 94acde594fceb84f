// The walk of npm/test/bits.test.js, step for step: WebAssembly in node has the hashes of this processor,
// which npm/test/hashes.json has.

#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "mover/calls.h"

namespace slipface {
namespace {

using calls::Dice;

void add_quad(std::vector<float>& positions, std::vector<std::uint32_t>& indices,
              const float (&corners)[12]) {
    const auto first = static_cast<std::uint32_t>(positions.size() / 3);
    positions.insert(positions.end(), corners, corners + 12);
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U})
        indices.push_back(first + i);
}

std::uint64_t walk(const char* preset) {
    Dice random{11};
    std::vector<float> positions, plate;
    std::vector<std::uint32_t> indices, plate_indices;
    std::vector<std::uint8_t> types;
    for (int i = 0; i < 49; ++i) {
        const auto x = static_cast<float>(3 * (i % 7) - 10), z = static_cast<float>(3 * (i / 7) - 10);
        float y[4];
        for (float& one : y)
            one = static_cast<float>(random.between(-0.6, 0.6));
        add_quad(positions, indices, {x, y[0], z, x, y[1], z + 3, x + 3, y[2], z + 3, x + 3, y[3], z});
        types.insert(types.end(), 2, static_cast<std::uint8_t>(random.below(8)));
    }
    add_quad(positions, indices, {-40, -1, -40, -40, -1, 40, 40, -1, 40, 40, -1, -40});
    types.insert(types.end(), 2, 0);
    add_quad(plate, plate_indices, {-2, 0, -2, -2, 0, 2, 2, 0, 2, 2, 0, -2});
    const slipface_triangles yard{sizeof yard,    positions.data(),   positions.size() / 3,
                                  indices.data(), indices.size() / 3, types.data(),
                                  nullptr};
    const slipface_triangles lift_shape{sizeof yard, plate.data(), 4,      plate_indices.data(),
                                        2,           nullptr,      nullptr};
    slipface_world world{};
    slipface_settings settings{};
    std::uint32_t lift = 0;
    EXPECT_EQ(slipface_world_from_triangles(&yard, &world, nullptr), SLIPFACE_OK);
    EXPECT_EQ(slipface_world_add_platform(world, &lift_shape, &lift, nullptr), SLIPFACE_OK);
    EXPECT_EQ(slipface_settings_new(preset, &settings, nullptr), SLIPFACE_OK);
    constexpr std::size_t count = 8;
    const std::vector<slipface_settings> each(count, settings);
    std::vector<slipface_player> players(count);
    for (slipface_player& player : players) {
        const double x = random.between(-6, 6), z = random.between(-6, 6);
        EXPECT_EQ(slipface_player_at(world, {x, 2, z}, &player, nullptr), SLIPFACE_OK);
    }
    std::vector<slipface_input> inputs(count);
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (int tick = 0; tick < 240; ++tick) {
        for (slipface_input& input : inputs) {
            if (tick % 10 != 0) continue;
            const double x = random.between(-1, 1), z = random.between(-1, 1);
            input = {sizeof input, random.below(3) == 0 ? std::uint32_t{SLIPFACE_JUMP} : 0U, x, z};
        }
        const double rotation[4] = {0, 0.01 * tick, 0, 1};
        EXPECT_EQ(slipface_world_move_platform(world, lift, {0.03 * tick - 3, 0.01 * tick, 0}, rotation,
                                               1.0 / 60, nullptr),
                  SLIPFACE_OK);
        EXPECT_EQ(slipface_step_crowd(world, each.data(), players.data(), inputs.data(), count, 1.0 / 60,
                                      nullptr, nullptr, nullptr),
                  SLIPFACE_OK);
        for (const slipface_player& player : players) {
            unsigned char bytes[sizeof player];
            std::memcpy(bytes, &player, sizeof player);
            for (const unsigned char byte : bytes)
                hash = (hash ^ byte) * 0x100000001b3ULL;
        }
    }
    EXPECT_EQ(slipface_world_free(world, nullptr), SLIPFACE_OK);
    EXPECT_EQ(slipface_settings_free(settings, nullptr), SLIPFACE_OK);
    return hash;
}

}  // namespace

TEST(NpmBits, AreTheHashesOfThePackagesTest) {
    std::ifstream file(SLIPFACE_SOURCE_DIR "/npm/test/hashes.json");
    const std::string kept((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::string found = "{\n";
    for (const char* preset : {"platformer", "lecture", "precise-platformer", "momentum", "simulation"}) {
        char line[100];
        (void)std::snprintf(line, sizeof line, "    \"%s\": \"%016llx\"%s\n", preset,
                            static_cast<unsigned long long>(walk(preset)),
                            std::strcmp(preset, "simulation") == 0 ? "" : ",");
        found += line;
    }
    EXPECT_EQ(found + "}\n", kept);
}

}  // namespace slipface

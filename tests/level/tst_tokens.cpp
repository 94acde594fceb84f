// The tokens of all faces in a level file: their size, and files in which they are damaged.
#include "level/faces.h"

namespace slipface::test::tokens {
namespace {

Faces painted_tiles() {
    Faces faces = tiles(20);
    for (std::size_t i = 0; i < faces.size(); ++i)
        faces[i].painted = i % 3 == 0 ? static_cast<int>(i % 5) : -1;
    return faces;
}

// The text between the quotes of the first row of tokens.
std::pair<std::size_t, std::size_t> first_row(const std::string& text) {
    const std::size_t rows = text.find("\"rows\"", text.find("\"tokens\"")),
                      begin = text.find('"', text.find('[', rows)) + 1;
    return {begin, text.find('"', begin) - begin};
}

TEST(Tokens, TakeEightBytesPerFace) {
    const Faces faces = painted_tiles();
    const std::string text = level_to_json(level_of(faces));
    const std::size_t begin = text.find("\"rows\"", text.find("\"tokens\"")), end = text.find(']', begin);
    std::size_t characters = 0;
    for (std::size_t at = begin; at < end; ++at)
        characters +=
            std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '+' || text[at] == '/' ? 1
                                                                                                          : 0;
    // Three bytes are four characters; a row is at most two longer.
    EXPECT_LE(characters, 8 * faces.size() * 4 / 3 + 100);
    EXPECT_GE(characters, 8 * faces.size() * 4 / 3);
}

// The objects of a level take several rows. Each of these floors is where the next one was.
TEST(Tokens, OfAHundredObjectsAreRead) {
    Faces faces;
    for (int i = 0; i < 100; ++i)
        for (Face tile : tiles(2)) {
            for (Vec3f& corner : tile.corners)
                corner.y() += static_cast<float>(i);
            tile.object = "floor" + std::to_string(i);
            tile.painted = i % 3 == 0 ? static_cast<int>(i % 5) : -1;
            faces.push_back(tile);
        }
    Faces after = faces;
    for (Face& tile : after)
        for (Vec3f& corner : tile.corners)
            corner.y() += 1.0f;
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty()) << loaded.match.text();
}

TEST(Tokens, DamagedOnesAreAnErrorOrIgnored) {
    const Faces faces = painted_tiles();
    const std::string text = level_to_json(level_of(faces));
    const auto [begin, length] = first_row(text);
    const auto load = [&](const std::string& damaged) {
        return level_from_json(damaged, "test.slipface.json", mesh_of(faces));
    };
    std::string shorter = text;
    shorter.erase(begin, 32);  // three tokens fewer than the objects have faces
    const Result<LoadedLevel> missing = load(shorter);
    ASSERT_TRUE(missing) << missing.error().text();
    EXPECT_EQ(missing->match.exact, painted_count(faces)) << "found as in an older file";
    std::string no_base64 = text;
    no_base64[begin] = '!';
    EXPECT_FALSE(load(no_base64));
    // Other bits are other faces: they may change what is found, and nothing else.
    std::uint64_t state = 7;
    for (int i = 0; i < 200; ++i) {
        std::string changed = text;
        for (int k = 0; k < 5; ++k) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
            changed[begin + (state >> 33) % length] = letters[(state >> 20) % 64];
        }
        const Result<LoadedLevel> loaded = load(changed);
        EXPECT_TRUE(!loaded || loaded->level.overrides.size() == faces.size());
    }
}

}  // namespace
}  // namespace slipface::test::tokens

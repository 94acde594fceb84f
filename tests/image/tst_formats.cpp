// Pictures in formats other than PNG.
#include <gmock/gmock.h>
#include <webp/encode.h>

#include <algorithm>
#include <memory>
#include <random>

#include "slipface/image/image.h"

namespace slipface {
namespace {

using namespace std::string_view_literals;
using testing::HasSubstr;

Image speckled(int width, int height, std::uint32_t seed) {
    Image image = make_image(width, height, 0, 0, 0);
    std::mt19937 random(seed);
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        image.rgba[i] = static_cast<std::uint8_t>(random() >> (i % 4 == 3 ? 1 : 4));
    return image;
}

std::string webp(const Image& image) {
    std::uint8_t* bytes = nullptr;
    const std::size_t size =
        WebPEncodeLosslessRGBA(image.rgba.data(), image.width, image.height, 4 * image.width, &bytes);
    const std::unique_ptr<std::uint8_t, void (*)(void*)> held(bytes, WebPFree);
    return {reinterpret_cast<const char*>(bytes), size};
}

// A GIF of one colour per pixel of two, in codes of three bits that clear the table after every pixel.
std::string gif(int width, int height, const std::vector<bool>& pixels) {
    std::string bytes = "GIF89a";
    const auto put16 = [&](int value) {
        bytes += static_cast<char>(value & 255);
        bytes += static_cast<char>(value >> 8);
    };
    put16(width);
    put16(height);
    bytes += "\x80\0\0"sv;
    bytes += "\x0A\x14\x1E\xC8\xD2\xDC"sv;  // two colours
    bytes += ","sv;
    put16(0);
    put16(0);
    put16(width);
    put16(height);
    bytes += "\0\x02"sv;
    std::string data;
    unsigned held = 0, bits = 0;
    const auto code = [&](unsigned value) {
        held |= value << bits;
        for (bits += 3; bits >= 8; bits -= 8) {
            data += static_cast<char>(held & 255);
            held >>= 8;
        }
    };
    for (const bool pixel : pixels) {
        code(4);
        code(pixel ? 1 : 0);
    }
    code(5);
    data += static_cast<char>(held & 255);
    for (std::size_t at = 0; at < data.size(); at += 255) {
        const std::string block = data.substr(at, 255);
        bytes += static_cast<char>(block.size());
        bytes += block;
    }
    return bytes + std::string("\0;", 2);
}

TEST(Formats, WebpGivesItsPixels) {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        Image image =
            speckled(static_cast<int>(seed * 7 % 40 + 1), static_cast<int>(seed * 13 % 30 + 1), seed);
        // Where nothing shows, the encoder may forget the colour.
        for (std::size_t i = 0; i < image.pixel_count(); ++i)
            image.rgba[4 * i + 3] |= 1;
        const std::string bytes = webp(image);
        const Result<Image> read = decode_image(bytes, "a.webp");
        ASSERT_TRUE(read) << read.error().text();
        EXPECT_EQ(*read, image);
        EXPECT_TRUE(check_image_header(bytes, "a.webp"));
        EXPECT_THAT(decode_image(bytes, "a.webp", std::max(image.width, image.height) - 1).error().message,
                    HasSubstr("at most"));
    }
}

TEST(Formats, DamagedWebpIsRefused) {
    std::mt19937 random(3);
    const std::string whole = webp(speckled(30, 20, 5));
    for (std::size_t size = 0; size < whole.size() - 2; size += 5)
        EXPECT_FALSE(decode_image(std::string_view(whole).substr(0, size), "cut.webp")) << size;
    for (int i = 0; i < 2000; ++i) {
        std::string bytes = whole;
        bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
        if (const Result<Image> read = decode_image(bytes, "bits.webp", 64)) {
            EXPECT_EQ(read->rgba.size(), 4 * read->pixel_count());
        }
    }
}

TEST(Formats, GifGivesItsFirstPicture) {
    std::mt19937 random(4);
    for (int round = 0; round < 20; ++round) {
        const int width = static_cast<int>(random() % 20) + 1, height = static_cast<int>(random() % 20) + 1;
        std::vector<bool> pixels(static_cast<std::size_t>(width * height));
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = random() % 2 == 0;
        const std::string bytes = gif(width, height, pixels);
        const Result<Image> read = decode_image(bytes, "a.gif");
        ASSERT_TRUE(read) << read.error().text();
        ASSERT_EQ(read->width, width);
        ASSERT_EQ(read->height, height);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            ASSERT_EQ(read->rgba[4 * i], pixels[i] ? 0xC8 : 0x0A) << i;
        for (int damage = 0; damage < 200; ++damage) {
            std::string bad = bytes;
            bad[random() % bad.size()] = static_cast<char>(random());
            static_cast<void>(decode_image(bad, "bad.gif", 64));
        }
    }
}

TEST(Formats, OthersAreNamedWithTheRemedy) {
    const std::pair<std::string_view, std::string_view> heads[] = {{"TIFF", "II*\0\x08\0\0\0"sv},
                                                                   {"TIFF", "MM\0*\0\0\0\x08"sv},
                                                                   {"SGI", "\x01\xDA\0\1\0\3\0\4\0\4\0\3"sv},
                                                                   {"DDS", "DDS \x7C\0\0\0"sv},
                                                                   {"KTX", "\xABKTX 20\xBB"sv},
                                                                   {"AVIF", "\0\0\0\x1C\x66typavif"sv}};
    for (const auto& [name, head] : heads) {
        std::string bytes(head);
        bytes.resize(200);
        const Result<Image> read = decode_image(bytes, "a.picture");
        ASSERT_FALSE(read) << name;
        EXPECT_THAT(read.error().message, HasSubstr("is a " + std::string(name) + " image"));
        EXPECT_THAT(read.error().message, HasSubstr("save it as PNG"));
        EXPECT_EQ(check_image_header(bytes, "a.picture").error().message, read.error().message);
    }
    EXPECT_THAT(decode_image("no picture at all", "a").error().message, HasSubstr("WebP"));
}

}  // namespace
}  // namespace slipface

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <random>

#include "scratch_folder.h"
#include "slipface/base/files.h"
#include "slipface/image/image.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

using Png = test::InScratchFolder;

Image noise(int width, int height) {
    Image image = make_image(width, height, 0, 0, 0);
    std::mt19937 random(5);
    for (std::uint8_t& byte : image.rgba)
        byte = static_cast<std::uint8_t>(random());
    return image;
}

long peak_kilobytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

std::uint32_t crc32(std::string_view bytes) {
    std::uint32_t crc = ~0U;
    for (const char byte : bytes) {
        crc ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320U : 0U);
    }
    return ~crc;
}

std::string big_endian(std::uint32_t value) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8)
        text.push_back(static_cast<char>(value >> shift & 255));
    return text;
}

std::string chunk(const std::string& type, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc32(type + data));
}

std::string png(std::uint32_t width, std::uint32_t height, const std::string& data) {
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", big_endian(width) + big_endian(height) + std::string("\x08\x06\0\0\0", 5)) +
           chunk("IDAT", data) + chunk("IEND", "");
}

TEST(MakeImage, FillsWithOneColor) {
    const Image image = make_image(3, 2, 1, 2, 3, 4);
    ASSERT_EQ(image.rgba.size(), 24U);
    EXPECT_EQ(image.pixel(2, 1)[3], 4);
    EXPECT_TRUE(make_image(-1, 5, 0, 0, 0).rgba.empty());
}

TEST_F(Png, RoundTripIsLossless) {
    const Image image = noise(37, 21);
    ASSERT_TRUE(save_png(folder / "a.png", image));
    const auto back = load_image(folder / "a.png");
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_EQ(*back, image);
}

TEST_F(Png, TheSamePictureGivesTheSameBytes) {
    ASSERT_TRUE(save_png(folder / "a.png", noise(200, 100)));
    ASSERT_TRUE(save_png(folder / "b.png", noise(200, 100)));
    EXPECT_EQ(*read_file(folder / "a.png"), *read_file(folder / "b.png"));
}

TEST_F(Png, PicturesThatAreNoneAreNotWritten) {
    EXPECT_FALSE(save_png(folder / "a.png", Image{}));
    EXPECT_FALSE(save_png(folder / "a.png", Image{.width = 2, .height = 2, .rgba = {0, 0}}));
    EXPECT_FALSE(save_png(folder / "a.png", Image{.width = -1, .height = -1, .rgba = {0, 0, 0, 0}}));
    EXPECT_FALSE(save_png(folder / "no-folder" / "a.png", noise(2, 2)));
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(Png, BadFilesAreRefusedWithTheReason) {
    const auto missing = load_image(folder / "no.png");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().location, (folder / "no.png").string());

    EXPECT_FALSE(load_image(folder));
    for (const std::string_view junk :
         {"", "hello", "P6 1 1 255 abc", "GIF89a\1\1\1\1\0\0\0", "\x89PNG\r\n\x1a\n"}) {
        const auto result = decode_image(junk, "x.png");
        ASSERT_FALSE(result) << junk;
        EXPECT_EQ(result.error().location, "x.png");
    }
}

// A hundred thousand pixels square would be 40 GB; the refusal must come before any of them is reserved.
TEST_F(Png, AHugeHeaderIsRefusedWithoutMemory) {
    const long before = peak_kilobytes();
    const auto result = decode_image(png(100'000, 100'000, "x"), "bomb.png");
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("100000 x 100000"));
    EXPECT_LT(peak_kilobytes() - before, 10'000);

    const auto wide = decode_image(png(8193, 1, "x"), "wide.png");
    ASSERT_FALSE(wide);
    EXPECT_THAT(wide.error().message, HasSubstr("at most 8192"));
    EXPECT_FALSE(decode_image(png(0, 1, "x"), "flat.png"));
}

// Deflate code for a run of zeros as long as wanted, about a thousandth of its size: a literal 0, then
// matches of length 258 at distance 1. In the fixed code of RFC 1951 the literal 0 is 00110000, length 258 is
// 11000101 and distance 1 is 00000.
std::string zlib_zeros(std::size_t matches) {
    std::string data = "\x78\x01";
    unsigned bits = 0;
    int count = 0;
    const auto put = [&](const char* text) {
        for (; *text != 0; ++text) {
            bits |= (*text == '1' ? 1U : 0U) << count;
            if (++count == 8) {
                data.push_back(static_cast<char>(bits));
                bits = 0;
                count = 0;
            }
        }
    };
    put("110");  // last block, fixed code
    put("00110000");
    for (std::size_t i = 0; i < matches; ++i)
        put("1100010100000");
    put("0000000");
    put("0000000");
    return data + std::string(8, '\0');
}

TEST_F(Png, DataThatUnpackToFarMoreThanTheHeaderPromisesAreRefused) {
    // 4 million matches: 6.5 MB of file for 1 GB of zeros, in a picture of one pixel.
    const std::string bomb = png(1, 1, zlib_zeros(4'000'000));
    const long before = peak_kilobytes();
    const auto result = decode_image(bomb, "bomb.png");
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("do not fit"));
    EXPECT_LT(peak_kilobytes() - before, 100'000);
}

TEST_F(Png, AChunkThatSaysItIsLongerThanTheFileIsRefusedWithoutMemory) {
    std::string long_chunk = png(1, 1, zlib_zeros(1));
    long_chunk.replace(long_chunk.find("IDAT") - 4, 4, big_endian(0x60000000U));
    const long before = peak_kilobytes();
    const auto result = decode_image(long_chunk, "long.png");
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("do not fit"));
    EXPECT_LT(peak_kilobytes() - before, 100'000);
}

TEST_F(Png, BigPicturesPassTheSameCheck) {
    const Image image = noise(600, 400);  // noise does not pack: nearly a megabyte of data
    ASSERT_TRUE(save_png(folder / "a.png", image));
    ASSERT_GT(fs::file_size(folder / "a.png"), 900'000U);
    EXPECT_EQ(*load_image(folder / "a.png"), image);
}

TEST_F(Png, TruncatedFilesAreRefusedAtEveryLength) {
    ASSERT_TRUE(save_png(folder / "a.png", noise(9, 9)));
    const std::string whole = *read_file(folder / "a.png");
    // Without IEND, its length and checksum (the last 12 bytes) a decoder may still have every pixel.
    for (std::size_t size = 0; size + 12 < whole.size(); ++size) {
        EXPECT_FALSE(decode_image(std::string_view(whole).substr(0, size), "cut.png")) << size;
    }
}

TEST_F(Png, FlippedBitsNeverCrash) {
    ASSERT_TRUE(save_png(folder / "a.png", noise(16, 16)));
    const std::string whole = *read_file(folder / "a.png");
    std::mt19937 random(11);
    for (int i = 0; i < 3000; ++i) {
        std::string bytes = whole;
        bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
        const auto result = decode_image(bytes, "bits.png", 64);
        if (result) {
            EXPECT_EQ(result->rgba.size(), 4 * result->pixel_count());
        }
    }
}

TEST_F(Png, ReadsBmp) {
    // 1 x 1, 24 bit, blue green red = 10 20 30.
    const std::string bmp(
        "BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\1\0\0\0\1\0\x18\0\0\0\0\0\4\0\0\0"
        "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x0a\x14\x1e\0",
        58);
    const auto result = decode_image(bmp, "x.bmp");
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_EQ(result->rgba, (std::vector<std::uint8_t>{30, 20, 10, 255}));
}

// Every filter, both pixel sizes and both efforts give the picture back; transparency decides the pixel's
// size.
TEST_F(Png, BothEffortsAreLossless) {
    Image slopes = make_image(67, 41, 0, 0, 0);
    for (int y = 0; y < slopes.height; ++y) {
        for (int x = 0; x < slopes.width; ++x) {
            slopes.pixel(x, y)[0] = static_cast<std::uint8_t>(3 * x);
            slopes.pixel(x, y)[1] = static_cast<std::uint8_t>(5 * y + (x > 30 ? 90 : 0));
            slopes.pixel(x, y)[2] = static_cast<std::uint8_t>(x * y);
        }
    }
    Image clear = slopes;
    clear.pixel(5, 5)[3] = 0;
    for (const Image& image : {slopes, clear, noise(37, 21), make_image(1, 1, 1, 2, 3)}) {
        const auto fast = encode_png(image), small = encode_png(image, PngEffort::small);
        ASSERT_TRUE(fast.ok() && small.ok());
        EXPECT_LE(small->size(), fast->size() + 8);  // tiny pictures hardly differ
        EXPECT_EQ(*decode_image(*fast, "fast"), image);
        EXPECT_EQ(*decode_image(*small, "small"), image);
    }
    EXPECT_EQ((*encode_png(slopes))[25], 2);
    EXPECT_EQ((*encode_png(clear))[25], 6);
    EXPECT_FALSE(encode_png(Image{}).ok());
}

// The quick reader gives up where it is not sure, and the general one judges: a picture in pieces is read, a
// transparent colour too, a cut-off file is refused.
TEST_F(Png, QuickReaderLeavesTheRestToTheGeneralOne) {
    const Image image = noise(40, 30);
    const std::string whole = *encode_png(image);
    const std::size_t data = whole.find("IDAT") + 4;
    const std::size_t length = whole.size() - data - 16;
    const std::string packed = whole.substr(data, length);
    const std::string pieces = whole.substr(0, data - 8) + chunk("IDAT", packed.substr(0, 7)) +
                               chunk("IDAT", packed.substr(7, 100)) + chunk("IDAT", packed.substr(107)) +
                               chunk("IEND", "");
    EXPECT_EQ(*decode_image(pieces, "pieces"), image);
    const Image plain = make_image(20, 20, 9, 8, 7);
    std::string keyed = *encode_png(plain);
    keyed.insert(keyed.find("IDAT") - 4, chunk("tRNS", std::string("\0\x09\0\x08\0\x07", 6)));
    EXPECT_EQ(decode_image(keyed, "keyed")->pixel(3, 3)[3], 0);
    for (std::size_t cut = 20; cut < whole.size() - 30; cut += 97)
        EXPECT_FALSE(decode_image(whole.substr(0, cut), "cut").ok()) << cut;
}

}  // namespace
}  // namespace slipface

#include <libdeflate.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

extern "C" unsigned char* stbi_zlib_compress(unsigned char* data, int size, int* packed_size, int quality);

struct libdeflate_compressor {
    int quality;
};
struct libdeflate_decompressor {};

libdeflate_compressor* libdeflate_alloc_compressor(int level) {
    return new libdeflate_compressor{5 + level};
}
void libdeflate_free_compressor(libdeflate_compressor* compressor) {
    delete compressor;
}
size_t libdeflate_zlib_compress_bound(libdeflate_compressor*, size_t size) {
    return size + size / 8 + 64;  // stb's codes have at most nine bits per byte
}
size_t libdeflate_zlib_compress(libdeflate_compressor* compressor, const void* in, size_t in_size, void* out,
                                size_t room) {
    int size = 0;
    unsigned char* const packed =
        stbi_zlib_compress(const_cast<unsigned char*>(static_cast<const unsigned char*>(in)),
                           static_cast<int>(in_size), &size, compressor->quality);
    const size_t used =
        packed != nullptr && static_cast<size_t>(size) <= room ? static_cast<size_t>(size) : 0;
    if (used > 0) std::memcpy(out, packed, used);
    std::free(packed);
    return used;
}

libdeflate_decompressor* libdeflate_alloc_decompressor() {
    return new libdeflate_decompressor;
}
void libdeflate_free_decompressor(libdeflate_decompressor* decompressor) {
    delete decompressor;
}

namespace {

uint32_t adler32(const unsigned char* bytes, size_t size) {
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size; ++i) {
        a = (a + bytes[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

}  // namespace

// stb does not compare the checksum at the end.
libdeflate_result libdeflate_zlib_decompress(libdeflate_decompressor*, const void* in, size_t in_size,
                                             void* out, size_t room, size_t* size) {
    if (in_size < 6) return LIBDEFLATE_BAD_DATA;
    const int found = stbi_zlib_decode_buffer(static_cast<char*>(out), static_cast<int>(room),
                                              static_cast<const char*>(in), static_cast<int>(in_size));
    if (found < 0) return LIBDEFLATE_BAD_DATA;
    const auto* const end = static_cast<const unsigned char*>(in) + in_size - 4;
    const uint32_t stored = static_cast<uint32_t>(end[0]) << 24 | static_cast<uint32_t>(end[1]) << 16 |
                            static_cast<uint32_t>(end[2]) << 8 | end[3];
    if (stored != adler32(static_cast<const unsigned char*>(out), static_cast<size_t>(found)))
        return LIBDEFLATE_BAD_DATA;
    *size = static_cast<size_t>(found);
    return LIBDEFLATE_SUCCESS;
}

uint32_t libdeflate_crc32(uint32_t crc, const void* bytes, size_t size) {
    static const std::array<uint32_t, 256> table = [] {
        std::array<uint32_t, 256> made{};
        for (uint32_t i = 0; i < 256; ++i) {
            made[i] = i;
            for (int bit = 0; bit < 8; ++bit)
                made[i] = (made[i] & 1U) != 0 ? 0xedb88320U ^ (made[i] >> 1) : made[i] >> 1;
        }
        return made;
    }();
    crc = ~crc;
    for (size_t i = 0; i < size; ++i)
        crc = table[(crc ^ static_cast<const unsigned char*>(bytes)[i]) & 0xffU] ^ (crc >> 8);
    return ~crc;
}

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

namespace {

// What gzip (RFC 1952) has around the data that zlib has, too; no name and no other optional field.
constexpr std::array<unsigned char, 10> gzip_head{0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 255};
constexpr size_t gzip_end = 8, zlib_head = 2, zlib_end = 4;

void put_le(unsigned char* out, uint32_t value) {
    for (int i = 0; i < 4; ++i)
        out[i] = static_cast<unsigned char>(value >> (8 * i));
}
uint32_t get_le(const unsigned char* in) {
    uint32_t value = 0;
    for (int i = 4; i-- > 0;)
        value = value << 8 | in[i];
    return value;
}

}  // namespace

size_t libdeflate_gzip_compress_bound(libdeflate_compressor* compressor, size_t size) {
    return libdeflate_zlib_compress_bound(compressor, size) + gzip_head.size() + gzip_end;
}

size_t libdeflate_gzip_compress(libdeflate_compressor* compressor, const void* in, size_t in_size, void* out,
                                size_t room) {
    auto* const bytes = static_cast<unsigned char*>(out);
    const size_t before = gzip_head.size() - zlib_head;
    if (room < before) return 0;
    const size_t packed = libdeflate_zlib_compress(compressor, in, in_size, bytes + before, room - before);
    if (packed < zlib_head + zlib_end || before + packed - zlib_end + gzip_end > room) return 0;
    std::memcpy(bytes, gzip_head.data(), gzip_head.size());
    unsigned char* const end = bytes + before + packed - zlib_end;
    put_le(end, libdeflate_crc32(0, in, in_size));
    put_le(end + 4, static_cast<uint32_t>(in_size));
    return before + packed - zlib_end + gzip_end;
}

libdeflate_result libdeflate_gzip_decompress(libdeflate_decompressor*, const void* in, size_t in_size,
                                             void* out, size_t room, size_t* size) {
    const auto* const bytes = static_cast<const unsigned char*>(in);
    if (in_size < gzip_head.size() + gzip_end || bytes[0] != 0x1f || bytes[1] != 0x8b || bytes[2] != 8)
        return LIBDEFLATE_BAD_DATA;
    const unsigned char flags = bytes[3];
    const size_t last = in_size - gzip_end;
    size_t at = gzip_head.size();
    if ((flags & 4U) != 0 && at + 2 <= last) at += 2 + bytes[at] + 256U * bytes[at + 1];
    for (const unsigned text : {8U, 16U})  // a name, a comment: each ends with 0
        if ((flags & text) != 0) {
            while (at < last && bytes[at] != 0)
                ++at;
            ++at;
        }
    if ((flags & 2U) != 0) at += 2;
    if (at >= last) return LIBDEFLATE_BAD_DATA;
    const int found =
        stbi_zlib_decode_noheader_buffer(static_cast<char*>(out), static_cast<int>(room),
                                         static_cast<const char*>(in) + at, static_cast<int>(in_size - at));
    if (found < 0 || get_le(bytes + last + 4) != static_cast<uint32_t>(found) ||
        get_le(bytes + last) != libdeflate_crc32(0, out, static_cast<size_t>(found)))
        return LIBDEFLATE_BAD_DATA;
    *size = static_cast<size_t>(found);
    return LIBDEFLATE_SUCCESS;
}

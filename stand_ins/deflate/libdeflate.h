// The functions of libdeflate that the project calls, over stb (web/deflate.cpp).
#pragma once
#include <stddef.h>
#include <stdint.h>

struct libdeflate_compressor;
struct libdeflate_decompressor;
enum libdeflate_result { LIBDEFLATE_SUCCESS, LIBDEFLATE_BAD_DATA };

libdeflate_compressor* libdeflate_alloc_compressor(int level);
void libdeflate_free_compressor(libdeflate_compressor*);
size_t libdeflate_zlib_compress_bound(libdeflate_compressor*, size_t size);
size_t libdeflate_zlib_compress(libdeflate_compressor*, const void* in, size_t in_size, void* out,
                                size_t room);
libdeflate_decompressor* libdeflate_alloc_decompressor();
void libdeflate_free_decompressor(libdeflate_decompressor*);
libdeflate_result libdeflate_zlib_decompress(libdeflate_decompressor*, const void* in, size_t in_size,
                                             void* out, size_t room, size_t* size);
size_t libdeflate_gzip_compress_bound(libdeflate_compressor*, size_t size);
size_t libdeflate_gzip_compress(libdeflate_compressor*, const void* in, size_t in_size, void* out,
                                size_t room);
libdeflate_result libdeflate_gzip_decompress(libdeflate_decompressor*, const void* in, size_t in_size,
                                             void* out, size_t room, size_t* size);
uint32_t libdeflate_crc32(uint32_t crc, const void* bytes, size_t size);

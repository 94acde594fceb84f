#include "slipface/image/pack.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <new>

namespace slipface {

namespace {

using Compressor = std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)>;
using Decompressor = std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>;

constexpr std::size_t max_from_one_byte = 1032;  // deflate's largest ratio

}  // namespace

std::string pack(std::string_view bytes, int effort) {
    const Compressor compressor(libdeflate_alloc_compressor(std::clamp(effort, pack_fast, pack_smallest)),
                                libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    std::string packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
    packed.resize(
        libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
    return packed;
}

std::optional<std::string> unpack(std::string_view packed, std::size_t size) {
    if (size / max_from_one_byte > packed.size()) return std::nullopt;
    static thread_local const Decompressor decompressor(libdeflate_alloc_decompressor(),
                                                        libdeflate_free_decompressor);
    if (!decompressor) throw std::bad_alloc();
    std::string bytes(size, '\0');
    std::size_t found = 0;
    const libdeflate_result result = libdeflate_zlib_decompress(
        decompressor.get(), packed.data(), packed.size(), bytes.data(), bytes.size(), &found);
    if (result != LIBDEFLATE_SUCCESS || found != size) return std::nullopt;
    return bytes;
}

}  // namespace slipface

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

// One of libdeflate's functions for a wrapper.
template <class Bound, class Compress>
std::string packed_by(Bound bound, Compress compress, std::string_view bytes, int effort) {
    const Compressor compressor(libdeflate_alloc_compressor(std::clamp(effort, pack_fast, pack_smallest)),
                                libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    std::string packed(bound(compressor.get(), bytes.size()), '\0');
    packed.resize(compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
    return packed;
}

template <class Decompress>
std::optional<std::string> unpacked_by(Decompress decompress, std::string_view packed, std::size_t size) {
    if (size / max_from_one_byte > packed.size()) return std::nullopt;
    static thread_local const Decompressor decompressor(libdeflate_alloc_decompressor(),
                                                        libdeflate_free_decompressor);
    if (!decompressor) throw std::bad_alloc();
    std::string bytes(size, '\0');
    std::size_t found = 0;
    const libdeflate_result result =
        decompress(decompressor.get(), packed.data(), packed.size(), bytes.data(), bytes.size(), &found);
    if (result != LIBDEFLATE_SUCCESS || found != size) return std::nullopt;
    return bytes;
}

}  // namespace

std::string pack(std::string_view bytes, int effort) {
    return packed_by(libdeflate_zlib_compress_bound, libdeflate_zlib_compress, bytes, effort);
}

std::optional<std::string> unpack(std::string_view packed, std::size_t size) {
    return unpacked_by(libdeflate_zlib_decompress, packed, size);
}

std::string pack_gzip(std::string_view bytes) {
    return packed_by(libdeflate_gzip_compress_bound, libdeflate_gzip_compress, bytes, pack_usual);
}

std::optional<std::string> unpack_gzip(std::string_view packed, std::size_t most) {
    // The last four bytes are the size, the lowest first.
    if (packed.size() < 18) return std::nullopt;
    std::size_t size = 0;
    for (std::size_t i = packed.size(); i-- > packed.size() - 4;)
        size = size << 8 | static_cast<unsigned char>(packed[i]);
    if (size > most) return std::nullopt;
    return unpacked_by(libdeflate_gzip_decompress, packed, size);
}

}  // namespace slipface

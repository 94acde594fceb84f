#include "document/level_base.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "slipface/base/files.h"
#include "slipface/base/hash.h"

namespace slipface {

std::uint64_t content_of(std::string_view json) {
    std::string words;
    words.reserve(json.size());
    bool quoted = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (!quoted && (c == ' ' || c == '\n' || c == '\r' || c == '\t')) continue;
        words += c;
        if (c == '"') quoted = !quoted;
        if (quoted && c == '\\' && i + 1 < json.size()) words += json[++i];
    }
    Hasher hasher;
    hasher.text(words);
    return std::max<std::uint64_t>(1, hasher.value());
}

LevelBase level_base(std::optional<std::string> text) {
    if (!text) return {};
    const std::uint64_t content = content_of(*text);
    return {std::make_shared<const std::string>(std::move(*text)), content};
}

Result<LevelBase> read_level_base(const std::filesystem::path& file) {
    constexpr std::uint64_t max_bytes = std::uint64_t{256} << 20;
    std::error_code error;
    const auto type = std::filesystem::status(file, error).type();
    // The level file of a model whose name is as long as names can be cannot exist.
    if (type == std::filesystem::file_type::not_found || error == std::errc::filename_too_long)
        return LevelBase();
    Result<std::string> text = read_file(file, max_bytes);
    if (!text) return text.error();
    return level_base(std::move(*text));
}

}  // namespace slipface

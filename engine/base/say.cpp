#include "slipface/base/say.h"

namespace slipface {

std::string fill_in(std::string_view text, std::span<const std::string> words) {
    std::string filled;
    for (const std::string& word : words) {
        const std::size_t at = text.find("{}");
        if (at == std::string_view::npos) break;
        filled.append(text.substr(0, at)).append(word);
        text.remove_prefix(at + 2);
    }
    return filled.append(text);
}

}  // namespace slipface

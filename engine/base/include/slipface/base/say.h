// Messages: "found {}, expected {}" with the words filled in, for libraries that depend on nothing.
#pragma once

#include <array>
#include <concepts>
#include <span>
#include <string>
#include <string_view>

#include "slipface/base/text.h"

namespace slipface {

// `text` with each "{}" replaced by the next of `words`; numbers as to_text() writes them.
std::string fill_in(std::string_view text, std::span<const std::string> words);

template <class Word>
std::string as_word(const Word& one) {
    if constexpr (std::floating_point<Word>)
        return to_text(one);
    else if constexpr (std::integral<Word>)
        return std::to_string(one);
    else
        return std::string(std::string_view(one));
}

template <class... Words>
std::string say(std::string_view text, const Words&... words) {
    const std::array<std::string, sizeof...(Words)> all{as_word(words)...};
    return fill_in(text, all);
}

}  // namespace slipface

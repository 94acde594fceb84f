#include "tools/commands/fuzzy.h"

#include <algorithm>

#include "slipface/base/text.h"

namespace slipface {
namespace {

bool begins_word(std::string_view text, std::size_t at) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
    return at == 0 || !letter(text[at - 1]);
}

// Of one word; both in lower case.
std::optional<int> word_score(std::string_view word, std::string_view text) {
    int best = 0;
    for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
        const bool whole =
            begins_word(text, at) && (at + word.size() == text.size() || text[at + word.size()] == ' ');
        best = std::max(best, whole ? 100 : begins_word(text, at) ? 80 : 40);
        if (at == 0) best += 5;
    }
    if (best > 0) return best;
    // Letters in order; fewer gaps score higher. The first letter must begin a word, otherwise nearly
    // everything would match.
    int score = 30;
    std::size_t next = 0;
    for (std::size_t i = 0; i < word.size(); ++i) {
        std::size_t at = text.find(word[i], next);
        while (i == 0 && at != std::string_view::npos && !begins_word(text, at))
            at = text.find(word[i], at + 1);
        if (at == std::string_view::npos) return std::nullopt;
        if (i > 0 && at != next) score -= begins_word(text, at) ? 2 : 8;
        next = at + 1;
    }
    return score > 0 ? std::optional(score) : std::nullopt;
}

}  // namespace

std::optional<int> fuzzy_score(std::string_view query, std::string_view text) {
    const std::string wanted = to_lower(query), here = to_lower(text);
    int total = 0;
    for (const std::string_view word : split(wanted, ' ')) {
        if (word.empty()) continue;
        const std::optional<int> score = word_score(word, here);
        if (!score) return std::nullopt;
        total += *score;
    }
    return total;
}

std::vector<const Command*> find_commands(const Editor& editor, std::string_view query) {
    struct Ranked {
        const Command* command;
        bool disabled;
        int score;
        std::size_t recent;
    };
    std::vector<Ranked> found;
    for (const Command& command : commands()) {
        if (!*command.menu || std::string_view(command.id) == "help.command_palette") continue;
        const std::string name = command_name(editor, command);
        const std::string all = name + " " + command.menu + " " + command.search + " " + command.description;
        const std::optional<int> anywhere = fuzzy_score(query, all);
        if (!anywhere) continue;
        const std::optional<int> in_label = fuzzy_score(query, name);
        const auto recent =
            std::find(editor.recent_commands.begin(), editor.recent_commands.end(), command.id);
        found.push_back({&command, !command.enabled(editor), in_label ? 1000 + *in_label : *anywhere,
                         static_cast<std::size_t>(recent - editor.recent_commands.begin())});
    }
    const bool requested = !trim(query).empty();
    std::stable_sort(found.begin(), found.end(), [&](const Ranked& a, const Ranked& b) {
        if (a.disabled != b.disabled) return b.disabled;
        if (requested && a.score != b.score) return a.score > b.score;
        return a.recent < b.recent;
    });
    std::vector<const Command*> ordered;
    for (const Ranked& one : found)
        ordered.push_back(one.command);
    return ordered;
}

}  // namespace slipface

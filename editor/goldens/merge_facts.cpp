#include "goldens/merge_facts.h"

#include <algorithm>
#include <optional>

#include "goldens/acts.h"

namespace slipface {

namespace {

// Orders, warnings and the like: [["floor"], ["roof"]].
bool is_list_of_names(const Numbers& json) {
    return json.is_array() && std::all_of(json.begin(), json.end(), [](const Numbers& row) {
               return row.is_array() && row.size() == 1;
           });
}

bool has(const Numbers& list, const Numbers& item) {
    return std::find(list.begin(), list.end(), item) != list.end();
}

// Nothing: both sides changed it; `where` is its path. A member that is not there is null.
std::optional<Numbers> merged(const Numbers& base, const Numbers& ours, const Numbers& theirs,
                              std::string& where) {
    if (ours == theirs || theirs == base) return ours;
    if (ours == base) return theirs;
    if (is_list_of_names(base) && is_list_of_names(ours) && is_list_of_names(theirs)) {
        Numbers list = Numbers::array();
        for (const Numbers& name : ours)
            if (has(theirs, name) || !has(base, name)) list.push_back(name);
        for (const Numbers& name : theirs)
            if (!has(base, name) && !has(ours, name)) list.push_back(name);
        return list;
    }
    if (!ours.is_object() || !theirs.is_object()) return std::nullopt;
    Numbers keys = ours, result = Numbers::object();
    keys.update(theirs);
    for (const auto& [key, value] : keys.items()) {
        const std::string outer = where;
        where += "/" + key;
        std::optional<Numbers> member =
            merged(member_of(base, key), member_of(ours, key), member_of(theirs, key), where);
        if (!member) return std::nullopt;
        where = outer;
        if (!member->is_null()) result[key] = *std::move(member);
    }
    return result;
}

}  // namespace

Result<std::string> merge_facts(std::string_view base, std::string_view ours, std::string_view theirs) {
    const auto parsed = [](std::string_view text) { return Numbers::parse(text, nullptr, false); };
    const Numbers mine = parsed(ours), other = parsed(theirs);
    if (!mine.is_object() || !other.is_object()) return Error{"", "is no JSON object on both sides"};
    std::string where;
    const std::optional<Numbers> result = merged(base.empty() ? Numbers() : parsed(base), mine, other, where);
    if (!result) return Error{where, "both sides changed it"};
    return numbers_text(*result);
}

}  // namespace slipface

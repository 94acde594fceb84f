// Files among the goldens that belong to no snapshot.
#include <algorithm>
#include <set>

#include "goldens/golden.h"
#include "goldens/numbers_json.h"
#include "slipface/base/files.h"

namespace slipface {

namespace fs = std::filesystem;

namespace {

// The files below `folder` with this ending, as names without it, ascending. Folders with a leading '.'
// belong to other programs.
std::vector<std::string> files_below(const fs::path& folder, const char* ending) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        if (it->path().filename().string().starts_with('.') && it->is_directory(error)) {
            it.disable_recursion_pending();
            continue;
        }
        if (it->path().extension() == ending)
            names.push_back(it->path().lexically_relative(folder).replace_extension().generic_string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

// The name of the golden that a file is, or is an alternate or a drawer's own of.
std::string golden_of_file(std::string name) {
    if (name.starts_with("renderers/")) name.erase(0, name.find('/', sizeof "renderers/" - 1) + 1);
    const std::size_t dot = name.rfind(".alt");
    const bool alternate =
        dot != std::string::npos && dot + 5 == name.size() && name[dot + 4] >= '1' && name[dot + 4] <= '9';
    return alternate ? name.substr(0, dot) : name;
}

}  // namespace

std::vector<std::string> orphan_goldens(const fs::path& folder, const std::vector<std::string>& names) {
    const std::set<std::string> known(names.begin(), names.end());
    std::vector<std::string> orphans = files_below(folder, ".png");
    for (const std::string& name : files_below(folder, ".json"))
        if (is_input(name)) orphans.push_back(name);
    std::erase_if(orphans, [&](const std::string& name) { return known.contains(golden_of_file(name)); });
    return orphans;
}

bool bytes_were_approved(const fs::path& folder, const std::string& input, const std::string& mark) {
    for (const std::string& name : files_below(folder, ".json")) {
        if (is_input(name)) continue;
        const Result<std::string> text = read_file(folder / (name + ".json"), std::uint64_t{64} << 20U);
        const Numbers numbers = text ? Numbers::parse(*text, nullptr, false) : Numbers();
        if (numbers.is_object() && numbers.contains("inputs") && numbers["inputs"].value(input, "") == mark)
            return true;
    }
    return false;
}

}  // namespace slipface

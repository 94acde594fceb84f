#include "slipface/base/named_file.h"

#include <algorithm>
#include <string>

#include "slipface/base/files.h"
#include "slipface/base/system.h"

namespace slipface {

namespace fs = std::filesystem;

Error NamedFile::error() const {
    return {path.string(),
            state == State::outside ? "lies outside the level's folder: not read" : "there is no such file"};
}

NamedFile named_file(std::string_view name, const fs::path& folder) {
    constexpr std::size_t longest_name = 4096;
    std::string portable(name.substr(0, std::min(name.find('\0'), longest_name)));
    std::replace(portable.begin(), portable.end(), '\\', '/');
    NamedFile file{folder / path_of(portable)};
    std::error_code error;
    if (!lies_within(file.path, folder))
        file.state = NamedFile::State::outside;
    else if (portable.size() == name.size() && !name.empty() && fs::exists(file.path, error))
        file.state = NamedFile::State::there;
    return file;
}

}  // namespace slipface

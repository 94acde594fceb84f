#include "goldens/drawer.h"

#include <cctype>

#include "goldens/numbers_json.h"

namespace slipface {

std::string drawn_by(std::string_view numbers) {
    const Numbers json = Numbers::parse(numbers, nullptr, false);
    if (!json.is_object() || !json.contains("renderer") || !json["renderer"].is_object()) return "";
    const auto text = [&](const char* key) {
        const auto found = json["renderer"].find(key);
        return found != json["renderer"].end() && found->is_string() ? found->get<std::string>()
                                                                     : std::string();
    };
    // "4.5 (Core Profile) Mesa 22.3.6": the third number changes no pixels.
    const std::string version = text("version"), interface = text("interface");
    std::size_t begin = version.find("Mesa ");
    if (begin == std::string::npos) begin = 0;
    std::size_t end = version.find('.', begin);
    if (end != std::string::npos) do
            ++end;
        while (end < version.size() && std::isdigit(static_cast<unsigned char>(version[end])) != 0);
    const std::string mesa = version.substr(begin, end == std::string::npos ? end : end - begin);
    return interface.empty() ? mesa : mesa + ", " + interface;
}

std::filesystem::path drawers_folder(std::string_view drawer) {
    std::string name;
    for (const char c : drawer) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.';
        if (plain)
            name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (!name.empty() && name.back() != '-')
            name += '-';
    }
    return name.empty() ? std::filesystem::path() : std::filesystem::path("renderers") / name;
}

}  // namespace slipface

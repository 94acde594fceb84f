#include "obj/declared_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "obj/obj_text.h"

namespace slipface {
namespace {

constexpr std::size_t longest_header = 1 << 16;

Status check_count(std::string_view word, std::string_view bytes, const std::string& location) {
    const std::optional<double> count = read_number(word);
    if (!count || *count <= static_cast<double>(bytes.size())) return {};
    return Error{location,
                 fmt::format("declares {} elements, but has {} bytes", in_quotes(word), bytes.size())};
}

}  // namespace

Status check_declared_counts(const std::string& extension, std::string_view bytes,
                             const std::string& location) {
    if (extension != "ply" && extension != "off") return {};
    std::string header(bytes.substr(0, longest_header));
    if (extension == "ply") header.resize(std::min(header.find("end_header"), header.size()));
    LineReader lines(header);
    for (int line = 0; lines.next();) {
        std::string_view rest = lines.line();
        if (extension == "ply") {
            if (take_word(rest) != "element") continue;
            take_word(rest);
            if (auto status = check_count(take_word(rest), bytes, location); !status) return status;
            continue;
        }
        // The counts are in the first line after the word OFF, or on the same line.
        while (!rest.empty())
            if (auto status = check_count(take_word(rest), bytes, location); !status) return status;
        if (!lines.line().empty() && ++line == 2) break;
    }
    return {};
}

}  // namespace slipface

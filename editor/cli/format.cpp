#include "cli/format.h"

#include <fmt/format.h>

namespace slipface::cli {
namespace {

// Three decimals, and no sign in front of a zero.
std::string millimetres(double value) {
    std::string text = fmt::format("{:.3f}", value);
    return text == "-0.000" ? text.substr(1) : text;
}

}  // namespace

OutputJson vector_json(const Vec3& vector) {
    return OutputJson::array({vector.x(), vector.y(), vector.z()});
}

void print_json(std::ostream& out, const OutputJson& json) {
    out << json.dump(2, ' ', false, OutputJson::error_handler_t::replace) << '\n';
}

void print_row(std::ostream& out, std::string_view name, std::string_view value) {
    constexpr std::size_t column = 16;
    out << fmt::format("{:<16}{}{}\n", name, name.size() < column ? "" : "  ", value);
}

std::string vector_text(const Vec3& vector) {
    return fmt::format("{}  {}  {}", millimetres(vector.x()), millimetres(vector.y()),
                       millimetres(vector.z()));
}

std::string duration_text(double seconds) {
    if (seconds >= 1.0) return fmt::format("{:.2f} s", seconds);
    if (seconds >= 0.01) return fmt::format("{:.0f} ms", seconds * 1e3);
    return fmt::format("{:.2f} ms", seconds * 1e3);
}

std::string bytes_text(std::size_t bytes) {
    const auto amount = static_cast<double>(bytes);
    if (amount >= 1e6) return fmt::format("{:.1f} MB", amount / 1e6);
    if (amount >= 1e3) return fmt::format("{:.1f} kB", amount / 1e3);
    return fmt::format("{} bytes", bytes);
}

std::string hash_text(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
    std::string field = "\"";
    for (const char c : text) {
        if (c == '"') field += '"';
        field += c;
    }
    return field + '"';
}

}  // namespace slipface::cli

#include "document/preferences.h"

#include <algorithm>

#include "slipface/base/files.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::uint64_t largest_file = 1 << 20;

}  // namespace

Preferences::Preferences(std::filesystem::path file) : file_(std::move(file)) {
    const Result<std::string> text = read_file(file_, largest_file);
    if (!text) return;
    for (const std::string_view line : split(*text, '\n')) {
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos || trim(line).starts_with('#')) continue;
        const std::string_view name = trim(line.substr(0, equals));
        if (!name.empty()) values_.insert_or_assign(std::string(name), trim(line.substr(equals + 1)));
    }
}

std::string Preferences::text(std::string_view name, std::string fallback) const {
    const auto found = values_.find(name);
    return found == values_.end() ? fallback : found->second;
}

double Preferences::number(std::string_view name, double fallback, double minimum, double maximum) const {
    const std::optional<double> value = parse_double(text(name));
    return value ? std::clamp(*value, minimum, maximum) : fallback;
}

bool Preferences::flag(std::string_view name, bool fallback) const {
    const std::string value = text(name);
    return value == "on" ? true : value == "off" ? false : fallback;
}

void Preferences::set(std::string_view name, std::string value) {
    std::replace_if(
        value.begin(), value.end(), [](char c) { return c == '\n' || c == '\r' || c == '\0'; }, ' ');
    const auto found = values_.find(name);
    if (found != values_.end() && found->second == value) return;
    values_.insert_or_assign(std::string(name), std::move(value));
    changed_ = true;
}

void Preferences::set(std::string_view name, double value) {
    set(name, to_text(value));
}
void Preferences::set(std::string_view name, bool value) {
    set(name, value ? "on" : "off");
}

void Preferences::remove(std::string_view name) {
    if (const auto found = values_.find(name); found != values_.end()) {
        values_.erase(found);
        changed_ = true;
    }
}

void Preferences::remove_all(std::string_view prefix) {
    changed_ |= std::erase_if(values_, [&](const auto& row) { return row.first.starts_with(prefix); }) > 0;
}

void Preferences::save() {
    if (!changed_ || file_.empty()) return;
    changed_ = false;
    std::string text;
    for (const auto& [name, value] : values_)
        text += name + " = " + value + "\n";
    std::error_code error;
    std::filesystem::create_directories(file_.parent_path(), error);
    static_cast<void>(write_file_atomic(file_, text));
}

}  // namespace slipface

#include "cli/request.h"

#include <fmt/format.h>

#include <algorithm>

namespace slipface::cli {
namespace {

std::string excerpt(const OutputJson& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return fmt::format("an array of {}", value.size());
    std::string text = value.dump(-1, ' ', true, OutputJson::error_handler_t::replace);
    if (text.size() > 80) text = text.substr(0, 77) + "...";
    return text;
}

}  // namespace

void Placed::refuse(std::string_view expected) const {
    throw Refused{place.empty() ? "/" : place, excerpt(value), std::string(expected)};
}

Placed Placed::member(std::string_view key) const {
    if (!value.is_object()) refuse("an object");
    const auto found = value.find(key);
    if (found == value.end())
        throw Refused{place.empty() ? "/" : place, "nothing", fmt::format("a member \"{}\"", key)};
    return {*found, place + "/" + std::string(key)};
}

void Placed::need_object_of(std::initializer_list<std::string_view> keys) const {
    if (!value.is_object()) refuse("an object");
    for (const auto& entry : value.items()) {
        if (std::find(keys.begin(), keys.end(), entry.key()) != keys.end()) continue;
        std::string names;
        for (const std::string_view key : keys)
            names += (names.empty() ? "" : ", ") + std::string(key);
        throw Refused{place.empty() ? "/" : place, "the member " + excerpt(OutputJson(entry.key())),
                      "only " + names};
    }
}

std::size_t Placed::need_array(std::size_t most) const {
    if (!value.is_array() || value.size() > most) refuse(fmt::format("an array of at most {}", most));
    return value.size();
}

Placed Placed::item(std::size_t index) const {
    return {value[index], fmt::format("{}/{}", place, index)};
}

double Placed::number(double least, double most) const {
    const double found = value.is_number() ? value.get<double>() : most + 1.0;
    if (!value.is_number() || !(found >= least && found <= most))
        refuse(fmt::format("a number from {} to {}", least, most));
    return found;
}

std::size_t Placed::whole(std::size_t least, std::size_t most) const {
    const bool fits = value.is_number_unsigned() && value.get<std::uint64_t>() >= least &&
                      value.get<std::uint64_t>() <= most;
    if (!fits) refuse(fmt::format("a whole number from {} to {}", least, most));
    return value.get<std::size_t>();
}

bool Placed::truth() const {
    if (!value.is_boolean()) refuse("true or false");
    return value.get<bool>();
}

std::string Placed::text() const {
    if (!value.is_string() || value.get_ref<const std::string&>().size() > 1000)
        refuse("a string of at most 1000 bytes");
    return value.get<std::string>();
}

Vec3 Placed::vector(double most) const {
    if (!value.is_array() || value.size() != 3) refuse("three numbers");
    return {item(0).number(-most, most), item(1).number(-most, most), item(2).number(-most, most)};
}

}  // namespace slipface::cli

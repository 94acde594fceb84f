#include "json_reader.h"

#include <fmt/format.h>

#include "slipface/base/text.h"

namespace slipface {
namespace {

std::string range_text(std::string_view what, double minimum, double maximum) {
    return fmt::format("{} from {} to {}", what, to_text(minimum), to_text(maximum));
}

}  // namespace

bool JsonReader::fail(Error error) {
    if (!error_) error_ = std::move(error);
    return false;
}

bool JsonReader::fail(const std::string& path, std::string found, std::string expected) {
    return fail(Error{location(path), "found " + found + ", expected " + expected});
}

bool JsonReader::object(const Json& value, const std::string& path) {
    if (value.kind == Json::Kind::object) return ok();
    return fail(path, json_kind_text(value), "an object");
}

bool JsonReader::array(const Json& value, const std::string& path, std::size_t max_size) {
    if (value.kind != Json::Kind::array) return fail(path, json_kind_text(value), "an array");
    if (value.items.size() > max_size) {
        return fail(path, fmt::format("{} elements", value.items.size()),
                    fmt::format("at most {}", max_size));
    }
    return ok();
}

bool JsonReader::text(const Json& value, const std::string& path, std::string& out) {
    if (value.kind != Json::Kind::string) return fail(path, json_kind_text(value), "a string");
    if (ok()) out = value.text;
    return ok();
}

bool JsonReader::boolean(const Json& value, const std::string& path, bool& out) {
    if (value.kind != Json::Kind::boolean) return fail(path, json_kind_text(value), "true or false");
    if (ok()) out = value.truth;
    return ok();
}

bool JsonReader::number(const Json& value, const std::string& path, double minimum, double maximum,
                        double& out) {
    const std::optional<double> number =
        value.kind == Json::Kind::number ? parse_double(value.text) : std::optional<double>();
    if (!number || !(*number >= minimum && *number <= maximum)) {
        return fail(path, json_kind_text(value), range_text("a number", minimum, maximum));
    }
    if (ok()) out = *number;
    return ok();
}

bool JsonReader::integer(const Json& value, const std::string& path, int minimum, int maximum, int& out) {
    const std::optional<std::int64_t> number =
        value.kind == Json::Kind::number ? parse_int(value.text) : std::optional<std::int64_t>();
    if (!number || *number < minimum || *number > maximum) {
        return fail(path, json_kind_text(value), range_text("a whole number", minimum, maximum));
    }
    if (ok()) out = static_cast<int>(*number);
    return ok();
}

bool JsonReader::vector(const Json& value, const std::string& path, double limit_low, double limit_high,
                        Vec3& out) {
    if (value.kind != Json::Kind::array)
        return fail(path, json_kind_text(value), "an array of three numbers");
    if (value.items.size() != 3) {
        return fail(path, fmt::format("an array of {}", value.items.size()), "an array of three numbers");
    }
    Vec3 read = out;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double& part = read[static_cast<Eigen::Index>(axis)];
        if (!number(value.items[axis], path + "/" + std::to_string(axis), limit_low, limit_high, part))
            return false;
    }
    if (ok()) out = read;
    return ok();
}

const Json* JsonReader::member(const Json& object, const std::string& path, std::string_view key) {
    const Json* value = object.find(key);
    if (value == nullptr) fail(path, fmt::format("no \"{}\"", key), "one");
    return ok() ? value : nullptr;
}

}  // namespace slipface

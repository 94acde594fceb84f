#include "json_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "slipface/base/base64.h"
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

bool JsonNode::fail(const std::string& found, const std::string& expected) const {
    return reader_.fail(Error{location(), "found " + found + ", expected " + expected});
}

bool JsonNode::fail(const std::string& expected) const {
    return fail(json_kind_text(*json_), expected);
}

bool JsonNode::fail_name(const std::string& name, const std::vector<std::string>& names) const {
    return fail(fmt::format("\"{}\"", json_excerpt(name)), fmt::format("one of {}", fmt::join(names, ", ")));
}

JsonNode JsonNode::operator[](std::string_view key) const {
    read_.emplace_back(key);
    return {reader_, *this ? json_->find(key) : nullptr, fmt::format("{}/{}", path_, key)};
}

JsonNode JsonNode::need(std::string_view key) const {
    JsonNode member = (*this)[key];
    if (*this && !member) fail(fmt::format("no \"{}\"", key), "one");
    return member;
}

std::vector<std::size_t> JsonNode::unknown() const {
    std::vector<std::size_t> members;
    if (!*this) return members;
    for (std::size_t i = 0; i < json_->keys.size(); ++i)
        if (std::find(read_.begin(), read_.end(), json_->keys[i]) == read_.end()) members.push_back(i);
    return members;
}

bool JsonNode::object() const {
    if (!*this) return false;
    return json_->kind == Json::Kind::object || fail("an object");
}

bool JsonNode::array(std::size_t max_size) const {
    if (!*this) return false;
    if (json_->kind != Json::Kind::array) return fail("an array");
    if (json_->items.size() > max_size)
        return fail(fmt::format("{} elements", json_->items.size()), fmt::format("at most {}", max_size));
    return true;
}

bool JsonNode::text(std::string& out) const {
    if (!*this) return false;
    if (json_->kind != Json::Kind::string) return fail("a string");
    out = json_->text;
    return true;
}

bool JsonNode::boolean(bool& out) const {
    if (!*this) return false;
    if (json_->kind != Json::Kind::boolean) return fail("true or false");
    out = json_->truth;
    return true;
}

bool JsonNode::number(double minimum, double maximum, double& out) const {
    if (!*this) return false;
    const std::optional<double> number =
        json_->kind == Json::Kind::number ? parse_double(json_->text) : std::optional<double>();
    if (!number || !(*number >= minimum && *number <= maximum))
        return fail(range_text("a number", minimum, maximum));
    out = *number;
    return true;
}

bool JsonNode::number(double minimum, double maximum, std::optional<double>& out) const {
    double value = 0.0;
    if (!number(minimum, maximum, value)) return false;
    out = value;
    return true;
}

bool JsonNode::integer(int minimum, int maximum, int& out) const {
    if (!*this) return false;
    const std::optional<std::int64_t> number =
        json_->kind == Json::Kind::number ? parse_int(json_->text) : std::optional<std::int64_t>();
    if (!number || *number < minimum || *number > maximum)
        return fail(range_text("a whole number", minimum, maximum));
    out = static_cast<int>(*number);
    return true;
}

bool JsonNode::vector(double minimum, double maximum, Vec3& out) const {
    if (!*this) return false;
    if (json_->kind != Json::Kind::array) return fail("an array of three numbers");
    if (json_->items.size() != 3)
        return fail(fmt::format("an array of {}", json_->items.size()), "an array of three numbers");
    Vec3 read = out;
    Eigen::Index axis = 0;
    each(3, [&](const JsonNode& part) { part.number(minimum, maximum, read[axis++]); });
    if (reader_.ok()) out = read;
    return reader_.ok();
}

bool JsonNode::base64(const std::string& what, std::string& bytes) const {
    if (!*this) return false;
    std::optional<std::string> read;
    if (json_->kind == Json::Kind::string) read = from_base64(json_->text, Base64::plain);
    if (!read) return fail(what + ", as base64");
    bytes = std::move(*read);
    return true;
}

}  // namespace slipface

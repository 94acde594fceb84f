#include "json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "slipface/base/text.h"

namespace slipface {
namespace {

// The path of the value that is read next: "/surfaces/2/friction".
std::string pointer_of(const std::vector<Json>& open) {
    std::string path;
    for (const Json& value : open) {
        path += '/';
        path += value.kind == Json::Kind::object ? (value.keys.empty() ? std::string() : value.keys.back())
                                                 : std::to_string(value.items.size());
    }
    return path.empty() ? "/" : path;
}

std::string line_and_column(std::string_view text, std::size_t position) {
    const std::string_view before = text.substr(0, std::min(position == 0 ? 0 : position - 1, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t newline = before.rfind('\n');
    const std::size_t column =
        newline == std::string_view::npos ? before.size() + 1 : before.size() - newline;
    return fmt::format("{}:{}", line, column);
}

// Builds a Json from the parser's events. The parser has its own stack, so nesting uses no call stack.
class Builder final : public nlohmann::json_sax<nlohmann::json> {
  public:
    Builder(std::string_view text, const std::string& location, int max_depth)
        : text_(text), location_(location), max_depth_(static_cast<std::size_t>(max_depth)) {}

    bool null() override { return add(Json{}); }
    bool boolean(bool value) override { return add(json_bool(value)); }
    // Only numbers with a minus; that of -0 is lost in the value.
    bool number_integer(number_integer_t value) override {
        return add_number(value == 0 ? "-0" : std::to_string(value));
    }
    bool number_unsigned(number_unsigned_t value) override { return add_number(std::to_string(value)); }
    bool number_float(number_float_t, const string_t& spelling) override { return add_number(spelling); }
    bool string(string_t& value) override { return add(json_string(value)); }
    bool binary(binary_t&) override { return fail("binary data", "text"); }
    bool start_object(std::size_t) override { return open(json_object()); }
    bool start_array(std::size_t) override { return open(json_array()); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        open_.back().keys.push_back(name);
        return true;
    }

    bool end_object() override {
        std::vector<std::string_view> names(open_.back().keys.begin(), open_.back().keys.end());
        std::sort(names.begin(), names.end());
        const auto twin = std::adjacent_find(names.begin(), names.end());
        if (twin != names.end()) {
            open_.back().keys.push_back(std::string(*twin));
            return fail("a duplicate key", "each key once");
        }
        return close();
    }

    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::detail::exception& error) override {
        std::string message = error.what();
        for (const std::string_view mark : {"] ", ": syntax error while parsing "}) {
            const std::size_t at = message.find(mark);
            if (at != std::string::npos) message.erase(0, at + mark.size());
        }
        error_ = Error{location_ + ":" + line_and_column(text_, position),
                       "not valid JSON: " + json_excerpt(message)};
        return false;
    }

    Result<Json> take() {
        if (error_) return *error_;
        return std::move(root_);
    }

  private:
    bool fail(std::string_view found, std::string_view expected) {
        error_ = Error{location_ + ":" + json_excerpt(pointer_of(open_)),
                       fmt::format("found {}, expected {}", found, expected)};
        return false;
    }

    bool count() {
        if (++values_ <= max_json_values) return true;
        return fail("more values than a level file may hold", fmt::format("at most {}", max_json_values));
    }

    bool add(Json value) { return count() && attach(std::move(value)); }

    bool add_number(std::string spelling) {
        Json value;
        value.kind = Json::Kind::number;
        value.text = std::move(spelling);
        return add(std::move(value));
    }

    bool open(Json value) {
        if (!count()) return false;
        if (open_.size() >= max_depth_) {
            return fail("deeper nesting", fmt::format("at most {} levels", max_depth_));
        }
        open_.push_back(std::move(value));
        return true;
    }

    bool close() {
        Json value = std::move(open_.back());
        open_.pop_back();
        return attach(std::move(value));
    }

    bool attach(Json value) {
        if (open_.empty()) {
            root_ = std::move(value);
        } else {
            open_.back().items.push_back(std::move(value));
        }
        return true;
    }

    std::string_view text_;
    const std::string& location_;
    std::size_t max_depth_;
    std::vector<Json> open_;
    Json root_;
    std::size_t values_ = 0;
    std::optional<Error> error_;
};

bool is_scalar(const Json& value) {
    return value.kind != Json::Kind::array && value.kind != Json::Kind::object;
}

bool fits_one_line(const Json& value) {
    if (value.items.empty()) return true;
    return value.kind == Json::Kind::array &&
           std::all_of(value.items.begin(), value.items.end(),
                       [](const Json& item) { return is_scalar(item) && item.kind != Json::Kind::string; });
}

// `indent` < 0: everything on one line.
void write(std::string& out, const Json& value, int indent) {
    switch (value.kind) {
        case Json::Kind::null: out += "null"; return;
        case Json::Kind::boolean: out += value.truth ? "true" : "false"; return;
        case Json::Kind::number: out += value.text; return;
        case Json::Kind::string: out += json_quoted(value.text); return;
        default: break;
    }
    const bool object = value.kind == Json::Kind::object;
    const bool one_line = indent < 0 || fits_one_line(value);
    const auto new_line = [&](int level) {
        out += '\n';
        out.append(2 * static_cast<std::size_t>(level), ' ');
    };
    out += object ? '{' : '[';
    for (std::size_t i = 0; i < value.items.size(); ++i) {
        if (i > 0) out += one_line && indent >= 0 ? ", " : ",";
        if (!one_line) new_line(indent + 1);
        if (object) out += json_quoted(value.keys[i]) + (indent < 0 ? ":" : ": ");
        write(out, value.items[i], indent < 0 ? -1 : indent + 1);
    }
    if (!one_line) new_line(indent);
    out += object ? '}' : ']';
}

Json number_of(std::string spelling) {
    Json json;
    json.kind = Json::Kind::number;
    json.text = std::move(spelling);
    return json;
}

}  // namespace

const Json* Json::find(std::string_view key) const {
    const auto found = std::find(keys.begin(), keys.end(), key);
    return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

Result<Json> parse_json(std::string_view text, const std::string& location, int max_depth) {
    Builder builder(text, location, max_depth);
    nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
    return builder.take();
}

std::string json_kind_text(const Json& value) {
    switch (value.kind) {
        case Json::Kind::null: return "null";
        case Json::Kind::boolean: return value.truth ? "true" : "false";
        case Json::Kind::number:
            return value.text.size() <= 40 ? "the number " + value.text : "a long number";
        case Json::Kind::string:
            return value.text.size() <= 40 ? "the string " + json_quoted(value.text) : "a long string";
        case Json::Kind::array: return "an array";
        case Json::Kind::object: return "an object";
    }
    return "";
}

std::string json_excerpt(std::string_view text) {
    constexpr std::size_t head = 160, tail = 80;
    const auto continues = [&](std::size_t at) {
        return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
    };
    std::string shown(text);
    if (text.size() > head + tail + 3) {
        std::size_t end = head, begin = text.size() - tail;
        while (end > 0 && continues(end))
            --end;
        while (continues(begin))
            ++begin;
        shown = std::string(text.substr(0, end)) + "..." + std::string(text.substr(begin));
    }
    return nlohmann::json::parse(json_quoted(shown)).get<std::string>();
}

std::string json_quoted(std::string_view text) {
    const auto stands_for_itself = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; };
    if (std::all_of(text.begin(), text.end(), stands_for_itself)) return fmt::format("\"{}\"", text);
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string json_compact(const Json& value) {
    std::string out;
    write(out, value, -1);
    return out;
}

std::string json_pretty(const Json& value, int indent) {
    std::string out;
    write(out, value, indent);
    return out;
}

Json json_number(double value) {
    return number_of(to_text(value == 0.0 ? 0.0 : value));
}
Json json_number(float value) {
    return number_of(fmt::format("{}", value == 0.0F ? 0.0F : value));
}
Json json_number(std::int64_t value) {
    return number_of(std::to_string(value));
}

Json json_string(std::string_view text) {
    Json json;
    json.kind = Json::Kind::string;
    json.text = text;
    return json;
}

Json json_bool(bool value) {
    Json json;
    json.kind = Json::Kind::boolean;
    json.truth = value;
    return json;
}

Json json_array(std::vector<Json> items) {
    Json json;
    json.kind = Json::Kind::array;
    json.items = std::move(items);
    return json;
}

Json json_object(std::initializer_list<std::pair<const char*, Json>> members) {
    Json json;
    json.kind = Json::Kind::object;
    for (const auto& [key, value] : members)
        json_add(json, key, value);
    return json;
}

void json_add(Json& object, std::string_view key, Json value) {
    object.keys.emplace_back(key);
    object.items.push_back(std::move(value));
}

}  // namespace slipface

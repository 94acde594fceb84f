// Reads typed values from a Json, with errors that name the JSON path.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "json_text.h"
#include "slipface/base/types.h"

namespace slipface {

inline constexpr double farthest_position = 1e9;  // metres along an axis, in a level file

// Where the values are, and the first error.
class JsonReader {
  public:
    explicit JsonReader(std::string file) : file_(std::move(file)) {}

    bool fail(Error error);
    bool ok() const { return !error_.has_value(); }
    const Error& error() const { return *error_; }
    std::string location(const std::string& path) const {
        return file_ + ":" + json_excerpt(path.empty() ? "/" : path);
    }

  private:
    std::string file_;
    std::optional<Error> error_;
};

// A value and its path. A member that is not there is a node without a value. Without a value, and after the
// first error of the reader, every function returns false and changes nothing.
class JsonNode {
  public:
    JsonNode(JsonReader& reader, const Json* json, std::string path = "")
        : reader_(reader), json_(json), path_(std::move(path)) {}

    explicit operator bool() const { return json_ != nullptr && reader_.ok(); }
    const Json& json() const { return *json_; }
    const std::string& path() const { return path_; }  // "/surfaces/2/friction"; empty for the whole file
    std::string location() const { return reader_.location(path_); }

    JsonNode operator[](std::string_view key) const;  // a member
    JsonNode need(std::string_view key) const;        // fails if it is not there
    std::vector<std::size_t> unknown() const;         // the members that nobody has read

    bool object() const;
    bool array(std::size_t max_size) const;
    bool text(std::string& out) const;
    bool boolean(bool& out) const;
    bool number(double minimum, double maximum, double& out) const;
    bool number(double minimum, double maximum, std::optional<double>& out) const;
    bool integer(int minimum, int maximum, int& out) const;
    bool vector(double minimum, double maximum, Vec3& out) const;
    bool base64(const std::string& what, std::string& bytes) const;  // `what` is in the text, for the error

    template <class Enum, std::size_t count>
    bool one_of(const std::array<const char*, count>& names, Enum& out) const {
        std::string name;
        if (!text(name)) return false;
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) return fail_name(name, {names.begin(), names.end()});
        out = static_cast<Enum>(found - names.begin());
        return true;
    }

    // read(element) for each element of an array.
    template <class Read>
    void each(std::size_t max_size, const Read& read) const {
        if (!array(max_size)) return;
        for (std::size_t i = 0; i < json_->items.size() && reader_.ok(); ++i)
            read(JsonNode(reader_, &json_->items[i], path_ + "/" + std::to_string(i)));
    }

    // Always false: the value is not what was expected.
    bool fail(const std::string& expected) const;
    bool fail(const std::string& found, const std::string& expected) const;
    bool fail(const Error& reason) const { return reader_.fail(Error{location(), reason.message}); }

  private:
    bool fail_name(const std::string& name, const std::vector<std::string>& names) const;

    JsonReader& reader_;
    const Json* json_;
    std::string path_;
    mutable std::vector<std::string> read_;  // members
};

}  // namespace slipface

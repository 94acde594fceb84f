// Reads typed values from a Json, with errors that name the JSON path.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>

#include "json_text.h"
#include "slipface/base/types.h"

namespace slipface {

// Stores the first error; after it every reading function returns false and changes nothing.
class JsonReader {
  public:
    explicit JsonReader(std::string file) : file_(std::move(file)) {}

    // `path` names the value in errors: "/surfaces/2/friction".
    bool object(const Json& value, const std::string& path);
    bool array(const Json& value, const std::string& path, std::size_t max_size);
    bool text(const Json& value, const std::string& path, std::string& out);
    bool boolean(const Json& value, const std::string& path, bool& out);
    bool number(const Json& value, const std::string& path, double minimum, double maximum, double& out);
    bool integer(const Json& value, const std::string& path, int minimum, int maximum, int& out);
    bool vector(const Json& value, const std::string& path, double limit_low, double limit_high, Vec3& out);

    // A required member; null after an error.
    const Json* member(const Json& object, const std::string& path, std::string_view key);

    bool fail(const std::string& path, std::string found, std::string expected);
    bool fail(Error error);

    bool ok() const { return !error_.has_value(); }
    const Error& error() const { return *error_; }
    std::string location(const std::string& path) const { return file_ + ":" + json_excerpt(path); }

  private:
    std::string file_;
    std::optional<Error> error_;
};

}  // namespace slipface

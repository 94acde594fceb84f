// The editor's preferences: a text file of "name = value" lines. Unknown lines are preserved, so that an
// older version does not delete those of a newer one.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace slipface {

class Preferences {
  public:
    Preferences() = default;                           // nothing is stored on disk
    explicit Preferences(std::filesystem::path file);  // a missing or unreadable file counts as empty

    std::string text(std::string_view name, std::string fallback = {}) const;
    double number(std::string_view name, double fallback, double minimum, double maximum) const;
    bool flag(std::string_view name, bool fallback) const;

    void set(std::string_view name, std::string value);  // line ends in it become spaces
    void set(std::string_view name, const char* value) { set(name, std::string(value)); }
    void set(std::string_view name, double value);
    void set(std::string_view name, bool value);
    void remove(std::string_view name);
    void remove_all(std::string_view prefix);  // all names with this prefix

    const std::map<std::string, std::string, std::less<>>& values() const { return values_; }
    // Writes the file if anything changed since it was read or written. Errors are ignored.
    void save();

  private:
    std::filesystem::path file_;
    std::map<std::string, std::string, std::less<>> values_;
    bool changed_ = false;
};

}  // namespace slipface

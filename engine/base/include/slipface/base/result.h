// Errors as values. A function that can fail on its input returns Result<T>; it does not throw.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace slipface {

// One problem and where it is. `location` is as exact as is known: "level.obj:12",
// "level.slipface.json:/rules/0/type", "level.obj". `message` says what was found and what was expected.
struct Diagnostic {
    std::string location;
    std::string message;

    std::string text() const { return location.empty() ? message : location + ": " + message; }
    friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

using Error = Diagnostic;
using Warnings = std::vector<Diagnostic>;

// A T, or the reason why there is none. Reading the side that is absent is a programming error
// (std::bad_variant_access).
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    T& value() & { return std::get<0>(state_); }
    const T& value() const& { return std::get<0>(state_); }
    T&& value() && { return std::get<0>(std::move(state_)); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }

    const Error& error() const { return std::get<1>(state_); }

  private:
    std::variant<T, Error> state_;
};

// Success, or the reason why not.
class [[nodiscard]] Status {
  public:
    Status() = default;
    Status(Error error) : error_(std::move(error)) {}

    bool ok() const { return !error_.has_value(); }
    explicit operator bool() const { return ok(); }
    const Error& error() const { return error_.value(); }

  private:
    std::optional<Error> error_;
};

}  // namespace slipface

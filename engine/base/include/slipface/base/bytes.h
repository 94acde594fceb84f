// Numbers, texts and lists as bytes, in the order of this machine's memory (all that we build for are
// little-endian), and back.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace slipface {

class ByteWriter {
  public:
    template <class T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    // As many bytes as `value` has, after their number as `Count`.
    template <class Count>
    void put_text(std::string_view value) {
        put(static_cast<Count>(value.size()));
        bytes += value;
    }
    // The items of a vector, numbers or structs of numbers, after how many they are as `Count`.
    template <class Count, class Items>
    void put_list(const Items& items) {
        put(static_cast<Count>(items.size()));
        bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(*items.data()));
    }
    std::string bytes;
};

// Reads what ByteWriter wrote. From the first value that is missing everything is zero or empty.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
    template <class T>
    T get() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value{};
        const std::string_view found = take(sizeof value);
        if (ok_) std::memcpy(&value, found.data(), sizeof value);
        return value;
    }
    // A number of items of at least `size` bytes each; fails if fewer bytes follow.
    template <class Count>
    std::size_t get_count(std::size_t size) {
        const auto count = get<Count>();
        if (count > left() / size) ok_ = false;
        return ok_ ? static_cast<std::size_t>(count) : 0;
    }
    template <class Count>
    std::string get_text() {
        return std::string(take(get_count<Count>(1)));
    }
    template <class Count, class T>
    std::vector<T> get_list() {
        std::vector<T> items(get_count<Count>(sizeof(T)));
        const std::string_view found = take(items.size() * sizeof(T));
        if (!found.empty()) std::memcpy(static_cast<void*>(items.data()), found.data(), found.size());
        return items;
    }
    bool ok() const { return ok_; }
    bool at_end() const { return at_ == bytes_.size(); }
    std::size_t at() const { return at_; }
    std::size_t left() const { return bytes_.size() - at_; }
    void fail() { ok_ = false; }

  private:
    std::string_view take(std::size_t size) {
        if (size > left()) ok_ = false;
        if (!ok_) return {};
        at_ += size;
        return bytes_.substr(at_ - size, size);
    }
    std::string_view bytes_;
    std::size_t at_ = 0;
    bool ok_ = true;
};

}  // namespace slipface

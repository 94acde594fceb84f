// Numbers, texts and lists as bytes, and back: this machine's byte order, no padding between values.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace slipface {

// `Count` is the type of the number that stands before a text and a list.
template <class Count>
class ByteWriter {
  public:
    template <class T>
    void put(T value) {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void put_text(std::string_view text) {
        put(static_cast<Count>(text.size()));
        bytes += text;
    }
    // Items without pointers, such as numbers or Vec3f.
    template <class T>
    void put_list(const std::vector<T>& items) {
        put(static_cast<Count>(items.size()));
        bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
    }

    std::string bytes;
};

// Reads what ByteWriter wrote. After the first value that is cut off, `ok` is false and all values are 0 or
// empty. Memory for a list is allocated only if its bytes follow.
template <class Count>
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes), size_(bytes.size()) {}

    template <class T>
    T get() {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
        T value{};
        if (const char* from = take(sizeof value)) std::memcpy(&value, from, sizeof value);
        return value;
    }
    // A number of items of at least `size` bytes each; 0 if so many bytes do not follow.
    std::size_t get_count(std::size_t size) {
        const auto count = get<Count>();
        ok = ok && count <= rest_.size() / size;
        return ok ? static_cast<std::size_t>(count) : 0;
    }
    std::string get_text() {
        const std::size_t count = get_count(1);
        const char* from = take(count);
        return from != nullptr ? std::string(from, count) : std::string();
    }
    template <class T>
    std::vector<T> get_list() {
        std::vector<T> items(get_count(sizeof(T)));
        const char* from = take(items.size() * sizeof(T));
        if (from != nullptr && !items.empty())
            std::memcpy(static_cast<void*>(items.data()), from, items.size() * sizeof(T));
        return items;
    }
    bool at_end() const { return rest_.empty(); }
    std::size_t at() const { return size_ - rest_.size(); }  // bytes read
    std::size_t left() const { return rest_.size(); }

    bool ok = true;

  private:
    const char* take(std::size_t size) {
        ok = ok && size <= rest_.size();
        if (!ok) return nullptr;
        const char* from = rest_.data();
        rest_.remove_prefix(size);
        return from;
    }

    std::string_view rest_;
    std::size_t size_;
};

}  // namespace slipface

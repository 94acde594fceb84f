#include "assimp/soup_bytes.h"

#include <cstring>
#include <type_traits>

namespace slipface {
namespace {

// One list of members serves both directions: Writer appends them, Reader takes them.
class Writer {
  public:
    template <typename T>
    void number(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void text(const std::string& value) {
        number(value.size());
        bytes += value;
    }
    template <typename T>
    void numbers(const std::vector<T>& values) {
        number(values.size());
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    }
    template <typename T, typename Each>
    void list(const std::vector<T>& values, Each each) {
        number(values.size());
        for (const T& value : values)
            each(value);
    }
    std::string bytes;
};

class Reader {
  public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    template <typename T>
    void number(T& value) {
        if (take(sizeof value)) std::memcpy(static_cast<void*>(&value), taken_, sizeof value);
    }
    void text(std::string& value) {
        const std::size_t size = count(1);
        if (take(size)) value.assign(taken_, size);
    }
    template <typename T>
    void numbers(std::vector<T>& values) {
        values.resize(count(sizeof(T)));
        if (take(values.size() * sizeof(T)) && !values.empty())
            std::memcpy(static_cast<void*>(values.data()), taken_, values.size() * sizeof(T));
    }
    template <typename T, typename Each>
    void list(std::vector<T>& values, Each each) {
        values.resize(count(sizeof(std::size_t)));
        for (T& value : values)
            each(value);
    }
    bool complete() const { return good_ && bytes_.empty(); }

  private:
    // A number of elements of at least `size` bytes each; 0 if so many bytes do not follow.
    std::size_t count(std::size_t size) {
        std::size_t elements = 0;
        number(elements);
        if (elements > bytes_.size() / size) good_ = false;
        return good_ ? elements : 0;
    }
    bool take(std::size_t size) {
        if (size > bytes_.size()) good_ = false;
        if (!good_) return false;
        taken_ = bytes_.data();
        bytes_.remove_prefix(size);
        return true;
    }
    std::string_view bytes_;
    const char* taken_ = nullptr;
    bool good_ = true;
};

template <typename Bytes, typename Answer>
void members(Bytes& bytes, Answer& answer) {
    bytes.list(answer.warnings, [&](auto& warning) {
        bytes.text(warning.location);
        bytes.text(warning.message);
    });
    bytes.number(answer.stamp.size);
    bytes.number(answer.stamp.hash);
    auto& frame = answer.scene.frame;
    bytes.number(frame.scale);
    bytes.number(frame.scale_from);
    bytes.text(frame.scale_reason);
    bytes.number(frame.up);
    bytes.number(frame.up_from);
    bytes.text(frame.up_reason);
    for (int i = 0; i < 9; ++i)
        bytes.number(frame.upright.data()[i]);
    auto& soup = answer.scene.soup;
    bytes.numbers(soup.corner_position);
    bytes.numbers(soup.corner_uv);
    bytes.numbers(soup.face_first_corner);
    bytes.numbers(soup.face_material);
    bytes.numbers(soup.face_group);
    bytes.list(soup.materials, [&](auto& material) {
        bytes.text(material.name);
        bytes.text(material.texture);
        for (int i = 0; i < 3; ++i)
            bytes.number(material.diffuse.data()[i]);
    });
    bytes.list(soup.groups, [&](auto& group) { bytes.text(group); });
}

}  // namespace

std::string answer_to_bytes(const SceneAnswer& answer) {
    Writer writer;
    writer.number(answer.error.has_value());
    if (answer.error) {
        writer.text(answer.error->location);
        writer.text(answer.error->message);
    } else {
        members(writer, answer);
    }
    return std::move(writer.bytes);
}

std::optional<SceneAnswer> answer_from_bytes(std::string_view bytes) {
    Reader reader(bytes);
    SceneAnswer answer;
    std::uint8_t failed = 2;
    reader.number(failed);
    if (failed > 1) return std::nullopt;
    if (failed == 1) {
        answer.error.emplace();
        reader.text(answer.error->location);
        reader.text(answer.error->message);
    } else {
        members(reader, answer);
        const FileFrame& frame = answer.scene.frame;
        if (frame.up > UpAxis::minus_x || frame.up_from > ImportSource::given ||
            frame.scale_from > ImportSource::given)
            return std::nullopt;
    }
    if (!reader.complete()) return std::nullopt;
    return answer;
}

}  // namespace slipface

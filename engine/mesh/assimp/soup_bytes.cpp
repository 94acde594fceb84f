#include "assimp/soup_bytes.h"

#include <algorithm>
#include <utility>

#include "slipface/base/bytes.h"
#include "slipface/mesh/rig.h"

namespace slipface {
namespace {

using Count = std::uint64_t;

// One list of members serves both directions: Writer appends them, Reader takes them.
struct Writer {
    template <typename T>
    void number(const T& value) {
        to.put(value);
    }
    void text(const std::string& value) { to.put_text(value); }
    template <typename T>
    void numbers(const std::vector<T>& values) {
        to.put_list(values);
    }
    template <typename T, typename Each>
    void list(const std::vector<T>& values, Each each) {
        to.put(Count{values.size()});
        for (const T& value : values)
            each(value);
    }
    ByteWriter<Count> to;
};

struct Reader {
    template <typename T>
    void number(T& value) {
        value = from.get<T>();
    }
    void text(std::string& value) { value = from.get_text(); }
    template <typename T>
    void numbers(std::vector<T>& values) {
        values = from.get_list<T>();
    }
    template <typename T, typename Each>
    void list(std::vector<T>& values, Each each) {
        values.resize(from.get_count(sizeof(Count)));
        for (T& value : values)
            each(value);
    }
    ByteReader<Count> from;
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
    bytes.text(answer.scene.type_table);
    bytes.list(answer.scene.spawns, [&](auto& spawn) {
        bytes.text(spawn.name);
        for (int i = 0; i < 3; ++i)
            bytes.number(spawn.feet.data()[i]);
        bytes.number(spawn.yaw);
    });
    bytes.list(answer.scene.types, [&](auto& type) {
        bytes.text(type.material);
        bytes.text(type.type);
    });
    bytes.numbers(answer.scene.undrawn);
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
    bytes.list(soup.other_files, [&](auto& file) { bytes.text(file); });
    bytes.list(soup.nodes, [&](auto& node) {
        bytes.text(node.name);
        bytes.number(node.parent);
        bytes.number(node.group);
        bytes.number(node.shape);
        for (int i = 0; i < 16; ++i)
            bytes.number(node.world.data()[i]);
    });
}

template <typename Bytes, typename SomeRig>
void rig_members(Bytes& bytes, SomeRig& rig) {
    bytes.numbers(rig.nodes);
    bytes.numbers(rig.bones);
    bytes.numbers(rig.weights);
    bytes.numbers(rig.corner_position);
    bytes.numbers(rig.corner_bones);
    bytes.numbers(rig.corner_weights);
    bytes.numbers(rig.corner_first_delta);
    bytes.numbers(rig.deltas);
    bytes.list(rig.clips, [&](auto& clip) {
        bytes.text(clip.name);
        bytes.number(clip.seconds);
        bytes.list(clip.tracks, [&](auto& track) {
            bytes.number(track.node);
            bytes.number(track.moves);
            bytes.number(track.between);
            bytes.numbers(track.times);
            bytes.numbers(track.values);
            bytes.numbers(track.arcs);
        });
    });
}

// Pictures that several materials have are written once.
void put_pictures(Writer& writer, const std::vector<Material>& materials) {
    std::vector<const std::string*> pictures;
    std::vector<std::uint32_t> picture_of;
    for (const Material& material : materials) {
        const auto known = std::find(pictures.begin(), pictures.end(), material.picture.get());
        picture_of.push_back(material.picture ? static_cast<std::uint32_t>(known - pictures.begin()) : no_id);
        if (material.picture && known == pictures.end()) pictures.push_back(material.picture.get());
    }
    writer.list(pictures, [&](const std::string* picture) { writer.text(*picture); });
    writer.numbers(picture_of);
}

bool get_pictures(Reader& reader, std::vector<Material>& materials) {
    std::vector<std::shared_ptr<const std::string>> pictures;
    reader.list(pictures, [&](auto& picture) {
        picture = std::make_shared<const std::string>(reader.from.get_text());
    });
    std::vector<std::uint32_t> picture_of;
    reader.numbers(picture_of);
    if (picture_of.size() != materials.size()) return false;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        if (picture_of[i] == no_id) continue;
        if (picture_of[i] >= pictures.size()) return false;
        materials[i].picture = pictures[picture_of[i]];
    }
    return true;
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
        put_pictures(writer, answer.scene.soup.materials);
        writer.number(answer.scene.soup.rig != nullptr);
        if (answer.scene.soup.rig) rig_members(writer, std::as_const(*answer.scene.soup.rig));
    }
    return std::move(writer.to.bytes);
}

std::optional<SceneAnswer> answer_from_bytes(std::string_view bytes) {
    Reader reader{ByteReader<Count>(bytes)};
    SceneAnswer answer;
    const auto failed = reader.from.get<std::uint8_t>();
    if (!reader.from.ok || failed > 1) return std::nullopt;
    if (failed == 1) {
        answer.error.emplace();
        reader.text(answer.error->location);
        reader.text(answer.error->message);
    } else {
        members(reader, answer);
        if (!get_pictures(reader, answer.scene.soup.materials)) return std::nullopt;
        if (reader.from.get<bool>()) {
            answer.scene.soup.rig = std::make_shared<Rig>();
            rig_members(reader, *answer.scene.soup.rig);
        }
        const FileFrame& frame = answer.scene.frame;
        if (frame.up > UpAxis::minus_x || frame.up_from > ImportSource::given ||
            frame.scale_from > ImportSource::given)
            return std::nullopt;
    }
    if (!reader.from.ok || !reader.from.at_end()) return std::nullopt;
    return answer;
}

}  // namespace slipface

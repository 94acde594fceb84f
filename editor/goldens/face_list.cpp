#include "goldens/face_list.h"

#include <algorithm>
#include <map>

#include "slipface/base/base64.h"
#include "slipface/base/bytes.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"
#include "slipface/image/pack.h"

namespace slipface {

namespace {

using Writer = ByteWriter<std::uint32_t>;
using Reader = ByteReader<std::uint32_t>;

constexpr std::size_t largest_unpacked = std::size_t{256} << 20U;

// The names of all faces once, ascending.
std::map<std::string, std::uint32_t> name_table(const FaceList& faces) {
    std::map<std::string, std::uint32_t> names;
    for (const FaceFact& face : faces)
        for (const std::string* name : {&face.material, &face.type})
            names.emplace(*name, 0);
    std::uint32_t next = 0;
    for (auto& [name, index] : names)
        index = next++;
    return names;
}

// Coordinate after coordinate: neighbours resemble each other, which packs better than corner after corner.
std::string bytes_of(const FaceList& faces) {
    Writer out;
    const auto names = name_table(faces);
    out.put(static_cast<std::uint32_t>(names.size()));
    for (const auto& [name, index] : names)
        out.put_text(name);
    std::vector<std::uint32_t> materials, types, counts;
    std::array<std::vector<float>, 5> columns;
    for (const FaceFact& face : faces) {
        materials.push_back(names.at(face.material));
        types.push_back(names.at(face.type));
        counts.push_back(static_cast<std::uint32_t>(face.corners.size()));
        for (const auto& corner : face.corners)
            for (std::size_t i = 0; i < columns.size(); ++i)
                columns[i].push_back(corner[i]);
    }
    for (const auto* list : {&materials, &types, &counts})
        out.put_list(*list);
    for (const auto& column : columns)
        out.put_list(column);
    return std::move(out.bytes);
}

std::optional<FaceList> faces_of(std::string_view bytes) {
    Reader in(bytes);
    std::vector<std::string> names;
    for (auto count = in.get<std::uint32_t>(); in.ok && count > 0; --count)
        names.push_back(in.get_text());
    std::array<std::vector<std::uint32_t>, 3> lists;
    for (auto& list : lists)
        list = in.get_list<std::uint32_t>();
    std::array<std::vector<float>, 5> columns;
    for (auto& column : columns)
        column = in.get_list<float>();
    const auto& [materials, types, counts] = lists;
    if (!in.ok || types.size() != materials.size() || counts.size() != materials.size()) return std::nullopt;
    for (const auto& column : columns)
        if (column.size() != columns[0].size()) return std::nullopt;
    FaceList faces;
    std::size_t at = 0;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        if (materials[i] >= names.size() || types[i] >= names.size()) return std::nullopt;
        if (counts[i] > columns[0].size() - at) return std::nullopt;
        FaceFact face{{}, names[materials[i]], names[types[i]]};
        for (std::uint32_t k = 0; k < counts[i]; ++k, ++at)
            face.corners.push_back(
                {columns[0][at], columns[1][at], columns[2][at], columns[3][at], columns[4][at]});
        faces.push_back(std::move(face));
    }
    return faces;
}

}  // namespace

std::string packed_text(std::string_view bytes) {
    return std::to_string(bytes.size()) + ":" + to_base64(pack(bytes), Base64::plain);
}

std::optional<std::string> unpacked_text(const Numbers& json) {
    if (!json.is_string()) return std::nullopt;
    const std::string text = json.get<std::string>();
    const std::size_t colon = text.find(':');
    const auto size = parse_int(std::string_view(text).substr(0, std::min(colon, text.size())));
    if (colon == std::string::npos || !size || *size < 0) return std::nullopt;
    if (static_cast<std::size_t>(*size) > largest_unpacked) return std::nullopt;
    const auto packed = from_base64(std::string_view(text).substr(colon + 1), Base64::plain);
    return packed ? unpack(*packed, static_cast<std::size_t>(*size)) : std::nullopt;
}

Numbers face_list_json(FaceList faces) {
    struct Placed {
        FaceFact face;
        std::uint64_t file, first;  // its place in the file, and of its first corner there
    };
    std::vector<Placed> placed;
    std::size_t corners = 0;
    for (FaceFact& face : faces) {
        for (auto& corner : face.corners)
            for (float& part : corner)
                part += 0.0f;  // -0 is 0
        const auto first = std::min_element(face.corners.begin(), face.corners.end());
        const auto turned = static_cast<std::uint64_t>(first - face.corners.begin());
        std::rotate(face.corners.begin(), first, face.corners.end());
        corners += face.corners.size();
        placed.push_back({std::move(face), placed.size(), turned});
    }
    std::stable_sort(placed.begin(), placed.end(),
                     [](const Placed& a, const Placed& b) { return a.face < b.face; });
    Hasher order, hasher;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        order.u64(placed[i].file);
        order.u64(placed[i].first);
        faces[i] = std::move(placed[i].face);
    }
    const std::string bytes = bytes_of(faces);
    hasher.text(bytes);
    Numbers json = {
        {"faces", faces.size()}, {"hash", hex_text(hasher.value())}, {"order", hex_text(order.value())}};
    if (corners <= max_packed_corners) json["packed"] = packed_text(bytes);
    return json;
}

std::optional<FaceList> face_list_of(const Numbers& json) {
    const auto bytes =
        json.is_object() && json.contains("packed") ? unpacked_text(json["packed"]) : std::nullopt;
    return bytes ? faces_of(*bytes) : std::nullopt;
}

}  // namespace slipface

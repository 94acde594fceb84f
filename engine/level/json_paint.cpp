#include "json_paint.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "json_parts.h"
#include "level_json.h"
#include "packed_faces.h"
#include "slipface/base/base64.h"

namespace slipface {
namespace {

// The name, and four that are 0: in older files, from where on the object's vertices are numbered.
constexpr std::size_t object_bytes = 7;

// A row for each part, or all of them in one string.
void read_objects(const JsonNode& node, PaintParts& parts) {
    std::string bytes;
    const auto add = [&](const JsonNode& row) {
        std::string more;
        if (row.base64("the object of each part", more)) bytes += more;
    };
    if (node.json().kind == Json::Kind::string)
        add(node);
    else
        node.each(max_paint_parts, add);
    if (node && bytes.size() != object_bytes * parts.parts.size())
        node.fail("the object of each part, as base64");
    if (!node) return;
    const char* at = bytes.data();
    for (PaintPart& part : parts.parts) {
        part.object = static_cast<std::uint32_t>(take_bytes(at, 3));
        const auto first = static_cast<std::uint32_t>(take_bytes(at, 4));
        for (std::uint32_t& number : part.numbers)
            number -= first;
    }
}

// A row for each, so that a link to a run has few rows that differ.
Json object_json(const PaintPart& part) {
    std::string bytes;
    put_bytes(bytes, part.object, object_bytes);
    return json_string(to_base64(bytes, Base64::plain));
}

// Rows of base64. The faces' hashes alone decide where rows begin, so painting one more face changes one row.
template <class Add>
Json rows_json(const std::vector<FaceKey>& keys, const std::vector<std::size_t>& order, const Add& add) {
    constexpr std::uint64_t faces_per_row = 64;  // on average
    Json rows = json_array();
    std::string bytes;
    for (std::size_t k = 0; k < order.size(); ++k) {
        add(order[k], bytes);
        if (k + 1 < order.size() && keys[order[k + 1]].loop_hash % faces_per_row != 0) continue;
        rows.items.push_back(json_string(to_base64(bytes, Base64::plain)));
        bytes.clear();
    }
    return rows;
}

Json outlines_json(const std::vector<FaceKey>& keys, const FaceOutlines& outlines,
                   const std::vector<std::size_t>& order) {
    return rows_json(keys, order, [&](std::size_t i, std::string& bytes) { bytes += outlines.bytes(i); });
}

// "outlines" has fewer bytes per face, in an older file.
void read_outlines(const JsonNode& parts, std::size_t count, FaceOutlines& outlines) {
    const JsonNode old = parts["outlines"], node = old ? old : parts["corners"];
    if (old) outlines = FaceOutlines(true);
    std::string bytes;
    node.each(max_json_values, [&](const JsonNode& row) {
        if (row.base64("outlines of faces", bytes) && !outlines.add_bytes(bytes))
            row.fail("outlines of faces, as base64");
    });
    if (outlines.count() != count) outlines = {};
}

// 1 for all if there is none. False if it has not as many as there are faces.
bool read_part_of_each(const JsonNode& node, std::size_t count, std::vector<std::uint16_t>& of) {
    std::string bytes;
    of.assign(count, 1);
    if (!node.base64("a part for each face", bytes)) return true;
    const bool as_many = bytes.size() == 2 * count;
    bytes.resize(2 * count);
    const char* at = bytes.data();
    for (std::uint16_t& part : of)
        part = static_cast<std::uint16_t>(take_bytes(at, 2));
    return as_many;
}

UnpaintedFaces read_unpainted(const JsonNode& node) {
    UnpaintedFaces faces;
    std::vector<StoredOverride> stored;
    node["groups"].each(max_json_values, [&](const JsonNode& group) {
        StoredOverride face;
        if (!group.object()) return;
        group["material"].text(face.key.material);
        read_face_rows(group, std::move(face), stored);
    });
    for (StoredOverride& one : stored)
        faces.keys.push_back(std::move(one.key));
    const bool as_many = read_part_of_each(node["of"], stored.size(), faces.of);
    read_outlines(node, stored.size(), faces.outlines);
    return as_many && faces.outlines.count() == stored.size() ? faces : UnpaintedFaces();
}

void add_part_of_each(Json& json, const std::vector<std::uint16_t>& of,
                      const std::vector<std::size_t>& order) {
    if (std::all_of(of.begin(), of.end(), [](std::uint16_t part) { return part == 1; })) return;
    std::string bytes;
    for (const std::size_t i : order)
        put_bytes(bytes, of[i], 2);
    json_add(json, "of", json_string(to_base64(bytes, Base64::plain)));
}

// Of the number of a token, if there are so many.
std::size_t number_bytes(std::size_t tokens) {
    return (static_cast<std::size_t>(std::bit_width(tokens)) + 7) / 8;
}

Json token_numbers_json(const std::vector<std::uint32_t>& numbers, std::size_t tokens,
                        const std::vector<FaceKey>& keys, const std::vector<std::size_t>& order) {
    return rows_json(keys, order, [&](std::size_t i, std::string& bytes) {
        put_bytes(bytes, numbers[i], number_bytes(tokens));
    });
}

// False unless there is a token for each of the faces, at its place.
template <class KeyOf>
bool read_token_numbers(const JsonNode& node, std::size_t count, const KeyOf& key_of,
                        const MeshTokens& tokens, std::vector<std::uint32_t>& numbers) {
    std::string bytes, row_bytes;
    numbers.clear();
    node.each(max_json_values, [&](const JsonNode& row) {
        if (row.base64("the tokens of faces", row_bytes)) bytes += row_bytes;
    });
    const std::size_t width = number_bytes(tokens.faces.size());
    if (bytes.size() != width * count) return false;
    const char* at = bytes.data();
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t number = take_bytes(at, width);
        if (number >= tokens.faces.size()) return false;
        numbers.push_back(static_cast<std::uint32_t>(number));
        const TokenObject& object = tokens.objects[tokens.object[numbers.back()]];
        const Vec3 away = key_of(i).centroid - tokens.faces[numbers.back()].position.template cast<double>();
        if ((away.cwiseAbs().array() > object.step.template cast<double>().array()).any()) return false;
    }
    return true;
}

// Tokens of other paint or geometry, which another program kept, do not fit: they are left out.
void read_tokens(const JsonNode& node, std::span<const StoredOverride> painted, PaintParts& parts) {
    MeshTokens& tokens = parts.tokens;
    bool fit = true;
    std::string bytes;
    const auto take = [&](const JsonNode& list, bool (*unpack)(std::string_view, MeshTokens&)) {
        list.each(max_json_values, [&](const JsonNode& row) {
            if (row.base64("tokens of faces", bytes)) fit = fit && unpack(bytes, tokens);
        });
    };
    const JsonNode objects = node["objects"], rows = node["rows"], of_painted = node["painted"],
                   of_unpainted = node["unpainted"];
    take(objects, unpack_token_objects);
    take(rows, unpack_tokens);
    std::size_t count = 0;
    for (const TokenObject& object : tokens.objects)
        count += object.count;
    const UnpaintedFaces& unpainted = parts.unpainted;
    const auto painted_key = [&](std::size_t i) -> const FaceKey& { return painted[i].key; };
    const auto unpainted_key = [&](std::size_t i) -> const FaceKey& { return unpainted.keys[i]; };
    if (fit && count == tokens.faces.size() && count > 0 &&
        read_token_numbers(of_painted, painted.size(), painted_key, tokens, parts.token) &&
        read_token_numbers(of_unpainted, unpainted.keys.size(), unpainted_key, tokens, parts.unpainted.token))
        return;
    tokens = {};
    parts.token.clear();
    parts.unpainted.token.clear();
}

std::uint64_t hash_of_paint(std::span<const StoredOverride> painted) {
    std::vector<const FaceKey*> keys;
    for (const StoredOverride& one : painted)
        keys.push_back(&one.key);
    return hash_of_keys(keys);
}

std::string hash_text(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

}  // namespace

void read_face_rows(const JsonNode& group, StoredOverride stored, std::vector<StoredOverride>& to) {
    group.need("faces").each(max_json_values, [&](const JsonNode& row) {
        stored.key.copy = 0;
        stored.location = row.location();
        if (row.json().kind == Json::Kind::string && parse_face_row(row.json().text, stored.key))
            to.push_back(stored);
        else
            row.fail(
                "\"HASH X,Y,Z NX,NY,NZ AREA\" with 16 hexadecimal digits, a point, a unit normal and an "
                "area");
    });
    std::vector<FaceKey> keys;
    group["packed"].each(max_json_values, [&](const JsonNode& row) {
        keys.clear();
        if (row.json().kind != Json::Kind::string || !unpack_faces(row.json().text, keys))
            row.fail("painted faces, 23 bytes each, as base64");
        for (FaceKey& key : keys) {
            key.material = stored.key.material;
            to.push_back({std::move(key), stored.type, row.location()});
        }
    });
}

std::optional<PaintParts> read_paint_parts(const JsonNode& node, std::span<const StoredOverride> painted) {
    const JsonNode paint = node.need("paint"), box = node.need("box"), list = node.need("list");
    std::string hash, bytes;
    std::vector<Vec3> corners;
    PaintParts parts;
    paint.text(hash);
    box.each(2, [&](const JsonNode& corner) {
        corner.vector(-farthest_position, farthest_position, corners.emplace_back(Vec3::Zero()));
    });
    if (box && corners.size() != 2) box.fail("two corners");
    list.each(max_paint_parts, [&](const JsonNode& part) {
        if (part.json().kind != Json::Kind::string ||
            !unpack_part(part.json().text, parts.parts.emplace_back()))
            part.fail("a part of the geometry, as base64");
    });
    if (!node || corners.size() != 2) return std::nullopt;
    parts.bounds = {corners[0], corners[1]};
    const bool as_many = read_part_of_each(node["of"], painted.size(), parts.of);
    std::size_t read = 0;
    node["numbers"].each(max_paint_parts, [&](const JsonNode& row) {
        const std::size_t i = read++;
        if (i >= parts.parts.size()) return;
        if (row.json().kind != Json::Kind::string ||
            !unpack_numbers(row.json().text, list.json().items[i].text, parts.parts[i]))
            row.fail("the numbers of a part's vertices, as base64");
    });
    if (const JsonNode objects = node["objects"]) read_objects(objects, parts);
    read_outlines(node, painted.size(), parts.outlines);
    if (const JsonNode unpainted = node["unpainted"]) parts.unpainted = read_unpainted(unpainted);
    if (node["guessed"].base64("a bit for each painted face", bytes)) {
        parts.guessed.resize(painted.size());
        for (std::size_t i = 0; i < std::min(painted.size(), 8 * bytes.size()); ++i)
            parts.guessed[i] = (bytes[i / 8] >> i % 8 & 1) != 0;
    }
    if (const JsonNode tokens = node["tokens"]) read_tokens(tokens, painted, parts);
    // Not before all members are read: those that nobody reads are unknown ones, which are kept.
    if (!as_many || hash != hash_text(hash_of_paint(painted))) return std::nullopt;
    return parts;
}

Json paint_parts_json(const std::vector<FaceKey>& keys, const PaintParts& parts,
                      const std::vector<std::size_t>& order) {
    Json json = json_object();
    std::vector<const FaceKey*> written;
    for (const std::size_t i : order)
        written.push_back(&keys[i]);
    json_add(json, "paint", json_string(hash_text(hash_of_keys(written))));
    Json box = json_array();
    for (const Vec3& corner : {parts.bounds.min, parts.bounds.max})
        box.items.push_back(vector_json(corner));
    json_add(json, "box", std::move(box));
    add_part_of_each(json, parts.of, order);
    json_add(json, "list",
             json_array_of(parts.parts, [](const PaintPart& part) { return json_string(pack_part(part)); }));
    Json numbers = json_array_of(
        parts.parts, [](const PaintPart& part) { return json_string(pack_numbers(part, pack_part(part))); });
    // Painted parts come first.
    while (!numbers.items.empty() && numbers.items.back().text.empty())
        numbers.items.pop_back();
    json_add(json, "numbers", std::move(numbers));
    json_add(json, "objects", json_array_of(parts.parts, object_json));
    json_add(json, "corners", outlines_json(keys, parts.outlines, order));
    std::string bits((order.size() + 7) / 8, '\0');
    for (std::size_t k = 0; k < order.size(); ++k)
        if (parts.guessed[order[k]]) bits[k / 8] = static_cast<char>(bits[k / 8] | 1 << k % 8);
    if (bits.find_first_not_of('\0') != std::string::npos)
        json_add(json, "guessed", json_string(to_base64(bits, Base64::plain)));
    return json;
}

Json tokens_json(const std::vector<FaceKey>& keys, const PaintParts& parts,
                 const std::vector<std::size_t>& order, const std::vector<std::size_t>& unpainted_order) {
    // In rows, so that an edit of one object changes one.
    constexpr std::size_t longest_row = 32 * bytes_per_object;
    const MeshTokens& tokens = parts.tokens;
    const std::string objects = pack_token_objects(tokens);
    Json object_rows = json_array();
    for (std::size_t at = 0; at < objects.size(); at += longest_row)
        object_rows.items.push_back(
            json_string(to_base64(std::string_view(objects).substr(at, longest_row), Base64::plain)));
    Json json = json_object({{"objects", std::move(object_rows)}});
    json_add(json, "rows", json_array_of(pack_tokens(tokens), [](const std::string& row) {
                 return json_string(to_base64(row, Base64::plain));
             }));
    json_add(json, "painted", token_numbers_json(parts.token, tokens.faces.size(), keys, order));
    if (!unpainted_order.empty())
        json_add(json, "unpainted",
                 token_numbers_json(parts.unpainted.token, tokens.faces.size(), parts.unpainted.keys,
                                    unpainted_order));
    return json;
}

Json unpainted_json(const UnpaintedFaces& faces, const std::vector<std::size_t>& order, Json groups) {
    Json json = json_object({{"groups", std::move(groups)}});
    add_part_of_each(json, faces.of, order);
    json_add(json, "corners", outlines_json(faces.keys, faces.outlines, order));
    return json;
}

}  // namespace slipface

// Painted faces in the level file: rows of faces, and "parts", what a search for them needs.
//
//   "parts": {"paint": hash of the painted faces, "box": of the whole mesh,
//             "of": each painted face's part, "list": each part (pack_part()), "numbers": its vertices
//             (pack_numbers()), "objects": its object, "corners": the outlines of the painted faces,
//             "guessed": a bit for each, "tokens": of all faces (face_tokens.h): {"objects", "rows",
//             "painted": the number of each
//                       painted face's token, "unpainted": of each unpainted one below},
//             "unpainted": {"groups": faces that lie on painted ones, "of", "corners": as above}}
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "face_match.h"
#include "json_reader.h"

namespace slipface {

// Appends the faces of a group, `stored` but for their keys.
void read_face_rows(const JsonNode& group, StoredOverride stored, std::vector<StoredOverride>& to);

// Of the painted faces in the file's order. None if the parts are those of other paint: another program may
// have changed the painted faces and kept this member, which it does not know.
std::optional<PaintParts> read_paint_parts(const JsonNode& node, std::span<const StoredOverride> painted);

// `order`: the keys' indices in the file's order.
Json paint_parts_json(const std::vector<FaceKey>& keys, const PaintParts& parts,
                      const std::vector<std::size_t>& order);

// The member "tokens" of the parts. `order`: of `keys`; `unpainted_order`: of the unpainted faces.
Json tokens_json(const std::vector<FaceKey>& keys, const PaintParts& parts,
                 const std::vector<std::size_t>& order, const std::vector<std::size_t>& unpainted_order);

// `order`: of their keys. `groups`: their rows.
Json unpainted_json(const UnpaintedFaces& faces, const std::vector<std::size_t>& order, Json groups);

}  // namespace slipface

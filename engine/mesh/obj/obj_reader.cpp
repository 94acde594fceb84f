#include "obj/obj_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <unordered_map>

#include "obj/obj_part.h"
#include "obj/obj_text.h"
#include "slipface/base/parallel.h"

namespace slipface {
namespace {

constexpr std::size_t bytes_per_part = std::size_t{1} << 19;
constexpr std::size_t max_obj_faces = std::size_t{1} << 26;

// Lines that `\` continues become one. Returns whether there are any.
bool join_continued_lines(std::string& text) {
    if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
    if (text.find('\\') == std::string::npos) return false;
    std::replace(text.begin(), text.end(), obj_joint, ' ');
    const std::string before = text;
    LineReader lines(text);
    while (lines.next()) {
    }
    for (std::size_t i = 0; i < text.size(); ++i)
        if (before[i] == '\n' && text[i] == ' ') text[i] = obj_joint;
    return true;
}

std::vector<ObjPart> split_into_parts(std::string_view text, const WarningList& warnings) {
    std::vector<ObjPart> parts;
    while (!text.empty()) {
        std::size_t size = std::min(bytes_per_part, text.size());
        const std::size_t newline = text.find('\n', size - 1);
        size = newline == std::string_view::npos ? text.size() : newline + 1;
        parts.push_back({.text = text.substr(0, size), .warnings = warnings.empty_copy()});
        text.remove_prefix(size);
    }
    return parts;
}

// Numbers names in the order in which faces first use them. A name without a face gets no number.
class NameTable {
  public:
    void set(NameOnLine name) {
        if (name.name == current_.name) return;
        current_ = std::move(name);
        index_ = no_id;
    }

    std::uint32_t index() {
        if (index_ != no_id) return index_;
        const auto [slot, added] =
            known_.try_emplace(current_.name, static_cast<std::uint32_t>(list_.size()));
        if (added) list_.push_back(current_);
        return index_ = slot->second;
    }

    std::vector<NameOnLine> take() { return std::move(list_); }

  private:
    NameOnLine current_;
    std::uint32_t index_ = no_id;
    std::unordered_map<std::string, std::uint32_t> known_;
    std::vector<NameOnLine> list_;
};

// Goes through the names in the order of the file and assigns them to the faces.
class NameJoiner {
  public:
    explicit NameJoiner(ObjPolygons& out) : out_(out) {}

    void add(ObjPart& part) {
        std::size_t face = 0;
        for (ObjName& event : part.events) {
            fill(event.face - face);
            face = event.face;
            NameOnLine name{std::move(event.name), event.line};
            switch (event.kind) {
                case ObjName::Kind::material: materials_.set(std::move(name)); break;
                case ObjName::Kind::group: groups_.set(std::move(name)); break;
                case ObjName::Kind::library: out_.libraries.push_back(std::move(name)); break;
            }
        }
        fill(part.face_corners.size() - face);
    }

    void finish() {
        out_.materials = materials_.take();
        for (NameOnLine& group : groups_.take())
            out_.soup.groups.push_back(std::move(group.name));
    }

  private:
    void fill(std::size_t faces) {
        if (faces == 0) return;
        out_.soup.face_material.insert(out_.soup.face_material.end(), faces, materials_.index());
        out_.soup.face_group.insert(out_.soup.face_group.end(), faces, groups_.index());
    }

    ObjPolygons& out_;
    NameTable materials_, groups_;
};

void join_faces(std::vector<ObjPart>& parts, ObjPolygons& out) {
    std::size_t faces = 0;
    for (const ObjPart& part : parts)
        faces += part.face_corners.size();
    PolygonSoup& soup = out.soup;
    soup.face_first_corner.reserve(faces + 1);
    soup.face_material.reserve(faces);
    soup.face_group.reserve(faces);
    soup.face_first_corner.push_back(0);
    NameJoiner names(out);
    for (ObjPart& part : parts) {
        for (const std::uint32_t count : part.face_corners)
            soup.face_first_corner.push_back(soup.face_first_corner.back() + count);
        names.add(part);
    }
    names.finish();
}

void join_corners(std::vector<ObjPart>& parts, const std::vector<Vec2f>& uvs, PolygonSoup& soup) {
    std::vector<std::size_t> first(parts.size() + 1, 0);
    for (std::size_t i = 0; i < parts.size(); ++i)
        first[i + 1] = first[i] + parts[i].corner_v.size();
    soup.corner_vertex.resize(first.back());
    const bool textured = !uvs.empty();
    if (textured) soup.corner_uv.resize(first.back());
    parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::vector<std::uint32_t> corner_v = std::move(parts[i].corner_v),
                                             corner_vt = std::move(parts[i].corner_vt);
            std::copy(corner_v.begin(), corner_v.end(),
                      soup.corner_vertex.begin() + static_cast<std::ptrdiff_t>(first[i]));
            for (std::size_t k = 0; k < corner_vt.size(); ++k) {
                const std::uint32_t vt = corner_vt[k];
                soup.corner_uv[first[i] + k] = vt == no_id ? Vec2f(0, 0) : uvs[vt];
            }
        }
    });
}

// Reads every part on all cores. After an error only the parts before it go on, so that the first error of
// the file is found whatever the order of the threads.
std::optional<Error> read_parts(std::vector<ObjPart>& parts, ObjReading& reading, Progress* progress) {
    std::atomic<std::size_t> done = 0, first_wrong = parts.size();
    parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !cancelled(progress); ++i) {
            if (i > first_wrong) continue;
            if (!read_part(reading, parts[i])) {
                std::size_t wrong = first_wrong;
                while (i < wrong && !first_wrong.compare_exchange_weak(wrong, i)) {
                }
            }
            advance(progress, static_cast<double>(++done) / static_cast<double>(parts.size()));
        }
    });
    if (first_wrong == parts.size()) return std::nullopt;
    return parts[first_wrong].error;
}

Result<ObjPolygons> read_text(std::string text, const std::string& location, WarningList& warnings,
                              Progress* progress) {
    ObjReading reading{.location = location, .continued = join_continued_lines(text)};
    std::string_view rest = text;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    std::vector<ObjPart> parts = split_into_parts(rest, warnings);
    std::vector<ObjCounts> counts(parts.size());
    parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            counts[i] = count_statements(parts[i], reading);
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i].before = reading.total;
        reading.total += counts[i];
    }
    if (std::max(reading.total.of[of_v], reading.total.of[of_vt]) >= no_id)
        return Error{location, fmt::format("has more than {} vertices", no_id)};

    reading.positions.resize(static_cast<std::size_t>(reading.total.of[of_v]));
    reading.uvs.resize(static_cast<std::size_t>(reading.total.of[of_vt]));
    if (const auto error = read_parts(parts, reading, progress)) return *error;
    ObjPolygons out;
    for (ObjPart& part : parts)
        warnings.append(part.warnings);
    join_faces(parts, out);
    if (out.soup.face_material.empty()) return Error{location, "has no faces"};
    if (out.soup.face_material.size() > max_obj_faces)
        return Error{location, fmt::format("has more than {} faces", max_obj_faces)};
    out.soup.vertex_position = std::move(reading.positions);
    join_corners(parts, reading.uvs, out.soup);
    return out;
}

}  // namespace

Result<ObjPolygons> read_obj(std::string bytes, const std::string& location, WarningList& warnings,
                             Progress* progress) {
    std::string text = text_of_file(std::move(bytes));
    if (text.empty()) return Error{location, "is empty; expected an OBJ file"};
    const std::size_t at = find_binary(text);
    if (at == std::string::npos) return read_text(std::move(text), location, warnings, progress);
    // In a comment or a name such a byte does no harm. If something is wrong besides, the file is no OBJ at
    // all.
    const std::string where = fmt::format("{}:{}", location, line_of(text, at)),
                      what = fmt::format("byte 0x{:02X} is not text", static_cast<unsigned char>(text[at]));
    const std::size_t count = replace_binary(text);
    Result<ObjPolygons> read = read_text(std::move(text), location, warnings, progress);
    if (!read) return Error{where, what + "; expected an OBJ file"};
    warnings.add(where, "a byte that is not text: read as '?'", count);
    return read;
}

}  // namespace slipface

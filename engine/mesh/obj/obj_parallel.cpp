#include "obj/obj_parallel.h"

#include <assimp/fast_atof.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <unordered_map>

#include "obj/obj_text.h"
#include "slipface/base/parallel.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::size_t bytes_per_part = std::size_t{1} << 19;

// Assimp's number reader throws this for text that is not a number; read_number() has already excluded that.
struct NoNumber {
    template <class... Parts>
    explicit NoNumber(Parts&&...) {}
};

bool is_blank(char c) {
    return c == ' ' || c == '\t';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// Reads the words of one line. Every function moves `at` and returns false for anything unusual.
struct LineCursor {
    const char* at;
    const char* end;

    void skip_blanks() {
        while (at != end && is_blank(*at))
            ++at;
    }
    bool at_end() const { return at == end; }
    bool at_word_end() const { return at == end || is_blank(*at); }

    // At most 15 digits, so that a double can hold the value.
    bool digits(std::uint64_t& value, int& count) {
        const char* const begin = at;
        value = 0;
        while (at != end && is_digit(*at))
            value = value * 10 + static_cast<std::uint64_t>(*at++ - '0');
        count = static_cast<int>(at - begin);
        return count > 0 && count <= 15;
    }

    bool number(float& value) {
        skip_blanks();
        const char* const begin = at;
        const bool negative = at != end && *at == '-';
        if (negative) ++at;
        std::uint64_t whole = 0;
        std::uint64_t part = 0;
        int count = 0;
        bool simple = digits(whole, count) && whole < static_cast<std::uint64_t>(largest_obj_coordinate);
        auto sum = static_cast<float>(whole);
        if (simple && at != end && *at == '.') {
            ++at;
            simple = digits(part, count);
            // The same operations as in assimp, in its order: the whole number, the decimals and their sum
            // are rounded.
            if (simple) sum += static_cast<float>(static_cast<double>(part) * Assimp::fast_atof_table[count]);
        }
        if (!simple || !at_word_end()) {
            at = begin;
            return rare_number(value);
        }
        value = negative ? -sum : sum;
        return true;
    }

    // Exponents, many digits, numbers that begin or end with a point.
    bool rare_number(float& value) {
        const char* const begin = at;
        while (!at_word_end())
            ++at;
        const std::string_view word(begin, static_cast<std::size_t>(at - begin));
        const auto number = read_number(word);
        if (!number || !(std::abs(*number) <= largest_obj_coordinate)) return false;
        const std::string text = copies_obj_number(word) ? std::string(word) : to_text(*number);
        value = Assimp::fast_atof<NoNumber>(text.c_str());
        return true;
    }

    // Reads an index from 1 to `count`, or from -1 to -`known`, which counts back from the last one so far.
    bool index(std::int64_t known, std::int64_t count, std::uint32_t& value) {
        const bool negative = at != end && *at == '-';
        if (negative) ++at;
        std::uint64_t number = 0;
        int length = 0;
        if (!digits(number, length)) return false;
        const auto signed_number = static_cast<std::int64_t>(number);
        const std::int64_t result = negative ? known + 1 - signed_number : signed_number;
        if (result < 1 || result > count) return false;
        value = static_cast<std::uint32_t>(result - 1);
        return true;
    }
};

// Numbers of statements in a part of the text, or in all text before it.
struct Counts {
    std::int64_t line = 0, v = 0, vt = 0, vn = 0;
    Counts& operator+=(const Counts& other) {
        line += other.line;
        v += other.v;
        vt += other.vt;
        vn += other.vn;
        return *this;
    }
};

struct NameEvent {
    enum class Kind : std::uint8_t { material, group, library };
    Kind kind;
    std::size_t face;  // index of the next face in the part
    std::size_t line;
    std::string_view name;
};

// A range of whole lines.
struct Part {
    std::string_view text;
    Counts before;
    std::vector<std::uint32_t> corner_v, corner_vt;  // from 0; no_id: no texture coordinate
    std::vector<std::uint32_t> face_corners;
    std::vector<NameEvent> events;
};

std::vector<Part> split_into_parts(std::string_view text) {
    std::vector<Part> parts;
    while (!text.empty()) {
        std::size_t size = std::min(bytes_per_part, text.size());
        const std::size_t newline = text.find('\n', size - 1);
        size = newline == std::string_view::npos ? text.size() : newline + 1;
        parts.emplace_back().text = text.substr(0, size);
        text.remove_prefix(size);
    }
    return parts;
}

// Calls visit(begin, end) for every line, without surrounding blanks and line end, until one call returns
// false.
template <class Visit>
bool for_each_line(std::string_view text, const Visit& visit) {
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at != end) {
        const auto* newline =
            static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(end - at)));
        const char* last = newline != nullptr ? newline : end;
        const char* const next = newline != nullptr ? newline + 1 : end;
        if (last != at && last[-1] == '\r') --last;
        while (at != last && is_blank(*at))
            ++at;
        while (last != at && is_blank(last[-1]))
            --last;
        if (!visit(at, last)) return false;
        at = next;
    }
    return true;
}

Counts count_statements(std::string_view text) {
    Counts counts;
    for_each_line(text, [&](const char* begin, const char* end) {
        ++counts.line;
        if (begin == end || *begin != 'v') return true;
        if (end - begin == 1 || is_blank(begin[1])) {
            ++counts.v;
            return true;
        }
        if (begin[1] == 't') ++counts.vt;
        if (begin[1] == 'n') ++counts.vn;
        return true;
    });
    return counts;
}

class PartReader {
  public:
    PartReader(Part& part, const Counts& total, std::vector<Vec3f>& positions, std::vector<Vec2f>& uvs)
        : part_(part), total_(total), seen_(part.before), positions_(positions), uvs_(uvs) {}

    bool run() {
        return for_each_line(part_.text, [this](const char* begin, const char* end) {
            ++seen_.line;
            if (static_cast<std::size_t>(end - begin) > longest_obj_line) return false;
            return begin == end || *begin == '#' || read_line({begin, end});
        });
    }

  private:
    bool read_line(LineCursor line) {
        if (line.end[-1] == '\\') return false;
        const char* const begin = line.at;
        while (!line.at_word_end())
            ++line.at;
        const std::string_view keyword(begin, static_cast<std::size_t>(line.at - begin));
        if (keyword == "v") return read_vertex(line);
        if (keyword == "f") return read_face(line);
        if (keyword == "vt") return read_uv(line);
        if (keyword == "vn") return ++seen_.vn, true;
        if (keyword == "s") return true;
        if (keyword == "usemtl") return read_name(line, NameEvent::Kind::material);
        if (keyword == "g" || keyword == "o") return read_name(line, NameEvent::Kind::group);
        if (keyword == "mtllib") return read_name(line, NameEvent::Kind::library);
        return false;
    }

    // Colours that some tools write after the coordinates are ignored.
    bool read_vertex(LineCursor line) {
        Vec3f& position = positions_[static_cast<std::size_t>(seen_.v++)];
        return line.number(position[0]) && line.number(position[1]) && line.number(position[2]);
    }

    bool read_uv(LineCursor line) {
        Vec2f& uv = uvs_[static_cast<std::size_t>(seen_.vt++)];
        return line.number(uv[0]) && line.number(uv[1]);
    }

    bool read_face(LineCursor line) {
        const std::size_t first = part_.corner_v.size();
        for (line.skip_blanks(); !line.at_end(); line.skip_blanks())
            if (!read_corner(line)) return false;
        const std::size_t count = part_.corner_v.size() - first;
        if (count < 3 || !has_three_different(first)) return false;
        part_.face_corners.push_back(static_cast<std::uint32_t>(count));
        return true;
    }

    bool read_corner(LineCursor& line) {
        std::uint32_t v = 0;
        std::uint32_t vt = no_id;
        std::uint32_t vn = 0;
        if (!line.index(seen_.v, total_.v, v)) return false;
        if (!line.at_end() && *line.at == '/') {
            ++line.at;
            if (!line.at_end() && *line.at != '/' && !line.index(seen_.vt, total_.vt, vt)) return false;
            if (!line.at_end() && *line.at == '/') {
                ++line.at;
                if (!line.index(seen_.vn, total_.vn, vn)) return false;
            }
        }
        part_.corner_v.push_back(v);
        if (total_.vt > 0) part_.corner_vt.push_back(vt);
        return line.at_word_end();
    }

    bool has_three_different(std::size_t first) const {
        const std::uint32_t a = part_.corner_v[first];
        std::uint32_t b = a;
        for (std::size_t i = first + 1; i < part_.corner_v.size(); ++i) {
            const std::uint32_t c = part_.corner_v[i];
            if (c == a || c == b) continue;
            if (b != a) return true;
            b = c;
        }
        return false;
    }

    bool read_name(LineCursor line, NameEvent::Kind kind) {
        line.skip_blanks();
        const std::string_view name(line.at, static_cast<std::size_t>(line.end - line.at));
        bool converted = false;
        utf8_name(name, converted);
        if (converted || name != trim(name)) return false;
        part_.events.push_back({kind, part_.face_corners.size(), static_cast<std::size_t>(seen_.line), name});
        return true;
    }

    Part& part_;
    const Counts total_;
    Counts seen_;
    std::vector<Vec3f>& positions_;
    std::vector<Vec2f>& uvs_;
};

// Goes through the names in the order of the file and assigns them to the faces.
class NameJoiner {
  public:
    explicit NameJoiner(ObjPolygons& out) : out_(out) {}

    void add(const Part& part) {
        std::size_t face = 0;
        for (const NameEvent& event : part.events) {
            fill(event.face - face);
            face = event.face;
            const NameOnLine name{std::string(event.name), event.line};
            switch (event.kind) {
                case NameEvent::Kind::material:
                    materials_.set(name.name, name.line);
                    break;
                case NameEvent::Kind::group:
                    groups_.set(name.name, name.line);
                    break;
                case NameEvent::Kind::library:
                    out_.libraries.push_back(name);
                    break;
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

void join_faces(const std::vector<Part>& parts, ObjPolygons& out) {
    std::size_t faces = 0;
    for (const Part& part : parts)
        faces += part.face_corners.size();
    PolygonSoup& soup = out.soup;
    soup.face_first_corner.reserve(faces + 1);
    soup.face_material.reserve(faces);
    soup.face_group.reserve(faces);
    soup.face_first_corner.push_back(0);
    NameJoiner names(out);
    for (const Part& part : parts) {
        for (const std::uint32_t count : part.face_corners)
            soup.face_first_corner.push_back(soup.face_first_corner.back() + count);
        names.add(part);
    }
    names.finish();
}

void join_corners(std::vector<Part>& parts, const std::vector<Vec2f>& uvs, PolygonSoup& soup) {
    std::vector<std::size_t> first(parts.size() + 1, 0);
    for (std::size_t i = 0; i < parts.size(); ++i)
        first[i + 1] = first[i] + parts[i].corner_v.size();
    soup.corner_vertex.resize(first.back());
    const bool textured = !uvs.empty();
    if (textured) soup.corner_uv.resize(first.back());
    parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::copy(parts[i].corner_v.begin(), parts[i].corner_v.end(),
                      soup.corner_vertex.begin() + static_cast<std::ptrdiff_t>(first[i]));
            for (std::size_t k = 0; k < parts[i].corner_vt.size(); ++k) {
                const std::uint32_t vt = parts[i].corner_vt[k];
                soup.corner_uv[first[i] + k] = vt == no_id ? Vec2f(0, 0) : uvs[vt];
            }
            parts[i] = {};
        }
    });
}

// Runs body(part) for every part on all cores. Returns false if one call does or the task is cancelled.
template <class Body>
bool all_parts(std::vector<Part>& parts, Progress* progress, const Body& body) {
    std::atomic<bool> fine = true;
    std::atomic<std::size_t> done = 0;
    parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && fine; ++i) {
            if (cancelled(progress) || !body(parts[i])) fine = false;
            advance(progress, static_cast<double>(++done) / static_cast<double>(parts.size()));
        }
    });
    return fine;
}

}  // namespace

std::optional<ObjPolygons> read_ordinary_obj(std::string_view text, Progress* progress) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.find('\n') == std::string_view::npos) return std::nullopt;
    std::vector<Part> parts = split_into_parts(text);
    std::vector<Counts> counts(parts.size());
    const bool all_text = all_parts(parts, nullptr, [&](Part& part) {
        counts[static_cast<std::size_t>(&part - parts.data())] = count_statements(part.text);
        return find_binary(part.text) == std::string_view::npos;
    });
    if (!all_text) return std::nullopt;
    Counts total;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i].before = total;
        total += counts[i];
    }
    if (total.v >= no_id || total.vt >= no_id) return std::nullopt;

    ObjPolygons out;
    out.soup.vertex_position.resize(static_cast<std::size_t>(total.v));
    std::vector<Vec2f> uvs(static_cast<std::size_t>(total.vt));
    const bool ordinary = all_parts(parts, progress, [&](Part& part) {
        return PartReader(part, total, out.soup.vertex_position, uvs).run();
    });
    if (!ordinary) return std::nullopt;
    join_faces(parts, out);
    if (out.soup.face_material.empty() || out.soup.face_material.size() > max_obj_faces) return std::nullopt;
    join_corners(parts, uvs, out.soup);
    return out;
}

}  // namespace slipface

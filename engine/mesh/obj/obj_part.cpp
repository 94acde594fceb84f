#include "obj/obj_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "obj/obj_cursor.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::size_t longest_obj_line = std::size_t{1} << 20;

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
        while (at != last && is_blank(*at))
            ++at;
        while (last != at && is_blank(last[-1]))
            --last;
        if (!visit(at, last)) return false;
        at = next;
    }
    return true;
}

class PartReader {
  public:
    PartReader(ObjReading& reading, ObjPart& part) : all_(reading), part_(part), seen_(part.before) {}

    bool run() {
        return for_each_line(part_.text, [this](const char* begin, const char* end) {
            line_ = ++seen_.line;
            const bool fine = begin == end || *begin == '#' || read_line({begin, end});
            if (all_.continued) seen_.line += std::count(begin, end, obj_joint);
            return fine;
        });
    }

  private:
    bool read_line(LineCursor line) {
        const bool is_long = line.rest().size() > longest_obj_line;
        const std::string_view keyword = line.word();
        if (keyword == "v") return is_long ? refuse_long() : read_vertex(line);
        if (keyword == "f" || keyword == "fo") return is_long ? refuse_long() : read_face(line);
        if (keyword == "vt") return read_uv(line);
        if (keyword == "vn") {
            ++seen_.of[of_vn];
        } else if (is_long) {
            warn([&] {
                return fmt::format("the line has more than {} characters: ignored", longest_obj_line);
            });
        } else if (keyword == "usemtl") {
            read_name(line, ObjName::Kind::material);
        } else if (keyword == "g" || keyword == "o") {
            read_name(line, ObjName::Kind::group);
        } else if (keyword == "mtllib") {
            read_name(line, ObjName::Kind::library);
        } else if (keyword == "l" || keyword == "p") {
            warn([&] {
                return fmt::format("{} are no surface: dropped", keyword == "l" ? "lines" : "points");
            });
        } else if (keyword != "s" && keyword != "vp") {
            warn([&] { return fmt::format("unknown keyword {}: the line is ignored", in_quotes(keyword)); });
        }
        return true;
    }

    // Colours that some tools write after the coordinates are ignored.
    bool read_vertex(LineCursor line) {
        Vec3f& position = all_.positions[static_cast<std::size_t>(seen_.of[of_v]++)];
        for (int axis = 0; axis < 3; ++axis)
            if (!line.plain_number(position[axis]) && !read_coordinate(line, axis, position[axis]))
                return false;
        return true;
    }

    // Exponents, many digits, numbers that begin or end with a point, and what is wrong.
    bool read_coordinate(LineCursor& line, int axis, float& coordinate) {
        const std::string_view word = line.word();
        if (word.empty()) return refuse(fmt::format("found {} coordinates, expected 3", axis));
        const auto value = read_number(word);
        if (!value) return refuse(fmt::format("{} is no number", in_quotes(word)));
        if (!in_range(value))
            return refuse(fmt::format("coordinate {0} is out of range; expected -{1} to {1}", in_quotes(word),
                                      to_text(largest_obj_coordinate)));
        coordinate = rounded_by_assimp(word, *value);
        return true;
    }

    bool read_uv(LineCursor line) {
        Vec2f& uv = all_.uvs[static_cast<std::size_t>(seen_.of[of_vt]++)];
        for (int axis = 0; axis < 2; ++axis) {
            if (line.plain_number(uv[axis])) continue;
            const std::string_view word = line.word();
            const auto value = word.empty() ? 0.0 : read_number(word);
            uv[axis] = !word.empty() && in_range(value) ? rounded_by_assimp(word, *value) : 0.0F;
            if (!in_range(value))
                warn([&] {
                    return fmt::format("texture coordinate {} is out of range: 0 is used", in_quotes(word));
                });
        }
        return true;
    }

    bool read_face(LineCursor line) {
        const std::size_t first = part_.corner_v.size();
        for (line.skip_blanks(); !line.at_end(); line.skip_blanks())
            if (!read_corner(line)) return false;
        if (has_three_different(first)) {
            part_.face_corners.push_back(static_cast<std::uint32_t>(part_.corner_v.size() - first));
            return true;
        }
        part_.corner_v.resize(first);
        if (all_.total.of[of_vt] > 0) part_.corner_vt.resize(first);
        warn([&] { return "the face has fewer than three different corners: dropped"; });
        return true;
    }

    // v, v/vt, v//vn or v/vt/vn. Without its position a corner is nowhere; the others it can do without.
    bool read_corner(LineCursor& line) {
        const LineCursor begin = line;
        std::uint32_t v = 0, vt = no_id, vn = 0;
        if (!read_index(line, begin, of_v, v)) return false;
        if (!line.at_end() && *line.at == '/') {
            ++line.at;
            if (!line.at_word_end() && *line.at != '/') read_spare_index(line, of_vt, vt);
            if (!line.at_end() && *line.at == '/') {
                ++line.at;
                if (!line.at_word_end()) read_spare_index(line, of_vn, vn);
            }
        }
        part_.corner_v.push_back(v);
        if (all_.total.of[of_vt] > 0) part_.corner_vt.push_back(vt);
        return line.at_word_end() || refuse_corner(begin);
    }

    bool read_index(LineCursor& line, const LineCursor& corner, Counted kind, std::uint32_t& value) {
        const char* const begin = line.at;
        if (find_index(line, kind, value)) return true;
        if (line.at == begin) return refuse_corner(corner);
        return refuse(fmt::format(
            "index {} is out of range; expected 1 to {}, or -1 to -{}, the number of '{}' lines so far",
            std::string_view(begin, static_cast<std::size_t>(line.at - begin)), all_.total.of[kind],
            seen_.of[kind], counted_names[kind]));
    }

    // Of a texture coordinate or a normal; one that cannot be found is left out.
    void read_spare_index(LineCursor& line, Counted kind, std::uint32_t& value) {
        const auto ends = [&] { return line.at_word_end() || (kind == of_vt && *line.at == '/'); };
        if (find_index(line, kind, value) && ends()) return;
        value = no_id;
        while (!ends())
            ++line.at;
        warn([&] {
            return fmt::format("a corner's {} is none of the file's {} '{}' lines: left out",
                               kind == of_vt ? "texture coordinate" : "normal", all_.total.of[kind],
                               counted_names[kind]);
        });
    }

    // From 1 to the number of statements, or from -1 back from the last one so far. Moves behind the number.
    bool find_index(LineCursor& line, Counted kind, std::uint32_t& value) const {
        const char* const begin = line.at;
        std::uint64_t digits = 0;
        int length = 0;
        const std::int64_t known = seen_.of[kind], total = all_.total.of[kind];
        if (line.digits(digits, length) && digits - 1 < static_cast<std::uint64_t>(total)) {
            value = static_cast<std::uint32_t>(digits - 1);
            return true;
        }
        std::int64_t index = 0;
        const auto [stop, error] = std::from_chars(begin, line.end, index);
        line.at = stop;
        if (error != std::errc{} || index == 0 || index < -known || index > total) return false;
        value = static_cast<std::uint32_t>(index < 0 ? known + index : index - 1);
        return true;
    }

    bool has_three_different(std::size_t first) const {
        if (part_.corner_v.size() < first + 3) return false;
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

    void read_name(const LineCursor& line, ObjName::Kind kind) {
        bool converted = false;
        std::string name = utf8_name(trim(line.rest()), converted);
        if (all_.continued) std::replace(name.begin(), name.end(), obj_joint, ' ');
        if (converted)
            warn([&] { return fmt::format("the name {} is no UTF-8: read as Latin-1", in_quotes(name)); });
        part_.events.push_back(
            {kind, part_.face_corners.size(), static_cast<std::size_t>(line_), std::move(name)});
    }

    bool refuse_long() {
        return refuse(fmt::format("the line has more than {} characters", longest_obj_line));
    }
    bool refuse_corner(LineCursor corner) {
        return refuse(
            fmt::format("{} is no corner; expected v, v/vt, v//vn or v/vt/vn", in_quotes(corner.word())));
    }
    bool refuse(std::string message) {
        part_.error = Error{here(), std::move(message)};
        return false;
    }
    template <class Message>
    void warn(const Message& message) {
        if (part_.warnings.full()) {
            part_.warnings.add_unworded();
        } else {
            part_.warnings.add(here(), message());
        }
    }
    std::string here() const { return fmt::format("{}:{}", all_.location, line_); }

    ObjReading& all_;
    ObjPart& part_;
    ObjCounts seen_;
    std::int64_t line_ = 0;  // the first of a continued one
};

}  // namespace

ObjCounts count_statements(const ObjPart& part, const ObjReading& reading) {
    ObjCounts counts;
    for_each_line(part.text, [&](const char* begin, const char* end) {
        counts.line += 1 + (reading.continued ? std::count(begin, end, obj_joint) : 0);
        if (begin == end || *begin != 'v') return true;
        const std::string_view keyword = LineCursor{begin, end}.word();
        if (keyword == "v") ++counts.of[of_v];
        if (keyword == "vt") ++counts.of[of_vt];
        if (keyword == "vn") ++counts.of[of_vn];
        return true;
    });
    return counts;
}

bool read_part(ObjReading& reading, ObjPart& part) {
    return PartReader(reading, part).run();
}

}  // namespace slipface

#include "obj/obj_scan.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "obj/obj_text.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::size_t corners_per_part = std::size_t{1} << 22;
constexpr std::size_t longest_copied_number = 32;

// The number of `v`, `vt` or `vn` lines so far, and the largest index that points beyond them.
struct Counter {
    const char* keyword;
    std::int64_t count = 0;
    std::int64_t furthest = 0;
    std::size_t furthest_line = 0;
};

class Scanner {
  public:
    Scanner(std::string text, const std::string& location, WarningList& warnings)
        : text_(std::move(text)), location_(location), warnings_(warnings), lines_(text_) {}

    Result<ObjScan> run() {
        if (text_.empty()) return Error{location_, "is empty; expected an OBJ file"};
        if (const std::size_t binary = find_binary(text_); binary != std::string::npos) {
            return Error{fmt::format("{}:{}", location_, line_of(text_, binary)),
                         fmt::format("byte 0x{:02X} is not text; expected an OBJ file",
                                     static_cast<unsigned char>(text_[binary]))};
        }
        scan_.clean.reserve(text_.size() + text_.size() / 8);
        scan_.face_first_corner.push_back(0);
        // Corners without a texture coordinate get this one, so that all corners have one.
        has_uv_ = text_.find("vt") != std::string::npos;
        if (has_uv_) scan_.clean += "vt 0 0\n";

        while (lines_.next()) {
            if (!read_line(lines_.line())) return *error_;
        }
        if (!check_forward_indices()) return *error_;
        if (scan_.face_material.empty()) return Error{location_, "has no faces"};
        scan_.materials = materials_.take();
        scan_.groups = groups_.take();
        return std::move(scan_);
    }

  private:
    bool read_line(std::string_view line) {
        if (line.size() > longest_obj_line) {
            return refuse(fmt::format("the line has {} characters; at most {} are read", line.size(),
                                      longest_obj_line));
        }
        std::string_view rest = line;
        const std::string_view keyword = take_word(rest);
        if (keyword.empty()) return true;
        if (keyword == "v") return read_vertex(rest);
        if (keyword == "f" || keyword == "fo") return read_face(rest);
        if (keyword == "vt") return read_uv(rest);
        if (keyword == "vn") {
            ++vn_.count;
            return true;
        }
        if (keyword == "usemtl") {
            materials_.set(name(rest), lines_.number());
        } else if (keyword == "g" || keyword == "o") {
            groups_.set(name(rest), lines_.number());
        } else if (keyword == "mtllib") {
            scan_.libraries.push_back({name(rest), lines_.number()});
        } else if (keyword == "l" || keyword == "p") {
            warn([&] {
                return fmt::format("{} are no surface: dropped", keyword == "l" ? "lines" : "points");
            });
        } else if (keyword != "s" && keyword != "vp") {
            warn([&] { return fmt::format("unknown keyword {}: the line is ignored", in_quotes(keyword)); });
        }
        return true;
    }

    std::string name(std::string_view rest) {
        bool converted = false;
        std::string result = utf8_name(trim(rest), converted);
        if (converted) {
            warn([&] { return fmt::format("the name {} is no UTF-8: read as Latin-1", in_quotes(result)); });
        }
        return result;
    }

    bool read_vertex(std::string_view rest) {
        ++v_.count;
        std::string& out = scan_.clean;
        out += 'v';
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = take_word(rest);
            if (word.empty()) return refuse(fmt::format("found {} coordinates, expected 3", axis));
            const auto value = read_number(word);
            if (!value) return refuse(fmt::format("{} is no number", in_quotes(word)));
            if (!(std::abs(*value) <= largest_obj_coordinate)) {
                return refuse(fmt::format("coordinate {0} is out of range; expected -{1} to {1}",
                                          in_quotes(word), to_text(largest_obj_coordinate)));
            }
            out += ' ';
            add_number(word, *value);
        }
        out += '\n';
        return true;
    }

    bool read_uv(std::string_view rest) {
        ++vt_.count;
        scan_.clean += "vt";
        for (int axis = 0; axis < 2; ++axis) {
            const std::string_view word = take_word(rest);
            const auto value = word.empty() ? 0.0 : read_number(word);
            const bool fine = value && std::abs(*value) <= largest_obj_coordinate;
            scan_.clean += ' ';
            fine ? add_number(word, *value) : add_number({}, 0.0);
            if (!fine) {
                warn([&] {
                    return fmt::format("texture coordinate {} is out of range: 0 is used", in_quotes(word));
                });
            }
        }
        scan_.clean += '\n';
        return true;
    }

    bool read_face(std::string_view rest) {
        corners_.clear();
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
            Corner corner;
            if (!read_corner(word, corner)) return false;
            corners_.push_back(corner);
        }
        if (!has_three_different()) {
            warn([&] { return "the face has fewer than three different corners: dropped"; });
            return true;
        }
        if (scan_.face_material.size() == max_obj_faces) {
            return refuse(fmt::format("more than {} faces", max_obj_faces));
        }
        begin_part_if_full();
        std::string& out = scan_.clean;
        out += 'f';
        for (const Corner& corner : corners_) {
            out += ' ';
            add_integer(corner.v);
            if (has_uv_) {
                out += '/';
                add_integer(corner.vt + 1);  // after the extra one for corners without
            }
        }
        out += '\n';
        scan_.face_first_corner.push_back(scan_.face_first_corner.back() +
                                          static_cast<std::uint32_t>(corners_.size()));
        scan_.face_material.push_back(materials_.index());
        scan_.face_group.push_back(groups_.index());
        return true;
    }

    struct Corner {
        std::int64_t v = 0, vt = 0;  // from 1; vt 0: none
    };

    // v, v/vt, v//vn or v/vt/vn
    bool read_corner(std::string_view word, Corner& corner) {
        std::int64_t vn = 0;
        const char* at = word.data();
        const char* const end = at + word.size();
        if (!read_index(at, end, v_, corner.v, word)) return false;
        if (at != end && *at == '/') {
            ++at;
            if (at != end && *at != '/' && !read_index(at, end, vt_, corner.vt, word)) return false;
            if (at != end && *at == '/') {
                ++at;
                if (at != end && !read_index(at, end, vn_, vn, word)) return false;
            }
        }
        return at == end || refuse_corner(word);
    }

    bool read_index(const char*& at, const char* end, Counter& counter, std::int64_t& index,
                    std::string_view word) {
        const auto [stop, error] = std::from_chars(at, end, index);
        if (error == std::errc::invalid_argument) return refuse_corner(word);
        if (error != std::errc{} || index == 0 || index < -counter.count) {
            return refuse_index(std::string_view(at, static_cast<std::size_t>(stop - at)), counter.keyword,
                                counter.count);
        }
        at = stop;
        if (index < 0) {
            index += counter.count + 1;
        } else if (index > counter.count && index > counter.furthest) {
            counter.furthest = index;
            counter.furthest_line = lines_.number();
        }
        return true;
    }

    bool check_forward_indices() {
        for (const Counter* counter : {&v_, &vt_, &vn_}) {
            if (counter->furthest <= counter->count) continue;
            error_ =
                Error{fmt::format("{}:{}", location_, counter->furthest_line),
                      index_message(std::to_string(counter->furthest), counter->keyword, counter->count)};
            return false;
        }
        return true;
    }

    bool has_three_different() const {
        if (corners_.size() < 3) return false;
        const std::int64_t first = corners_[0].v;
        std::int64_t second = first;
        return std::any_of(corners_.begin(), corners_.end(), [&](const Corner& corner) {
            if (corner.v == first || corner.v == second) return false;
            if (second != first) return true;
            second = corner.v;
            return false;
        });
    }

    void begin_part_if_full() {
        part_corners_ += corners_.size();
        if (part_corners_ <= corners_per_part) return;
        part_corners_ = corners_.size();
        scan_.clean += "usemtl part";
        add_integer(++parts_);
        scan_.clean += '\n';
    }

    void add_number(std::string_view word, double value) {
        if (copies_obj_number(word)) {
            scan_.clean += word;
        } else {
            scan_.clean += to_text(value);
        }
    }

    void add_integer(std::int64_t value) {
        char digits[24];
        const auto result = std::to_chars(digits, digits + sizeof digits, value);
        scan_.clean.append(digits, result.ptr);
    }

    static std::string index_message(std::string_view found, const char* keyword, std::int64_t count) {
        return fmt::format(
            "index {} is out of range; expected 1 to {}, or -1 to -{}, the number of '{}' lines so far",
            found, count, count, keyword);
    }
    bool refuse_index(std::string_view found, const char* keyword, std::int64_t count) {
        return refuse(index_message(found, keyword, count));
    }
    bool refuse_corner(std::string_view word) {
        return refuse(fmt::format("{} is no corner; expected v, v/vt, v//vn or v/vt/vn", in_quotes(word)));
    }
    bool refuse(std::string message) {
        error_ = Error{here(), std::move(message)};
        return false;
    }
    template <class Message>
    void warn(const Message& message) {
        if (warnings_.full()) {
            warnings_.add_unworded();
        } else {
            warnings_.add(here(), message());
        }
    }
    std::string here() const { return fmt::format("{}:{}", location_, lines_.number()); }

    std::string text_;
    const std::string& location_;
    WarningList& warnings_;
    LineReader lines_;
    ObjScan scan_;
    NameTable materials_, groups_;
    Counter v_{"v"}, vt_{"vt"}, vn_{"vn"};
    std::vector<Corner> corners_;
    std::optional<Error> error_;
    std::size_t part_corners_ = 0;
    std::int64_t parts_ = 0;
    bool has_uv_ = false;
};

}  // namespace

bool copies_obj_number(std::string_view word) {
    const std::size_t first_digit = word.starts_with('-') ? 1 : 0;
    return word.size() > first_digit && word.size() <= longest_copied_number && word[first_digit] >= '0' &&
           word[first_digit] <= '9';
}

Result<ObjScan> scan_obj(std::string text, const std::string& location, WarningList& warnings) {
    return Scanner(std::move(text), location, warnings).run();
}

}  // namespace slipface

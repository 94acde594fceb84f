#include "slipface/mesh/obj_lines.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "obj/obj_text.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

class StatementReader {
  public:
    explicit StatementReader(std::string_view text)
        : text_(text.substr(0, text.find_last_not_of(std::string_view("\0\x1A", 2)) + 1)), joined_(text_) {}

    std::vector<ObjStatement> run() {
        // The reader joins continued lines within the copy and preserves the length, so that offsets into the
        // copy are offsets into the text.
        LineReader lines(joined_);
        while (lines.next())
            add(lines.line());
        return std::move(statements_);
    }

  private:
    void add(std::string_view line) {
        std::string_view rest = line;
        const std::string_view keyword = take_word(rest);
        if (keyword == "v") ++vertices_;
        if (keyword == "f" || keyword == "fo") return add_face(line, rest);
        if (keyword == "usemtl") return add_named(ObjStatement::Kind::material, line, rest);
        if (keyword == "o") return add_named(ObjStatement::Kind::object, line, rest);
        if (keyword == "mtllib") return add_named(ObjStatement::Kind::library, line, rest);
    }

    void add_named(ObjStatement::Kind kind, std::string_view line, std::string_view rest) {
        const std::string_view name = trim(rest);
        const std::size_t begin = name.empty() ? offset(line) + line.size()
                                               : static_cast<std::size_t>(name.data() - joined_.data());
        statements_.push_back({kind, line_begin(line), begin, begin + name.size(), 0});
    }

    void add_face(std::string_view line, std::string_view rest) {
        corners_.clear();
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
            std::int64_t index = 0;
            std::from_chars(word.data(), word.data() + word.size(), index);
            corners_.push_back(index < 0 ? index + vertices_ + 1 : index);
        }
        const auto count = static_cast<std::uint32_t>(corners_.size());
        std::sort(corners_.begin(), corners_.end());
        const auto different = std::unique(corners_.begin(), corners_.end()) - corners_.begin();
        if (different >= 3) statements_.push_back({ObjStatement::Kind::face, line_begin(line), 0, 0, count});
    }

    std::size_t offset(std::string_view line) const {
        return static_cast<std::size_t>(line.data() - joined_.data());
    }

    // Blanks before a statement belong to its line.
    std::size_t line_begin(std::string_view line) const {
        std::size_t at = offset(line);
        while (at > 0 && (text_[at - 1] == ' ' || text_[at - 1] == '\t'))
            --at;
        return at;
    }

    std::string_view text_;
    std::string joined_;
    std::vector<ObjStatement> statements_;
    std::vector<std::int64_t> corners_;
    std::int64_t vertices_ = 0;
};

}  // namespace

std::vector<ObjStatement> obj_statements(std::string_view text) {
    return StatementReader(text).run();
}

std::string_view line_ending_near(std::string_view text, std::size_t position) {
    std::size_t at = text.find_first_of("\r\n", position);
    if (at == std::string_view::npos) at = text.find_first_of("\r\n");
    if (at == std::string_view::npos || text[at] == '\n') return "\n";
    return text.substr(at, 2) == "\r\n" ? std::string_view("\r\n") : std::string_view("\r");
}

}  // namespace slipface

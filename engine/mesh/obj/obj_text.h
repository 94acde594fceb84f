// The words and lines of OBJ and MTL files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace slipface {

// The bytes of a file as text: UTF-16 becomes UTF-8, and zero bytes and Ctrl-Z at the end are dropped, which
// some programs write. UTF-16 is known by its byte order mark, or by two ASCII characters at the start.
std::string text_of_file(std::string bytes);

// Reads the logical lines of a text. `\` at the end of a line joins it with the next, except in comments,
// where it usually ends a Windows path. Accepts LF, CRLF and lone CR, and skips a byte order mark.
class LineReader {
  public:
    // Joins lines within `text`, which must outlive the reader and the lines that it returns.
    explicit LineReader(std::string& text);

    bool next();                                     // false after the last line
    std::string_view line() const { return line_; }  // without its end, trimmed
    std::size_t number() const { return number_; }   // of its first physical line, counted from 1

  private:
    char* at_;
    char* end_;
    std::string_view line_;
    std::size_t number_ = 0;
    std::size_t next_number_ = 1;
};

// White space. A line contains no '\n'.
inline bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

// Removes the next word from `line` and returns it; empty at the end and where a comment begins.
std::string_view take_word(std::string_view& line);

// Reads a number as from_chars does, including infinities and NaN; a leading '+' is allowed. Returns nothing
// if `word` is not a number. A number too small for a double gives zero, one too large infinity.
std::optional<double> read_number(std::string_view word);

// Position of the first byte that is not text (a control character other than white space), or npos.
std::size_t find_binary(std::string_view text);
// Replaces bytes that are not text by '?', so that only what they stand in is lost. Returns how many there
// were.
std::size_t replace_binary(std::string& text);
std::size_t line_of(std::string_view text, std::size_t position);

// The name as UTF-8. Bytes that are not UTF-8 are read as Latin-1, which old exporters write; `converted` is
// then set.
std::string utf8_name(std::string_view name, bool& converted);

// At most 40 bytes of `text`, in quotes, for messages.
std::string in_quotes(std::string_view text);

}  // namespace slipface

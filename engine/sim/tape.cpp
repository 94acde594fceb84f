#include "slipface/sim/tape.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "slipface/base/files.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::string_view magic = "slipface-tape";
constexpr std::string_view version = "1";
constexpr std::uint64_t max_tape_bytes = 64ULL << 20;
constexpr std::size_t fingerprint_digits = 16;
constexpr double min_dt = 1e-4;
constexpr double max_dt = 0.25;
// A diagonal of two rounded numbers is a little longer than 1.
constexpr double max_wish = 1.000001;

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    while (!(line = trim(line)).empty()) {
        const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
        words.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
    return words;
}

std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 60;
    return text.size() <= longest ? fmt::format("\"{}\"", text)
                                  : fmt::format("\"{}...\"", text.substr(0, longest));
}

std::optional<double> parse_fraction(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return parse_double(text);
    const auto over = parse_double(text.substr(0, slash));
    const auto under = parse_double(text.substr(slash + 1));
    if (!over || !under || *under == 0.0) return std::nullopt;
    return *over / *under;
}

std::optional<std::uint64_t> parse_fingerprint(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (text.size() != fingerprint_digits || error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

std::optional<Vec2> parse_wish(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != 2) return std::nullopt;
    const auto x = parse_double(parts[0]);
    const auto z = parse_double(parts[1]);
    if (!x || !z || !(std::hypot(*x, *z) <= max_wish)) return std::nullopt;
    return Vec2(*x, *z);
}

// Lowercase letters, digits and underscores after a letter; "wish" is none.
bool is_button_name(std::string_view text) {
    constexpr std::size_t longest = 32;
    const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
    return !text.empty() && text.size() <= longest && is_letter(text.front()) && text != "wish" &&
           std::all_of(text.begin(), text.end(),
                       [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

class TapeParser {
  public:
    explicit TapeParser(const std::string& location) : location_(location) {}

    Result<Tape> parse(std::string_view text) {
        std::size_t number = 0;
        for (std::size_t at = 0; at < text.size() && !error_;) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            line_ = ++number;
            read_line(trim(text.substr(at, end - at)));
            at = end + 1;
        }
        if (!error_ && !has_header_) {
            line_ = std::max<std::size_t>(number, 1);
            fail("the end of the text", "\"slipface-tape 1\" first");
        }
        if (error_) return *error_;
        return std::move(tape_);
    }

  private:
    void fail(std::string_view found, std::string_view expected) {
        error_ = Error{fmt::format("{}:{}", location_, line_),
                       fmt::format("found {}, expected {}", found, expected)};
    }

    void read_line(std::string_view line) {
        if (line.empty() || line.front() == '#') return;
        const std::vector<std::string_view> words = words_of(line);
        if (tape_.end_hash) return fail(quoted(line), "nothing after \"end\"");
        if (!has_header_) {
            has_header_ = words.size() == 2 && words[0] == magic && words[1] == version;
            if (!has_header_)
                fail(quoted(line), "\"slipface-tape 1\" as the first line, the only supported version");
        } else if (words[0] == "level") {
            read_level(words);
        } else if (words[0] == "surfaces") {
            read_hash(words, has_surfaces_, tape_.surfaces_fingerprint);
        } else if (words[0] == "dt") {
            read_dt(words);
        } else if (words[0] == "settings") {
            read_base(words);
        } else if (words[0] == "set") {
            read_setting(trim(line.substr(3)));
        } else if (words[0] == "mover") {
            read_mover(words);
        } else if (words[0] == "start") {
            read_start(words);
        } else if (words[0] == "end") {
            const auto hash = words.size() == 2 ? parse_fingerprint(words[1]) : std::nullopt;
            if (!hash || tape_.segments.empty())
                return fail(quoted(line), "\"end\" with 16 hexadecimal digits, after the last tick");
            tape_.end_hash = hash;
        } else {
            read_segment(line, words);
        }
    }

    // Once, and before the first tick: what holds for the whole run stands at its head.
    bool may_set(bool& seen, std::string_view what) {
        if (seen) fail(fmt::format("\"{}\" a second time", what), "it once");
        if (!tape_.segments.empty())
            fail(fmt::format("\"{}\" after the first tick", what), "it before all ticks");
        seen = true;
        return !error_;
    }

    void read_level(const std::vector<std::string_view>& words) {
        if (!may_set(has_level_, "level")) return;
        std::size_t last = words.size();
        if (words.size() > 2) {
            tape_.level_fingerprint = parse_fingerprint(words.back());
            if (tape_.level_fingerprint) --last;
        }
        if (last < 2) return fail("\"level\" alone", "a name, and 16 hexadecimal digits if wanted");
        const char* const begin = words[1].data();
        const char* const end = words[last - 1].data() + words[last - 1].size();
        tape_.level_name = from_one_line({begin, static_cast<std::size_t>(end - begin)});
    }

    void read_dt(const std::vector<std::string_view>& words) {
        if (!may_set(has_dt_, "dt")) return;
        const auto dt = words.size() == 2 ? parse_fraction(words[1]) : std::nullopt;
        if (!dt || !(*dt >= min_dt && *dt <= max_dt)) {
            return fail(quoted(words.size() == 2 ? words[1] : "dt"),
                        "one time step from 0.0001 to 0.25 seconds, as 1/60 or 0.02");
        }
        tape_.dt = *dt;
        tape_.dt_text = words[1];
    }

    void read_hash(const std::vector<std::string_view>& words, bool& seen,
                   std::optional<std::uint64_t>& hash) {
        if (!may_set(seen, words[0])) return;
        hash = words.size() == 2 ? parse_fingerprint(words[1]) : std::nullopt;
        if (!hash) fail(quoted(words.back()), "16 hexadecimal digits");
    }

    void read_base(const std::vector<std::string_view>& words) {
        if (!may_set(tape_.from_basic, "settings")) return;
        const bool known = words.size() == 2 && (words[1] == "basic" || words[1] == "defaults");
        if (!known) return fail(quoted(words.back()), "\"settings basic\"");
        if (!tape_.settings.empty()) fail("\"settings\" after a setting", "it before all settings");
    }

    void read_setting(std::string_view assignment) {
        MovementSettings scratch;
        const Status status = set_setting(scratch, assignment);
        if (!status.ok()) {
            error_ = Error{fmt::format("{}:{}", location_, line_), status.error().text()};
            return;
        }
        if (tape_.segments.empty())
            tape_.settings.emplace_back(assignment);
        else
            tape_.changes.push_back({ticks_, std::string(assignment)});
    }

    void read_mover(const std::vector<std::string_view>& words) {
        bool seen = tape_.mover != nullptr;
        if (!may_set(seen, "mover")) return;
        tape_.mover = words.size() == 2 ? find_mover(words[1]) : nullptr;
        if (tape_.mover != nullptr) return;
        std::string names;
        for (const NamedMover& mover : lecture_movers())
            names += (names.empty() ? "" : ", ") + std::string(mover.name);
        fail(quoted(words.back()), "one of " + names);
    }

    void read_start(const std::vector<std::string_view>& words) {
        if (!may_set(has_start_, "start")) return;
        tape_.start = words.size() == 2 ? parse_vec3(words[1]) : std::nullopt;
        if (!tape_.start)
            fail(quoted(words.size() == 2 ? words[1] : "start"), "three numbers as x,y,z without spaces");
    }

    void read_segment(std::string_view line, const std::vector<std::string_view>& words) {
        const auto ticks = parse_int(words[0]);
        if (!ticks) return fail(quoted(line), "level, dt, set, start, or a number of ticks");
        const auto left = static_cast<std::int64_t>(max_tape_ticks - ticks_);
        if (*ticks < 1 || *ticks > left) {
            return fail(fmt::format("{} ticks", *ticks),
                        fmt::format("at least 1, and at most {} in the whole tape", max_tape_ticks));
        }
        TapeSegment segment;
        segment.ticks = static_cast<int>(*ticks);
        std::size_t word = 1;
        if (word < words.size() && words[word] == "wish") {
            const auto wish = word + 1 < words.size() ? parse_wish(words[word + 1]) : std::nullopt;
            if (!wish) {
                return fail(quoted(word + 1 < words.size() ? words[word + 1] : "wish"),
                            "x,z without spaces, a vector no longer than 1");
            }
            segment.input.wish = *wish;
            word += 2;
        }
        for (; word < words.size(); ++word) {
            const std::uint32_t bit = bit_of_button(words[word]);
            if (bit == 0 || (segment.input.buttons.bits & bit) != 0)
                return fail(
                    quoted(words[word]),
                    "TICKS [wish X,Z] [jump] and other buttons, each once, at most 24 of a game's own");
            segment.input.buttons.bits |= bit;
        }
        ticks_ += static_cast<std::size_t>(segment.ticks);
        tape_.segments.push_back(segment);
    }

    // 0: none. What the table does not name is a button of a game's own, or of a newer program.
    std::uint32_t bit_of_button(std::string_view name) {
        if (const ButtonInfo* info = find_button(name)) return ButtonSet(info->button).bits;
        if (!is_button_name(name)) return 0;
        std::vector<std::string>& own = tape_.own_buttons;
        auto at = std::find(own.begin(), own.end(), name);
        if (at == own.end()) {
            if (own.size() == ButtonSet::capacity - ButtonSet::first_own) return 0;
            at = own.emplace(own.end(), name);
        }
        return std::uint32_t{1} << (ButtonSet::first_own + static_cast<std::size_t>(at - own.begin()));
    }

    const std::string& location_;
    std::size_t line_ = 0;
    std::size_t ticks_ = 0;
    bool has_header_ = false, has_level_ = false, has_surfaces_ = false, has_dt_ = false, has_start_ = false;
    std::optional<Error> error_;
    Tape tape_;
};

bool same_input(const PlayerInput& a, const PlayerInput& b) {
    return a.wish == b.wish && a.buttons == b.buttons;
}

}  // namespace

std::vector<std::string> button_names(const Tape& tape, ButtonSet buttons) {
    std::vector<std::string> names;
    for (const ButtonInfo& info : button_table())
        if (buttons.has(info.button)) names.emplace_back(info.name);
    for (std::size_t i = ButtonSet::first_own; i < ButtonSet::capacity; ++i) {
        if (((buttons.bits >> i) & 1U) == 0) continue;
        const std::size_t own = i - ButtonSet::first_own;
        names.push_back(own < tape.own_buttons.size() ? tape.own_buttons[own]
                                                      : "own" + std::to_string(own + 1));
    }
    return names;
}

std::size_t Tape::tick_count() const {
    std::size_t count = 0;
    for (const TapeSegment& segment : segments)
        count += static_cast<std::size_t>(std::max(segment.ticks, 0));
    return count;
}

Result<Tape> parse_tape(std::string_view text, const std::string& location) {
    return TapeParser(location).parse(text);
}

Result<Tape> load_tape(const std::filesystem::path& path) {
    const Result<std::string> text = read_file(path, max_tape_bytes);
    if (!text) return text.error();
    return parse_tape(*text, path.string());
}

std::string tape_to_text(const Tape& tape) {
    std::string text = fmt::format("{} {}\n", magic, version);
    if (!tape.level_name.empty()) {
        text += "level " + on_one_line(tape.level_name);
        if (tape.level_fingerprint) text += fmt::format(" {:016x}", *tape.level_fingerprint);
        text += '\n';
    }
    if (tape.surfaces_fingerprint) text += fmt::format("surfaces {:016x}\n", *tape.surfaces_fingerprint);
    text += fmt::format("dt {}\n", tape.dt_text);
    if (tape.from_basic) text += "settings basic\n";
    for (const std::string& setting : tape.settings)
        text += fmt::format("set {}\n", setting);
    if (tape.mover != nullptr) text += fmt::format("mover {}\n", tape.mover->name);
    if (tape.start) {
        text += fmt::format("start {},{},{}\n", to_text(tape.start->x()), to_text(tape.start->y()),
                            to_text(tape.start->z()));
    }
    const auto write_ticks = [&](std::size_t ticks, const PlayerInput& input) {
        text += std::to_string(ticks);
        if (!input.wish.isZero(0.0))
            text += fmt::format(" wish {},{}", to_text(input.wish.x()), to_text(input.wish.y()));
        for (const std::string& name : button_names(tape, input.buttons))
            text += " " + name;
        text += "\n";
    };
    std::size_t tick = 0;
    auto change = tape.changes.begin();
    for (const TapeSegment& segment : tape.segments) {
        // A change inside a segment cuts it in two.
        for (const std::size_t end = tick + static_cast<std::size_t>(std::max(segment.ticks, 0));
             tick < end;) {
            for (; change != tape.changes.end() && change->tick <= tick; ++change)
                text += fmt::format("set {}\n", change->setting);
            const std::size_t stop = change != tape.changes.end() ? std::min(end, change->tick) : end;
            write_ticks(stop - tick, segment.input);
            tick = stop;
        }
    }
    if (tape.end_hash && tick > 0) text += fmt::format("end {:016x}\n", *tape.end_hash);
    return text;
}

void append_tick(Tape& tape, const PlayerInput& input) {
    const bool same = !tape.segments.empty() && same_input(tape.segments.back().input, input) &&
                      tape.segments.back().ticks < std::numeric_limits<int>::max();
    if (same) {
        ++tape.segments.back().ticks;
    } else {
        tape.segments.push_back({1, input});
    }
}

Tape cut_tape(const Tape& tape, std::size_t ticks) {
    Tape cut = tape;
    cut.end_hash.reset();
    cut.segments.clear();
    for (const TapeSegment& segment : tape.segments) {
        if (ticks == 0) break;
        const std::size_t kept = std::min(ticks, static_cast<std::size_t>(std::max(segment.ticks, 0)));
        if (kept > 0) cut.segments.push_back({static_cast<int>(kept), segment.input});
        ticks -= kept;
    }
    const std::size_t length = cut.tick_count();
    std::erase_if(cut.changes, [&](const TapeChange& change) { return change.tick >= length; });
    return cut;
}

std::vector<std::string> setting_changes(const MovementSettings& from, const MovementSettings& to) {
    std::vector<std::string> changes;
    for (const SettingInfo& info : settings_table()) {
        if (get_setting(from, info) != get_setting(to, info))
            changes.push_back(std::string(info.name) + "=" + setting_text(to, info));
    }
    return changes;
}

}  // namespace slipface

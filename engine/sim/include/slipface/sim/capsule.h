// A capsule: a run as one line of text, to be sent as part of a page's address.
//
// It holds the tape, the tick to look at, and the text of the level file: types, paint and settings, or how
// that differs from a text that both sides have. The geometry is not in it: `level` names it, and the tape
// has its fingerprint.
#pragma once

#include <string>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

struct Capsule {
    std::string level;       // file name of the geometry: "easy.obj"
    std::size_t tick = 0;    // from 0
    std::string tape;        // as tape_to_text() writes it
    std::string level_file;  // the text of a level file; empty: the level's own
    // A hash of the text that level_file then is a difference to (line_difference.h); empty: it is all of the
    // text.
    std::string base = {};
    friend bool operator==(const Capsule&, const Capsule&) = default;
};

inline constexpr std::size_t max_capsule_bytes = 16 << 20;  // unpacked

// "capsule=SIZE.DATA": of letters, digits, '.', '-', '_' and one '=', which no address needs to escape.
std::string capsule_text(const Capsule& capsule);
// Reads what capsule_text() writes; a '#' before it is ignored. The error says what is wrong with the text.
// The tape and the level file are not examined.
Result<Capsule> parse_capsule(std::string_view text);

}  // namespace slipface

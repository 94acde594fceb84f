// What was done to an input, in the user's words, read from the difference of its facts: "prop `crate` moved
// 1 m", "3 vertices of `roof` moved by up to 0.2 m", "only the order of faces changed".
#pragma once

#include <string>
#include <vector>

#include "goldens/numbers_json.h"

namespace slipface {

enum class ActKind {
    input,   // somebody changed it
    effect,  // follows from another act of the list: faces whose type a rule changed
    order,   // only an order changed, which means nothing by itself
};

struct Act {
    ActKind kind = ActKind::input;
    std::string text;
};

// Of a level's facts (level_facts.h), a tape's ("kind": "tape", "lines": [["60 wish 0,1"], ...]), a suite's
// row or a screen's ("kind": "row"). Inputs before effects before order; empty: the same.
std::vector<Act> acts_between(const Numbers& before, const Numbers& after);

// Of the files that a row names, as hashes by name.
std::vector<Act> file_acts(const Numbers& before, const Numbers& after);

// The parts of it.
void add_geometry_acts(const Numbers& before, const Numbers& after, std::vector<Act>& acts);
void add_member_acts(const Numbers& before, const Numbers& after, std::vector<Act>& acts);
void add_tape_acts(const Numbers& before, const Numbers& after, std::vector<Act>& acts);
void add_row_acts(const Numbers& before, const Numbers& after, std::vector<Act>& acts);

// "speed was 1.5, is 1.2; path 2 offset was ..." of all members that differ.
std::string changed_members(const Numbers& before, const Numbers& after);
// How far a list of three numbers moved; 0: it did not, or one is no such list.
double distance_moved(const Numbers& before, const Numbers& after);
// The member, or null.
const Numbers& member_of(const Numbers& json, std::string_view key);

}  // namespace slipface

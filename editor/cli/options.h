// Options that several verbs share, each declared once.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "slipface/base/shard.h"

namespace slipface::cli {

// An option or, by a name without dashes, an argument that is a file's or a folder's path.
CLI::Option* add_path(CLI::App& verb, const std::string& name, std::filesystem::path& path,
                      const std::string& description);

// --set name=value, which may be repeated.
void add_set_option(CLI::App& verb, std::vector<std::string>& settings);

// What a verb that sends players through a level needs to know.
struct PlayWords {
    std::string level, preset, spawn;
    std::vector<std::string> settings;
    std::uint64_t seed = 1;
    int threads = 0;
    std::string all_options;  // all of the verb's, as text
};

// LEVEL, --seed, --preset, --spawn, --set and --threads. Returns LEVEL, which is not required.
CLI::Option* add_play_options(CLI::App& verb, PlayWords& words);

// --shard I/N, of which `words` becomes the text. Bad usage unless it is 1/N to N/N.
CLI::Option* add_shard_option(CLI::App& verb, std::string& words, const std::string& of_what);
// The text of a --shard option as a shard; the whole if it is empty.
Shard shard_of(const std::string& words);

// A check for numbers of 64 bits: the parser alone would read -1 as the largest number.
std::string whole_number(const std::string& text);

}  // namespace slipface::cli

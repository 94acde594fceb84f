#include "cli/options.h"

#include <fmt/format.h>

#include <charconv>

#include "cli/verbs.h"
#include "slipface/base/system.h"

namespace slipface::cli {

CLI::Option* add_path(CLI::App& verb, const std::string& name, std::filesystem::path& path,
                      const std::string& description) {
    return verb.add_option_function<std::string>(
        name, [&path](const std::string& text) { path = path_of(text); }, description);
}

void add_set_option(CLI::App& verb, std::vector<std::string>& settings) {
    verb.add_option("--set", settings, "Change a movement setting; may be repeated")
        ->type_name("name=value")
        ->allow_extra_args(false);
}

CLI::Option* add_play_options(CLI::App& verb, PlayWords& words) {
    CLI::Option* level = verb.add_option("LEVEL", words.level, level_help());
    verb.add_option("--seed", words.seed, "Another seed, other inputs")
        ->check(whole_number)
        ->capture_default_str();
    verb.add_option("--preset", words.preset, "A preset, or a preset file, instead of the level's settings");
    verb.add_option("--spawn", words.spawn, "Start at this spawn of the level")->type_name("NAME");
    add_set_option(verb, words.settings);
    verb.add_option("--threads", words.threads, "Maximum number of threads; 0: one per processor")
        ->check(CLI::Range(0, 4096));
    return level;
}

CLI::Option* add_shard_option(CLI::App& verb, std::string& words, const std::string& of_what) {
    return verb.add_option("--shard", words, "Only this part of the " + of_what + ", 1/N to N/N")
        ->type_name("I/N")
        ->check([](const std::string& text) {
            const Result<Shard> shard = parse_shard(text, "");
            return shard ? std::string() : shard.error().message;
        });
}

Shard shard_of(const std::string& words) {
    const Result<Shard> shard = parse_shard(words, "--shard");
    return shard ? *shard : Shard{};
}

std::string whole_number(const std::string& text) {
    std::uint64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc() && rest == end) return {};
    return fmt::format("found {}, expected a whole number from 0 to 18446744073709551615", text);
}

}  // namespace slipface::cli

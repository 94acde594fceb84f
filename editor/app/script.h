// Text scripts that use the editor as a person does: widgets by name, gestures in the view, keys.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/offscreen_host.h"

namespace slipface {

struct ScriptLine {
    int number = 0;                  // from 1
    std::vector<std::string> words;  // the verb first; "quoted words" may contain spaces
};

// The lines that have a verb. Errors name LOCATION:LINE.
Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& location);

// Why a script failed: bad input (an unknown verb, widget or file) or an `expect` that does not hold.
enum class ScriptFailure { none, bad_input, expectation };

struct ScriptResult {
    ScriptFailure failure = ScriptFailure::none;
    Error error;  // its location is "FILE:LINE"
    std::size_t lines_done = 0;
    explicit operator bool() const { return failure == ScriptFailure::none; }
};

// Runs `text`; relative paths start at `folder`. Stops at the first failure. Calls `after_line` after each
// completed line.
ScriptResult run_script(OffscreenHost& host, std::string_view text, const std::string& location,
                        const std::filesystem::path& folder, const std::function<void()>& after_line = {});
ScriptResult run_script_file(OffscreenHost& host, const std::filesystem::path& file,
                             const std::function<void()>& after_line = {});

// One row per verb; the interpreter, its errors and docs/scripting.md are made from these.
struct ScriptContext;
struct ScriptVerb {
    const char* name;
    const char* arguments;
    const char* meaning;
    std::size_t least, maximum;  // number of arguments
    void (*run)(ScriptContext& context, const std::vector<std::string>& words);
};
std::span<const ScriptVerb> script_verbs();
std::string script_verbs_markdown();

}  // namespace slipface

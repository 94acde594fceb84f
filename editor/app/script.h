// Text scripts that use the editor as a person would: by the names of widgets, by gestures in the view, by
// keys.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/offscreen_host.h"

namespace slipface {

struct ScriptLine {
    int number = 0;                  // from 1
    std::vector<std::string> words;  // the verb first; "quoted words" may hold spaces
};

// The lines with a verb in them. Errors name PLACE:LINE.
Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& location);

// What a script may be told apart by: bad input (a verb, a widget or a file that does not exist) or an
// `expect` that failed.
enum class ScriptFailure { none, bad_input, expectation };

struct ScriptResult {
    ScriptFailure failure = ScriptFailure::none;
    Error error;  // place "FILE:LINE"
    int lines_done = 0;
    explicit operator bool() const { return failure == ScriptFailure::none; }
};

// Runs `text`; relative paths in it start at `folder`. Stops at the first failure. `after_line` is called
// after each line that was done.
ScriptResult run_script(OffscreenHost& host, std::string_view text, const std::string& location,
                        const std::filesystem::path& folder, const std::function<void()>& after_line = {});
ScriptResult run_script_file(OffscreenHost& host, const std::filesystem::path& file,
                             const std::function<void()>& after_line = {});

// One row a verb; the interpreter, its errors and docs/scripting.md are made from these.
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

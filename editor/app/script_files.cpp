// The verbs that exchange files with other programs.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "app/script_context.h"
#include "tools/lab/imported_run.h"
#include "tools/lab/lab_actions.h"
#include "tools/session/exchange.h"

namespace slipface {

namespace {

// What the verb's first word does with the file of its second one.
struct FileAction {
    std::string_view word;
    void (*act)(Editor& editor, const std::filesystem::path& path);
};

void act_on_file(ScriptContext& context, const Words& words, std::span<const FileAction> actions) {
    if (!context.editor().document) return context.fail("nothing is open");
    std::string expected;
    for (const FileAction& action : actions) {
        if (words[1] == action.word) {
            action.act(context.editor(), script_path(context, words[2]));
            context.host.frame();
            context.host.frame();
            return;
        }
        const bool last = &action == &actions.back();
        expected += (expected.empty() ? "" : last ? " or " : ", ") + std::string(action.word);
    }
    context.fail("expected " + expected + ", found \"" + words[1] + "\"");
}

}  // namespace

void verb_preset(ScriptContext& context, const Words& words) {
    static constexpr FileAction actions[] = {{"open", open_preset}, {"save", save_preset}};
    act_on_file(context, words, actions);
}

void verb_run(ScriptContext& context, const Words& words) {
    static constexpr FileAction actions[] = {{"open", open_tape}, {"add", add_tape}, {"import", import_run}};
    act_on_file(context, words, actions);
}

void verb_export(ScriptContext& context, const Words& words) {
    static constexpr FileAction actions[] = {
        {"obj", export_level_obj}, {"gltf", export_level_gltf}, {"game", export_level_game}};
    act_on_file(context, words, actions);
}

}  // namespace slipface

// The verbs that exchange files with other programs.
#include "app/script_context.h"
#include "tools/lab/imported_run.h"
#include "tools/lab/lab_actions.h"
#include "tools/session/exchange.h"

namespace slipface {

void verb_preset(ScriptContext& context, const Words& words) {
    if (!context.editor().document) return context.fail("nothing is open");
    const std::filesystem::path path = script_path(context, words[2]);
    if (words[1] == "open")
        open_preset(context.editor(), path);
    else if (words[1] == "save")
        save_preset(context.editor(), path);
    else
        return context.fail("expected open or save, found \"" + words[1] + "\"");
    context.host.frame();
    context.host.frame();
}

void verb_run(ScriptContext& context, const Words& words) {
    if (!context.editor().document) return context.fail("nothing is open");
    const std::filesystem::path path = script_path(context, words[2]);
    if (words[1] == "open")
        open_tape(context.editor(), path);
    else if (words[1] == "add")
        add_tape(context.editor(), path);
    else if (words[1] == "import")
        import_run(context.editor(), path);
    else
        return context.fail("expected open, add or import, found \"" + words[1] + "\"");
    context.host.frame();
    context.host.frame();
}

void verb_export(ScriptContext& context, const Words& words) {
    if (!context.editor().document) return context.fail("nothing is open");
    const std::filesystem::path path = script_path(context, words[2]);
    if (words[1] == "obj")
        export_level_obj(context.editor(), path);
    else if (words[1] == "gltf")
        export_level_gltf(context.editor(), path);
    else if (words[1] == "game")
        export_level_game(context.editor(), path);
    else
        return context.fail("expected obj, gltf or game, found \"" + words[1] + "\"");
    context.host.frame();
    context.host.frame();
}

}  // namespace slipface

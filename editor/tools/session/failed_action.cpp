#include "tools/session/failed_action.h"

#include <exception>

#include "tools/editor.h"

namespace slipface {

Checkpoint checkpoint(const Editor& editor) {
    const Document* const document = editor.document.get();
    return {document, document != nullptr ? document->history_mark() : 0};
}

void action_failed(Editor& editor, const Checkpoint& before, const char* what) {
    // For too little memory any step below may fail as well; those after it are tried all the same.
    const auto attempt = [](const auto& step) {
        try {
            step();
        } catch (const std::exception&) {
        }
    };
    editor.live_edit = false;
    Document* const document = editor.document.get();
    if (document != nullptr) {
        if (document == before.document) attempt([&] { document->roll_back(before.mark); });
        attempt([&] { editor.session.autosave.write_now(*document, document->level().file_path); });
    }
    attempt([&] {
        editor.message = MessageDialog{
            .title = "That did not work",
            .text = std::string("It failed: ") + what + ".\nThe level is as it was before" +
                    (document != nullptr && document->dirty() && editor.session.autosave.active() &&
                             editor.session.autosave.problem()
                         ? ", and its unsaved changes are autosaved."
                         : "."),
            .details = {},
            .of_refused_write = true};
    });
}

}  // namespace slipface

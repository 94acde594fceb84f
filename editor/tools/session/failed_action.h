// What an exception costs: the action in which it was thrown, never the session.
#pragma once

#include <cstddef>

namespace slipface {

struct Editor;
class Document;

// Where the document stands before an action.
struct Checkpoint {
    const Document* document = nullptr;
    std::size_t mark = 0;  // Document::history_mark()
};
Checkpoint checkpoint(const Editor& editor);
// The document returns to the checkpoint, its unsaved changes are autosaved, and a message says so. `what`:
// the exception's text.
void action_failed(Editor& editor, const Checkpoint& before, const char* what);

}  // namespace slipface

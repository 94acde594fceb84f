// Parts that dialogs have in common.
#pragma once

#include <string>

#include "app/parts.h"

namespace slipface {

std::string shown_text(const Parts& parts, std::string text);                     // without the hidden folder
std::string shown_folder(const Parts& parts, const std::filesystem::path& file);  // the folder of the file
std::string autosave_facts(const Parts& parts, const AutosaveInfo& autosave);     // "3 steps, 5 min ago"
void dialog_title(const char* icon, const ImVec4& color, const char* text);
void align_buttons(int count, float width);  // moves the cursor so that `count` buttons end at the right edge
void wrapped(const std::string& text);

void loading_dialog(Parts& parts);
void recover_dialog(Parts& parts);

}  // namespace slipface

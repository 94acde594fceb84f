// The one window on top of everything: a message, the question about unsaved changes, or the file browser.
#include <imgui_internal.h>

#include <algorithm>

#include "app/dialog_parts.h"
#include "app/parts.h"
#include "document/path_text.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

enum class DialogKind { none, message, loading, unsaved, recover, file };

DialogKind dialog_kind(const Editor& editor) {
    if (editor.message) return DialogKind::message;
    if (editor.session.loading) return DialogKind::loading;
    if (editor.unsaved) return DialogKind::unsaved;
    if (!editor.session.recoverable.empty()) return DialogKind::recover;
    if (editor.file_dialog != FileDialogKind::none) return DialogKind::file;
    return DialogKind::none;
}

}  // namespace

std::string shown_text(const Parts& parts, std::string text) {
    if (parts.hidden_folder.empty()) return text;
    for (std::size_t at; (at = text.find(parts.hidden_folder)) != std::string::npos;)
        text.erase(at, parts.hidden_folder.size());
    return text;
}

void dialog_title(const char* icon, const ImVec4& color, const char* text) {
    ui::push_font(ui::fonts().semibold);
    if (*icon) {
        ImGui::TextColored(color, "%s", icon);
        ImGui::SameLine(0, 10 * ui::scale());
    }
    wrapped(printable(text));
    ImGui::PopFont();
    ImGui::Dummy({0, 4 * ui::scale()});
}

void align_buttons(int count, float width) {
    ImGui::Dummy({0, 6 * ui::scale()});
    const float total =
        static_cast<float>(count) * width + static_cast<float>(count - 1) * ImGui::GetStyle().ItemSpacing.x;
    const float x = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - total;
    ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), x));
}

void wrapped(const std::string& text) {
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str(), text.c_str() + text.size());
    ImGui::PopTextWrapPos();
}

namespace {

void message_dialog(Parts& parts) {
    const ui::Scope scope("Message");
    const float scale = ui::scale();
    const MessageDialog message = *parts.editor.message;
    dialog_title("\uf071", ui::palette().accent, message.title.c_str());
    wrapped(shown_text(parts, message.text));
    if (!message.details.empty()) {
        ImGui::Dummy({0, 4 * scale});
        const float row = ImGui::GetTextLineHeightWithSpacing();
        const float height = std::min(static_cast<float>(message.details.size()) * row * 2 + 16 * scale,
                                      ImGui::GetIO().DisplaySize.y * 0.4f);
        ImGui::PushStyleColor(ImGuiCol_ChildBg, ui::palette().panel);
        ImGui::BeginChild("details", {0, height}, true);
        for (const Diagnostic& detail : message.details)
            wrapped(shown_text(parts, detail.text()));
        ui::end(ImGui::EndChild);
        ImGui::PopStyleColor();
    }
    if (message.asks_about_files) {
        const float width = 120 * scale;
        align_buttons(4, width);
        if (ui::button("Cancel", "Decide later; saving waits", true, {width, 0}))
            parts.editor.message.reset();
        for (const char* id : {"file.take_theirs", "file.merge_by_face", "file.keep_mine"}) {
            const Command& command = *find_command(id);
            ImGui::SameLine();
            if (ui::button(command.label, command.description, true, {width, 0}))
                run_command(parts.editor, id);
        }
        return;
    }
    if (!message.offers_save_as) {
        align_buttons(1, 100 * scale);
        if (ui::primary_button("OK", true, {100 * scale, 0})) parts.editor.message.reset();
        return;
    }
    const float width = 120 * scale;
    align_buttons(2, width);
    if (ui::button("Cancel", nullptr, true, {width, 0})) parts.editor.message.reset();
    ImGui::SameLine();
    if (!ui::primary_button("Save as\u2026", true, {width, 0})) return;
    parts.editor.message.reset();
    run_command(parts.editor, "file.save_as");
}

void unsaved_dialog(Parts& parts) {
    const ui::Scope scope("Unsaved");
    Editor& editor = parts.editor;
    const float scale = ui::scale();
    const UnsavedDialog question = *editor.unsaved;
    const bool quitting = question.then == UnsavedDialog::Then::quit;
    dialog_title("\uf0c7", ui::palette().accent, "Save the changes?");
    wrapped(document_name(editor) + " has unsaved changes. " +
            (quitting ? "Quitting" : "Opening another level") + " without saving loses them.");
    const float width = 120 * scale;
    align_buttons(3, width);
    if (ui::button("Cancel", nullptr, true, {width, 0})) answer_unsaved(editor, UnsavedChoice::cancel);
    ImGui::SameLine();
    if (ui::button("Don't save", nullptr, true, {width, 0})) answer_unsaved(editor, UnsavedChoice::discard);
    ImGui::SameLine();
    if (ui::primary_button("Save", true, {width, 0})) answer_unsaved(editor, UnsavedChoice::save);
}

}  // namespace

namespace {

float design_width(const Editor& editor, DialogKind kind) {
    if (kind == DialogKind::file) return 960.0f;
    const bool wide = kind == DialogKind::message && editor.message->asks_about_files;
    return kind == DialogKind::recover || wide ? 620.0f : 480.0f;
}

}  // namespace

bool dialog_is_open(const Editor& editor) {
    return dialog_kind(editor) != DialogKind::none;
}

void close_dialog(Editor& editor) {
    switch (dialog_kind(editor)) {
        case DialogKind::message: editor.message.reset(); break;
        case DialogKind::loading: cancel_loading(editor); break;
        case DialogKind::unsaved: editor.unsaved.reset(); break;
        case DialogKind::recover: editor.session.recoverable.clear(); break;
        case DialogKind::file: editor.file_dialog = FileDialogKind::none; break;
        case DialogKind::none: break;
    }
}

void dialogs(Parts& parts) {
    const DialogKind kind = dialog_kind(parts.editor);
    if (kind != DialogKind::file) parts.browser.shown = FileDialogKind::none;
    constexpr const char* id = "##dialog";
    if (kind == DialogKind::none) {
        // Closed before its next frame, which would show it empty.
        if (ImGui::IsPopupOpen(id)) ImGui::ClosePopupToLevel(0, true);
        return;
    }
    if (!ImGui::IsPopupOpen(id)) ImGui::OpenPopup(id);

    const float scale = ui::scale();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(design_width(parts.editor, kind) * scale, screen.x * 0.94f);
    const float height = kind == DialogKind::file ? std::min(560 * scale, screen.y * 0.92f) : 0.0f;
    ImGui::SetNextWindowSize({width, height});
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {20 * scale, 18 * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8 * scale);
    const bool open = ImGui::BeginPopupModal(id, nullptr,
                                             ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                                 ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleVar(2);
    if (!open) return;
    switch (kind) {
        case DialogKind::message: message_dialog(parts); break;
        case DialogKind::loading: loading_dialog(parts); break;
        case DialogKind::unsaved: unsaved_dialog(parts); break;
        case DialogKind::recover: recover_dialog(parts); break;
        case DialogKind::file: file_browser(parts); break;
        case DialogKind::none: break;
    }
    if (!dialog_is_open(parts.editor)) ImGui::CloseCurrentPopup();
    ui::end(ImGui::EndPopup);
}

}  // namespace slipface

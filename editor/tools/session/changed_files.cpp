// The open level's files hold something else than its unsaved changes add to: the question, and its answers.
#include <system_error>
#include <utility>

#include "document/merge_levels.h"
#include "slipface/base/counted.h"
#include "tools/session/reload.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

std::string level_file_name(const Editor& editor) {
    return editor.document->level().file_path.filename().string();
}

// The text of the level file with which `level` would be saved beside this document.
std::string saved_text(const Editor& editor, Level level) {
    level.mesh_path = editor.document->level().mesh_path;
    level.file_path = editor.document->level().file_path;
    level.import_transform = editor.document->level().import_transform;
    return level_to_json(level);
}

Result<Level> level_of(const Editor& editor, const LevelBase& file) {
    const Level& open = editor.document->level();
    return annotated(file.text.get(), open.file_path.string(), open);
}

void close_question(Editor& editor) {
    editor.session.changed.reset();
    if (editor.message && editor.message->asks_about_files) editor.message.reset();
}

void word_question(Editor& editor, const std::string& geometry = {}) {
    ChangedFiles& changed = *editor.session.changed;
    changed.question.clear();
    if (changed.level_file)
        changed.question =
            level_file_name(editor) + " was changed by another program while you have unsaved changes";
    if (!geometry.empty()) changed.question += (changed.question.empty() ? "" : "; ") + geometry;
}

ChangedFiles& open_question(Editor& editor) {
    if (!editor.session.changed) editor.session.changed.emplace();
    return *editor.session.changed;
}

// Without unsaved changes the file is taken over at once.
void take_over(Editor& editor, const LevelBase& file, LoadedLevel loaded, const char* step) {
    Document& document = *editor.document;
    const std::string name = level_file_name(editor);
    stop_playtest(editor);
    document.restore(std::move(loaded.level), step + (" " + name));
    document.mark_saved(file);
    document_is_safe(editor);
    make_brush_valid(editor);
    editor.status = "Reloaded " + name + ": " + loaded.match.text() + guessed_text(document);
    if (!loaded.warnings.empty()) editor.status += "; " + loaded.warnings.front().message;
    editor.status += "; can be undone";
}

void merge(Editor& editor, const LevelBase& file, const Level& theirs) {
    Document& document = *editor.document;
    const std::string name = level_file_name(editor);
    const Result<Level> base = level_of(editor, document.base());
    const Result<MergedLevels> merged = base ? merge_levels(*base, document.level(), theirs, MergeSide::mine)
                                             : Result<MergedLevels>(base.error());
    if (!merged) {
        editor.message = MessageDialog{"Cannot merge " + name, merged.error().text(), {}};
        return;
    }
    stop_playtest(editor);
    const bool as_theirs = saved_text(editor, merged->level) == saved_text(editor, theirs);
    std::optional<std::vector<FaceId>> selected;
    if (!merged->conflicts.empty()) selected = merged->conflicts;
    document.restore(merged->level, "Merge " + name, std::move(selected));
    as_theirs ? document.mark_saved(file) : document.mark_unsaved(file);
    make_brush_valid(editor);
    editor.status = "Merged " + name + "; can be undone";
    close_question(editor);
    report_conflicts(editor, merged->conflicts, merged->other_conflicts, "yours");
}

}  // namespace

void report_conflicts(Editor& editor, const std::vector<FaceId>& faces,
                      const std::vector<std::string>& others, const std::string& taken) {
    if (faces.empty() && others.empty()) return;
    MessageDialog message{.title = "Both sides changed the same",
                          .text = "Where both changed the same thing, it is now " + taken +
                                  ". Undo returns to "
                                  "the level before the merge.",
                          .details = {}};
    if (!faces.empty()) message.details.push_back({counted(faces.size(), "face"), taken + "; selected"});
    for (const std::string& other : others)
        message.details.push_back({other, taken});
    editor.message = std::move(message);
}

void geometry_is_settled(Editor& editor) {
    std::optional<ChangedFiles>& changed = editor.session.changed;
    if (!changed) return;
    changed->geometry = false;
    if (changed->level_file)
        word_question(editor);
    else
        close_question(editor);
}

void ask_about_geometry(Editor& editor, const LoadedLevel& read_again) {
    open_question(editor).geometry = true;
    word_question(editor, editor.document->level().mesh_path.filename().string() +
                              " was changed, and not all of the unsaved paint is found in it: " +
                              read_again.match.text());
}

LevelFileState look_at_level_file(Editor& editor) {
    Document& document = *editor.document;
    const fs::path file = document.level().file_path;
    const auto no_question = [&] {
        if (editor.session.changed) editor.session.changed->level_file.reset();
        if (editor.session.changed && !editor.session.changed->geometry) close_question(editor);
    };
    const Result<LevelBase> now = read_level_base(file);
    if (now && now->content == 0 && document.base().content != 0) {
        no_question();
        editor.status = level_file_name(editor) + " no longer exists on disk; saving writes it again";
        return LevelFileState::same;
    }
    if (now && now->content == document.base().content) {
        no_question();
        return LevelFileState::same;
    }
    Result<LoadedLevel> loaded =
        now ? level_from_json(*now->text, file.string(), document.level()) : Result<LoadedLevel>(now.error());
    if (!loaded) {
        read_failed(editor, file, loaded.error(), true);
        return LevelFileState::broken;
    }
    const std::string theirs = saved_text(editor, loaded->level);
    if (const Result<Level> base = level_of(editor, document.base());
        base && saved_text(editor, *base) == theirs) {
        document.mark_reworded(*now);
        no_question();
        return LevelFileState::same;
    }
    if (document.dirty() && saved_text(editor, document.level()) == theirs) {
        document.mark_saved(*now);
        document_is_safe(editor);
        no_question();
        editor.status = level_file_name(editor) + " on disk has the same changes";
        return LevelFileState::taken;
    }
    if (!document.dirty()) {
        no_question();
        take_over(editor, *now, std::move(*loaded), "Reload");
        return LevelFileState::taken;
    }
    open_question(editor).level_file = *now;
    word_question(editor);
    return LevelFileState::asked;
}

bool saving_must_wait(Editor& editor) {
    const LevelFileState state = look_at_level_file(editor);
    if (state == LevelFileState::same) return false;
    if (state == LevelFileState::taken) return true;
    const std::string name = level_file_name(editor);
    ChangedFiles& changed = open_question(editor);
    if (state == LevelFileState::broken) {
        const fs::path& file = editor.document->level().file_path;
        const Result<LevelBase> now = read_level_base(file);
        // A folder of that name, say: nothing of anybody's is replaced, and saving says what is in the way.
        std::error_code ignored;
        if (!now && !fs::is_regular_file(file, ignored)) return false;
        changed.level_file = now ? *now : LevelBase{};
        word_question(editor);
    }
    editor.message = MessageDialog{
        .title = "Not saved: " + name + " was changed by another program",
        .text =
            "Keep mine replaces what the other program wrote. Take theirs replaces your unsaved changes. "
            "Merge by face joins both: what only one side changed is as that side made it, and where "
            "both did, your changes win. Undo returns to your changes.",
        .details = {},
        .of_refused_write = true,
        .asks_about_files = true};
    return true;
}

void answer_changed(Editor& editor, ChangedAnswer answer) {
    Session& session = editor.session;
    if (!session.changed || !editor.document || editor.document->in_transaction()) return;
    if (session.changed->geometry && answer != ChangedAnswer::keep_mine)
        return start_reload(editor, false, false, answer);
    if (!session.changed->level_file) return close_question(editor);
    const ChangedFiles changed = *session.changed;
    const LevelBase& file = *changed.level_file;
    Document& document = *editor.document;
    const std::string name = level_file_name(editor);
    if (answer == ChangedAnswer::keep_mine) {
        document.mark_unsaved(file);
        const bool saving = editor.message && editor.message->asks_about_files;
        close_question(editor);
        editor.status = "Kept your changes; saving replaces " + name;
        if (saving) save_level(editor);
        return;
    }
    Result<LoadedLevel> theirs =
        file.text ? level_from_json(*file.text, document.level().file_path.string(), document.level())
                  : Result<LoadedLevel>(Error{name, "cannot be read"});
    if (!theirs) {
        editor.message = MessageDialog{"Cannot read " + name, theirs.error().text(), {}};
        return;
    }
    if (answer == ChangedAnswer::merge) return merge(editor, file, theirs->level);
    close_question(editor);
    take_over(editor, file, std::move(*theirs), "Take");
}

}  // namespace slipface

// Random commands of the table, as a person would give them: whatever they did, undo and redo lead through
// the same states again. SLIPFACE_FUZZ_COMMANDS sets how many (scripts/undo_test.sh runs 100 000).
#include <cstdlib>
#include <map>
#include <random>
#include <set>

#include "level_fixture.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"
#include "tools/commands/commands.h"
#include "tools/selection/selecting.h"

namespace slipface {
namespace {

std::uint64_t state_of(const Document& document) {
    Hasher hasher;
    hasher.text(level_to_json(document.level()));
    for (const FaceId face : document.selection())
        hasher.u64(face);
    for (const SurfaceId surface : document.resolved().surface)
        hasher.u64(surface);
    return hasher.value();
}

// These leave the document, wait for an answer, or belong to another document.
bool left_out(std::string_view id) {
    static const std::set<std::string_view> ids{"file.open", "file.quit", "file.save_as", "file.recover"};
    return ids.contains(id) || id.starts_with("lab.") || id.starts_with("playtest.") ||
           id.starts_with("tape");
}

class CommandFuzz : public LevelFixture {
  protected:
    std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random() % limit); }

    // What the mouse would point at, now and then.
    void move_mouse(Editor& editor) {
        const auto faces = static_cast<std::uint32_t>(editor.document->face_count());
        editor.hovered = below(5) == 0 ? no_id : below(faces);
        if (editor.hovered == no_id) return;
        editor.hovered_point = face_centroid(editor.document->mesh(), editor.hovered);
        editor.hovered_normal = face_normal(editor.document->mesh(), editor.hovered);
        switch (below(6)) {
            case 0: return paint_hovered(editor);
            case 1: return fill_hovered(editor);
            case 2:
            case 3: return click_select(editor, static_cast<SelectBy>(below(4)));
            default: return;
        }
    }

    std::mt19937 random{20260822};
};

TEST_F(CommandFuzz, UndoAndRedoMeetTheSameStatesAgain) {
    const char* const wanted = std::getenv("SLIPFACE_FUZZ_COMMANDS");
    const std::int64_t count = wanted ? parse_int(wanted).value_or(0) : 3000;
    ASSERT_GT(count, 0);
    Editor editor;
    open_level(editor, obj);
    ASSERT_TRUE(editor.document);
    std::map<std::size_t, std::uint64_t> known;  // by steps done, of the history as it is now
    known[0] = state_of(*editor.document);
    std::size_t compared = 0, ran = 0;
    for (std::int64_t i = 0; i < count; ++i) {
        const auto all = commands();
        const Command& command = all[below(static_cast<std::uint32_t>(all.size()))];
        const bool travels = below(3) == 0;
        const std::size_t before = editor.document->history_cursor();
        std::string did = command.id;
        if (travels) {
            did = below(2) == 0 ? "edit.undo" : "edit.redo";
            ran += run_command(editor, did) ? 1 : 0;
        } else if (below(2) == 0) {
            did = "mouse";
            move_mouse(editor);
        } else if (!left_out(command.id)) {
            ran += run_command(editor, command.id) ? 1 : 0;
        }
        editor.message.reset();
        ASSERT_FALSE(editor.document->in_transaction()) << did;
        const std::size_t now = editor.document->history_cursor();
        const std::uint64_t state = state_of(*editor.document);
        const bool moved_on = now > before && did != "edit.redo";
        if (moved_on) known.erase(known.upper_bound(before), known.end());
        const auto found = known.find(now);
        if (found == known.end()) {
            known[now] = state;
        } else {
            ASSERT_EQ(found->second, state) << "after " << did << ", command " << i;
            ++compared;
        }
    }
    editor.document->go_to(0);
    EXPECT_EQ(state_of(*editor.document), known.at(0));
    const std::size_t end = editor.document->history().size();
    editor.document->go_to(end);
    if (const auto found = known.find(end); found != known.end()) {
        EXPECT_EQ(state_of(*editor.document), found->second);
    }
    EXPECT_GT(compared, static_cast<std::size_t>(count) / 4);
    EXPECT_GT(ran, static_cast<std::size_t>(count) / 10);
}

}  // namespace
}  // namespace slipface

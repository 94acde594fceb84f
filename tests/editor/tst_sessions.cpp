// Sessions that paint, save, are killed at any step and open the level again, two at a time, against a model
// of a few lines: nothing is lost, nothing is offered twice, newer work is never replaced.
#include <map>
#include <random>
#include <set>

#include "level_fixture.h"

namespace slipface {
namespace {

using Paint = std::vector<int>;  // [face] the type, -1: none

Paint paint_of(const Document& document) {
    Paint paint;
    for (FaceId face = 0; face < document.face_count(); ++face) {
        const std::optional<SurfaceId> type = document.paint_of(face);
        paint.push_back(type ? int{*type} : -1);
    }
    return paint;
}

// Three ways; where both changed a face, theirs.
Paint merged(const Paint& base, const Paint& mine, const Paint& theirs) {
    Paint paint = theirs;
    for (std::size_t face = 0; face < base.size(); ++face)
        if (theirs[face] == base[face]) paint[face] = mine[face];
    return paint;
}

struct Work {  // unsaved, in an autosave
    Paint paint, base;
};

struct Running {
    std::unique_ptr<Editor> editor;
    Paint base;  // of the level file that its unsaved changes add to
    std::optional<std::uint64_t> recovered, autosaved;
    double now_s = 0.0;
};

class Sessions : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        write_text(obj, floor_and_wall_obj(3));
    }

    std::uint64_t on_disk() const { return read_level_base(level_file)->content; }

    void start(Running& one, const Running& other) {
        one = {};
        one.editor = std::make_unique<Editor>();
        begin_session(*one.editor, {}, folder / "state");
        open_level(*one.editor, obj);
        ASSERT_FALSE(one.editor->message) << one.editor->message->text;
        one.base = paint_of(*one.editor->document);
        ASSERT_EQ(one.base, disk);
        std::set<std::uint64_t> offered, listed;
        for (const AutosaveInfo& row : one.editor->session.recoverable) {
            offered.insert(row.content);
            ASSERT_FALSE(row.saved_since);
        }
        for (const AutosaveInfo& row : one.editor->session.autosave.recoverable())
            listed.insert(row.content);
        for (const std::uint64_t content : listed) {
            ASSERT_FALSE(decided.contains(content)) << "offered twice";
            ASSERT_NE(content, on_disk()) << "it is saved";
        }
        if (decided.contains(on_disk())) decided.erase(on_disk());
        if (left.erase(on_disk()) > 0) decided.insert(on_disk());
        for (const auto& [content, work] : left)
            ASSERT_TRUE(content == other.recovered || listed.contains(content)) << "lost";
        if (listed.empty()) return;
        const std::vector<AutosaveInfo> rows = one.editor->session.autosave.recoverable();
        const AutosaveInfo row = rows[random() % rows.size()];
        switch (random() % 3) {
            case 0: return;  // not now
            case 1:
                discard_autosave(*one.editor, row);
                decided.insert(row.content);
                left.erase(row.content);
                return;
            default: break;
        }
        recover(*one.editor, row);
        one.editor->session.recoverable.clear();
        one.editor->message.reset();
        const Work& work = left.at(row.content);
        Document& document = *one.editor->document;
        ASSERT_EQ(paint_of(document), merged(work.base, work.paint, disk)) << "newer work was replaced";
        document.undo();
        ASSERT_EQ(paint_of(document), disk) << "a recovery can be undone";
        document.redo();
        one.recovered = row.content;
    }

    // Lets an autosave come due, and the file be looked at.
    void wait(Running& one) {
        bool shown_changed = false;
        for (int i = 0; i < 6; ++i)
            tick_session(*one.editor, one.now_s += 4.0, shown_changed);
        ASSERT_TRUE(one.editor->session.autosave.finish().ok());
        tick_session(*one.editor, one.now_s += 0.01, shown_changed);
        Document& document = *one.editor->document;
        if (!document.dirty() && !one.editor->session.changed) one.base = paint_of(document);
        if (one.editor->session.changed) answer(one);
        note_autosave(one);
    }
    void note_autosave(Running& one) {
        Document& document = *one.editor->document;
        if (!document.dirty()) return;
        bool shown_changed = false;
        for (int i = 0; i < 6; ++i)
            tick_session(*one.editor, one.now_s += 4.0, shown_changed);
        ASSERT_TRUE(one.editor->session.autosave.finish().ok());
        tick_session(*one.editor, one.now_s += 0.01, shown_changed);
        const std::uint64_t content = content_of(level_to_json(document.level()));
        decided.erase(content);
        one.autosaved = content;
        works[content] = {paint_of(document), one.base};
        if (one.recovered && *one.recovered != content) decide(*one.recovered);
    }
    void decide(std::uint64_t content) {
        if (left.erase(content) > 0) decided.insert(content);
    }
    void answer(Running& one) {
        Document& document = *one.editor->document;
        const Paint mine = paint_of(document);
        const auto choice = static_cast<ChangedAnswer>(random() % 3);
        answer_changed(*one.editor, choice);
        ASSERT_FALSE(one.editor->session.changed);
        one.editor->message.reset();
        const Paint now = paint_of(document);
        for (std::size_t face = 0; face < mine.size(); ++face) {
            const bool unchanged = mine[face] == one.base[face];
            const int wanted = choice == ChangedAnswer::keep_mine                  ? mine[face]
                               : choice == ChangedAnswer::take_theirs || unchanged ? disk[face]
                                                                                   : mine[face];
            ASSERT_EQ(now[face], wanted) << face;
        }
        if (choice != ChangedAnswer::keep_mine) {
            document.undo();
            ASSERT_EQ(paint_of(document), mine);
            document.redo();
        }
        one.base = disk;
        if (!document.dirty()) is_safe(one);
    }
    void is_safe(Running& one) {
        if (one.recovered) decide(*one.recovered);
        one.recovered.reset();
        one.autosaved.reset();
    }
    void save(Running& one) {
        save_level(*one.editor);
        if (one.editor->session.changed) answer(one);
        if (one.editor->document->dirty()) return;
        one.base = disk = paint_of(*one.editor->document);
        is_safe(one);
    }
    void kill(Running& one) {
        Document& document = *one.editor->document;
        if (!one.editor->session.changed && random() % 3 == 0) {
            // In the middle of a save.
            if (read_level_base(level_file)->content == document.base().content && document.dirty()) {
                one.editor->session.autosave.write_now(document, document.level().file_path);
                one.autosaved = content_of(level_to_json(document.level()));
                decided.erase(*one.autosaved);
                works[*one.autosaved] = {paint_of(document), one.base};
                if (one.recovered && *one.recovered != *one.autosaved) decide(*one.recovered);
                if (random() % 2 == 0) {
                    ASSERT_TRUE(document.save());
                    disk = paint_of(document);
                }
            }
        }
        one.editor->session.autosave.abandon();
        if (one.autosaved) left[*one.autosaved] = works[*one.autosaved];
        one = {};
    }

    std::mt19937 random;
    Paint disk;
    std::map<std::uint64_t, Work> works, left;  // [content]
    std::set<std::uint64_t> decided;
};

TEST_F(Sessions, LoseNothingOfferNothingTwiceReplaceNothingNewer) {
    for (unsigned seed = 0; seed < 15; ++seed) {
        SCOPED_TRACE(seed);
        random.seed(seed);
        std::filesystem::remove_all(folder / "state");
        std::filesystem::remove(level_file);
        disk = paint_of(*open());
        works.clear();
        left.clear();
        decided.clear();
        Running running[2];
        for (int step = 0; step < 40 && !HasFatalFailure(); ++step) {
            SCOPED_TRACE(step);
            const std::size_t which = random() % 2;
            Running& one = running[which];
            if (!one.editor) {
                start(one, running[1 - which]);
                continue;
            }
            switch (random() % 6) {
                case 0: save(one); break;
                case 1: kill(one); break;
                case 2: wait(one); break;
                default: {
                    const auto face = static_cast<FaceId>(random() % 12);
                    const auto type = static_cast<SurfaceId>(random() % 4);
                    one.editor->document->paint(std::span(&face, 1),
                                                type == 3 ? std::nullopt : std::optional(type));
                }
            }
        }
        for (Running& one : running)
            if (one.editor) one.editor->session.autosave.abandon();
        if (HasFatalFailure()) return;
    }
}

}  // namespace
}  // namespace slipface

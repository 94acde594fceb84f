// Exceptions cost the action in which they are thrown: the document is as before, or the action is done.
#include <cstdlib>
#include <new>
#include <random>
#include <stdexcept>

#include "document/background.h"
#include "level_fixture.h"
#include "tools/session/failed_action.h"

namespace {
// Of this thread: how many allocations succeed before one fails; below 0: all do.
thread_local long allocations_left = -1;

void* allocate(std::size_t size) {
    if (allocations_left == 0) {
        allocations_left = -1;
        throw std::bad_alloc();
    }
    if (allocations_left > 0) --allocations_left;
    if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) {
    return allocate(size);
}
void* operator new[](std::size_t size) {
    return allocate(size);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace slipface {
namespace {

class FailedAction : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        begin_session(editor, {}, folder / "state");
        open_level(editor, obj);
    }
    Document& document() { return *editor.document; }
    void act(unsigned which) {
        std::vector<FaceId> faces;
        for (int i = 0; i < 5; ++i)
            faces.push_back(static_cast<FaceId>(random() % face_count));
        const auto type = static_cast<SurfaceId>(random() % 4);
        switch (which % 9) {
            case 0: document().paint(faces, type); break;
            case 1: document().select(faces); break;
            case 2: document().hide(faces, "Hide"); break;
            case 3: document().undo(); break;
            case 4: document().redo(); break;
            case 5: document().set_saved_selections({{"a", faces}}, "Save selection"); break;
            case 6: document().rename_surface(1, "type " + std::to_string(random() % 100)); break;
            case 7: document().set_rules({{"fl*", "ladder"}, {"w*", "ice"}}); break;
            default: {
                Transaction both(document(), "Two");
                document().paint(faces, type);
                document().hide({faces[0]}, {});
                both.commit();
            }
        }
    }
    std::string state() { return level_to_json(document().level()); }

    Editor editor;
    std::mt19937 random{3};
};

TEST_F(FailedAction, LeavesTheDocumentAsItWas) {
    int failed = 0;
    for (int round = 0; round < 1500; ++round) {
        const std::string before = state();
        const std::size_t selected = document().selection().size();
        const Checkpoint start = checkpoint(editor);
        const auto which = static_cast<unsigned>(random());
        bool threw = false;
        allocations_left = static_cast<long>(random() % 40);
        try {
            act(which);
        } catch (const std::bad_alloc&) {
            threw = true;
        }
        allocations_left = -1;
        if (!threw) continue;
        ++failed;
        action_failed(editor, start, "out of memory");
        ASSERT_EQ(state(), before) << "action " << which % 9;
        ASSERT_EQ(document().selection().size(), selected);
        ASSERT_EQ(document().history_mark(), start.mark);
        ASSERT_FALSE(document().in_transaction());
        const ResolvedSurfaces fresh = resolve_surfaces(document().level());
        ASSERT_EQ(document().resolved().surface, fresh.surface);
        ASSERT_TRUE(editor.message);
        editor.message.reset();
    }
    EXPECT_GT(failed, 300);
    // History still leads to the beginning and back.
    const std::string end = state();
    document().go_to(0);
    EXPECT_EQ(state(), level_to_json(open()->level()));
    document().go_to(document().history().size());
    document().go_to(document().history().size());
    EXPECT_FALSE(end.empty());
}

TEST_F(FailedAction, AStrokeThatFailsIsCancelledAndUnsavedWorkIsAutosaved) {
    const FaceId face = 3, next = 4;
    document().paint(std::span(&face, 1), ice);
    const Checkpoint start = checkpoint(editor);
    document().begin("Stroke");
    document().paint(std::span(&next, 1), ice);
    editor.live_edit = true;
    action_failed(editor, start, "it broke");
    EXPECT_FALSE(document().in_transaction());
    EXPECT_FALSE(editor.live_edit);
    EXPECT_EQ(document().surface_of(3), ice);
    EXPECT_NE(document().surface_of(4), ice);
    ASSERT_TRUE(editor.message);
    EXPECT_NE(editor.message->text.find("it broke"), std::string::npos);
    EXPECT_NE(editor.message->text.find("autosaved"), std::string::npos);
    editor.session.autosave.abandon();
    AutosaveSession next_session(folder / "state" / "autosave");
    ASSERT_EQ(next_session.recoverable().size(), 1u);
}

TEST_F(FailedAction, AJobThatThrowsIsAnError) {
    Background<Result<int>> out_of_memory([](Progress&) -> Result<int> { throw std::bad_alloc(); }, {});
    const Result<int> result = out_of_memory.take();
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, "out of memory");
    Background<Result<int>> broken([](Progress&) -> Result<int> { throw std::runtime_error("it broke"); },
                                   {});
    EXPECT_EQ(broken.take().error().message, "it broke");
}

}  // namespace
}  // namespace slipface

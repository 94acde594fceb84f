// The real window used by hand, in real time. What is checked holds for every widget and every command of the
// tables: a new one is covered by itself. By default a few drawn ones; with SLIPFACE_WINDOW_WHOLE=1 all of
// them (scripts/window_test.sh). SLIPFACE_WINDOW_LEVEL: the level to open instead of a small one.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <set>

#include "app/parts.h"
#include "editor/layout_check.h"
#include "editor/level_fixture.h"
#include "panels/viewport_panel.h"
#include "person.h"
#include "tools/commands/commands.h"
#include "tools/view/panes.h"

namespace slipface {
namespace {

struct Size {
    int width, height;
    float scale;
};
std::ostream& operator<<(std::ostream& out, const Size& size) {
    return out << size.width << "x" << size.height << "@" << size.scale;
}

bool whole() {
    return std::getenv("SLIPFACE_WINDOW_WHOLE") != nullptr;
}

class ByHand : public LevelFixture, public testing::WithParamInterface<Size> {
  protected:
    void use(const std::function<void(Person&)>& act) {
        WindowOptions options;
        options.width = GetParam().width;
        options.height = GetParam().height;
        options.scale = GetParam().scale;
        options.config = folder / "config";
        options.state = folder / "state";
        std::filesystem::create_directories(options.config);
        write_text(options.config / "preferences", "tour.done = on\n");
        const char* const other = std::getenv("SLIPFACE_WINDOW_LEVEL");
        options.level = other ? std::filesystem::path(other) : obj;
        Person::use(options, [&](Person& person) {
            ASSERT_TRUE(person.wait_for([](App& app) { return app.editor().document != nullptr; }));
            person.look([](App& app) { app.editor().import_card.shown = false; });
            person.move_to(edge());
            person.settle();
            act(person);
        });
    }
    // Over the status bar, where the mouse points at nothing.
    ImVec2 edge() const {
        return {0.5f * static_cast<float>(GetParam().width), static_cast<float>(GetParam().height) - 6.0f};
    }
    // The middle of the view, or another part of it.
    static ImVec2 in_view(Person& person, float across = 0.5f, float down = 0.5f) {
        return person.ask<ImVec2>([&](App&) {
            const ViewportState& view = viewport_state();
            return ImVec2{view.min.x + across * view.size.x, view.min.y + down * view.size.y};
        });
    }
    void expect_tidy(Person& person, const std::string& what) {
        std::vector<std::string> defects;
        person.look([&](App&) {
            defects =
                layout_defects(static_cast<float>(GetParam().width), static_cast<float>(GetParam().height));
        });
        for (const std::string& defect : defects)
            ADD_FAILURE() << what << ": " << defect;
    }
    // All, or some of them.
    template <class Things>
    static Things drawn_from(Things things, std::size_t some) {
        if (whole()) return things;
        std::mt19937 random(2045);
        std::shuffle(things.begin(), things.end(), random);
        if (things.size() > some) things.resize(some);
        return things;
    }
};

TEST_P(ByHand, TooltipsComeWhileTheMouseRests) {
    use([&](Person& person) {
        std::vector<std::pair<std::string, ImVec2>> places;
        person.look([&](App&) {
            for (const auto& [path, rect] : ui::widgets())
                if (rect.has_tooltip && rect.visible) places.emplace_back(path, rect.centre());
        });
        EXPECT_GT(places.size(), 15u);
        for (const auto& [path, at] : drawn_from(places, 8)) {
            person.move_to(edge());
            person.move_to(at);
            EXPECT_TRUE(person.wait_for([](App&) {
                return std::any_of(ui::widgets().begin(), ui::widgets().end(),
                                   [](const auto& entry) { return entry.first.ends_with("Tooltip"); });
            })) << path;
        }
        person.picture("tooltip");
    });
}

TEST_P(ByHand, AWindowThatIsSearchedHasTheKeyboardAtOnce) {
    use([&](Person& person) {
        for (const auto& [key, path] :
             {std::pair("F1", "Shortcuts/Filter"), std::pair("ctrl+p", "Commands/Find a command")}) {
            const auto before =
                person.ask<std::uint64_t>([](App& app) { return app.editor().document->revision(); });
            const auto tool = person.ask<Tool>([](App& app) { return app.editor().tool; });
            person.type_after(key, "bound");  // nobody waits for a window
            EXPECT_TRUE(person.comes(path));
            EXPECT_TRUE(person.truth([](App&) { return ui::typing(); })) << path;
            EXPECT_EQ(person.ask<Tool>([](App& app) { return app.editor().tool; }), tool);
            EXPECT_EQ(person.ask<std::uint64_t>([](App& app) { return app.editor().document->revision(); }),
                      before);
            expect_tidy(person, path);
            person.picture("search");
            person.key("Escape");
            person.key("Escape");
        }
        EXPECT_FALSE(person.truth(
            [](App& app) { return app.editor().show_shortcuts || app.editor().show_command_palette; }));
    });
}

TEST_P(ByHand, ClicksSlowQuickAndShaking) {
    use([&](Person& person) {
        const auto selected = [&] {
            return person.ask<std::size_t>(
                [](App& app) { return app.editor().document->selection().size(); });
        };
        person.key("q");
        // On a floor of many faces: in the middle of `easy` is a turntable of one.
        const ImVec2 at =
            std::getenv("SLIPFACE_WINDOW_LEVEL") ? in_view(person, 0.4f, 0.75f) : in_view(person);
        person.click(at);
        EXPECT_EQ(selected(), 1u);
        person.rest(1.2);
        person.click({at.x + 2, at.y + 1});
        EXPECT_LE(selected(), 1u) << "two slow clicks select the face behind, not the whole plane";
        person.key("ctrl+shift+a");
        person.double_click(at);
        EXPECT_GT(selected(), 1u) << "a double click selects the plane";
        // The context menu, and what it does.
        const auto view = person.ask<ViewCamera>([](App& app) { return app.editor().view; });
        person.click(in_view(person, 0.55f, 0.55f), 3);
        EXPECT_TRUE(person.comes("View menu/Set spawn point"));
        EXPECT_TRUE(view == person.ask<ViewCamera>([](App& app) { return app.editor().view; }));
        expect_tidy(person, "view menu");
        person.picture("context-menu");
        person.click_widget("View menu/Set spawn point");
        EXPECT_TRUE(person.truth([](App& app) { return app.editor().document->dirty(); }));
        person.drag(in_view(person), in_view(person, 0.6f, 0.5f), 3);
        EXPECT_FALSE(person.shows("View menu/Set spawn point"));
        EXPECT_FALSE(view == person.ask<ViewCamera>([](App& app) { return app.editor().view; }));
        // A digit is a brush; a stroke paints with it.
        person.key("2");
        EXPECT_TRUE(person.truth([](App& app) { return app.editor().tool == Tool::select; }));
        person.key("b");
        person.drag(in_view(person, 0.4f, 0.6f), in_view(person, 0.6f, 0.6f));
        person.picture("stroke");
        // The wheel comes near and stops.
        person.move_to(in_view(person, 0.5f, 0.6f));
        person.wheel(30);
        EXPECT_TRUE(person.truth([](App& app) {
            const Camera camera = app.editor().view.camera();
            const auto hit = app.editor().document->pick(camera.eye, camera.target - camera.eye, false);
            return hit && (hit->point - camera.eye).norm() > camera.near_plane;
        }));
        person.key("Home");
        expect_tidy(person, "after all");
    });
}

// As a person's window looks: with a selection, a camera, a saved selection, and a step that can be undone.
void furnish(App& app) {
    Editor& editor = app.editor();
    editor.document->select({0, 1, 2});
    run_command(editor, "select.save");
    run_command(editor, "camera.add");
    const FaceId face = 5;
    editor.document->paint(std::span(&face, 1), SurfaceId{1});
    editor.document->paint(std::span(&face, 1), SurfaceId{2});
    editor.document->undo();
    editor.document->select({3, 4});
}

TEST_P(ByHand, EveryMenuItemThatIsEnabledDoesSomethingOrSaysWhyNot) {
    use([&](Person& person) {
        Editor before;  // its plain members only
        std::size_t history = 0;
        person.look([&](App& app) {
            furnish(app);
            history = app.editor().document->history_cursor();
            before.layout = app.editor().layout;
            before.view = app.editor().view;
            before.style = app.editor().style;
        });
        std::vector<const Command*> rows;
        for (const Command& command : commands())
            if (*command.menu && std::string_view(command.id) != "file.quit") rows.push_back(&command);
        std::size_t clicked = 0;
        for (const Command* const command : drawn_from(rows, 10)) {
            SCOPED_TRACE(command->id);
            person.look([&](App& app) {
                Editor& editor = app.editor();
                while (editor.document->history_cursor() > history)
                    editor.document->undo();
                editor.layout = before.layout;
                editor.style = before.style;
                editor.tool = Tool::select;
                set_pane_count(editor, 1);
                editor.view = before.view;
                set_zoom(editor, 1.0);
                editor.message.reset();
                editor.status.clear();
            });
            if (!person.truth([&](App& app) { return command->enabled(app.editor()); })) continue;
            person.move_to({edge().x, edge().y - 1});
            person.move_to(edge());
            person.settle();
            const auto seen = person.ask<std::uint64_t>([](App& app) { return app.frame_hash(); });
            person.click_menu(std::string(command->menu) + "/" + command->label);
            ++clicked;
            person.move_to(edge());
            person.settle();
            const bool moves = person.truth([](App& app) { return app.next_frame_s() <= 0.0; });
            EXPECT_TRUE(moves || person.ask<std::uint64_t>([](App& app) { return app.frame_hash(); }) != seen)
                << "nothing is seen of it";
            if (!moves) expect_tidy(person, command->id);
            if (clicked % 20 == 1) person.picture(command->id);
            for (int i = 0; i < 5; ++i)
                if (person.truth([](App& app) {
                        const Editor& editor = app.editor();
                        return dialog_is_open(editor) || editor.playtest || editor.show_shortcuts ||
                               editor.show_command_palette || editor.session.help ||
                               editor.session.tour >= 0 || editor.layout.focus || editor.import_card.shown;
                    }))
                    person.key("Escape");
        }
        EXPECT_GT(clicked, whole() ? 100u : 4u);
    });
}

// A large interface leaves room for the level and for the types.
TEST_P(ByHand, TheViewAndTheTypesHaveRoomBesideATimeline) {
    use([&](Person& person) {
        person.look([](App& app) { app.editor().layout.show(PanelId::timeline); });
        person.move_to({edge().x, edge().y - 1});
        person.settle();
        person.look([&](App& app) {
            EXPECT_GE(viewport_state().size.x, 0.5f * static_cast<float>(GetParam().width));
            EXPECT_GE(viewport_state().size.y, 0.4f * static_cast<float>(GetParam().height));
            std::size_t types = 0;
            for (const SurfaceType& type : app.editor().document->level().surfaces) {
                const auto found = ui::widgets().find("Palette/" + type.name);
                types += found != ui::widgets().end() && found->second.visible ? 1 : 0;
            }
            EXPECT_GE(types, 7u);
        });
        expect_tidy(person, "timeline");
        person.picture("timeline");
    });
}

std::vector<Size> sizes() {
    if (whole()) return {{1280, 720, 1}, {1280, 720, 2}, {1920, 1080, 1}, {1920, 1080, 2}};
    return {{1280, 720, 1}, {1920, 1080, 2}};
}
INSTANTIATE_TEST_SUITE_P(Sizes, ByHand, testing::ValuesIn(sizes()), [](const auto& test) {
    return fmt::format("{}x{}at{}", test.param.width, test.param.height, static_cast<int>(test.param.scale));
});

}  // namespace
}  // namespace slipface

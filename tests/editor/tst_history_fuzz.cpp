// Ten thousand random commands: going back and forth in the history must always meet the same states again.
#include <map>
#include <random>

#include "level_fixture.h"
#include "slipface/base/hash.h"

namespace slipface {
namespace {

using HistoryFuzz = LevelFixture;

std::uint64_t state_of(const Document& document) {
    Hasher hasher;
    hasher.text(level_to_json(document.level()));
    for (const FaceId face : document.selection())
        hasher.u64(face);
    for (const FaceId face : document.hidden()) {
        hasher.u64(1);
        hasher.u64(face);
    }
    for (const SavedSelection& saved : document.saved_selections()) {
        hasher.text(saved.name);
        for (const FaceId face : saved.faces)
            hasher.u64(face);
    }
    return hasher.value();
}

class Monkey {
  public:
    Monkey(Document& document, std::uint32_t seed) : document_(document), random_(seed) {}

    enum class Did { change, travel, save };

    Did act() {
        const std::uint32_t choice = below(20);
        if (choice < 5) {
            transaction();
            return Did::change;
        }
        if (choice < 9) {
            document_.undo();
            return Did::travel;
        }
        if (choice < 12) {
            document_.redo();
            return Did::travel;
        }
        if (choice == 12) {
            document_.go_to(below(static_cast<std::uint32_t>(document_.history().size()) + 2));
            return Did::travel;
        }
        if (choice == 13 && below(8) == 0) {
            EXPECT_TRUE(document_.save().ok());
            EXPECT_FALSE(document_.dirty());
            return Did::save;
        }
        change();
        return Did::change;
    }

    std::uint32_t below(std::uint32_t limit) {
        return limit == 0 ? 0 : static_cast<std::uint32_t>(random_() % limit);
    }

    void change() {
        switch (below(13)) {
            case 0:
            case 1:
            case 2: document_.paint(faces(), below(4) == 0 ? std::nullopt : std::optional(surface())); return;
            case 3: return document_.select(faces());
            case 4: {
                MovementSettings movement = document_.level().movement;
                const auto& info =
                    settings_table()[below(static_cast<std::uint32_t>(settings_table().size()))];
                const double fraction = below(3) * 0.5;
                static_cast<void>(
                    set_setting(movement, info, info.minimum + fraction * (info.maximum - info.minimum)));
                return document_.set_movement(movement, "Change movement");
            }
            case 5: return document_.set_spawn({Vec3(below(3), below(3), below(3)), 0.25 * below(3)});
            case 6:
                return document_.set_rules(
                    below(2) == 0 ? std::vector<MaterialRule>{}
                                  : std::vector<MaterialRule>{{"fl*", "ice"}, {"wall*", "sticky"}});
            case 7: return document_.hide(faces(), "Hide");
            case 8: {
                std::vector<SavedSelection> saved(document_.saved_selections().begin(),
                                                  document_.saved_selections().end());
                if (saved.size() > 4) saved.clear();
                saved.push_back({"set " + std::to_string(below(9)), faces()});
                return document_.set_saved_selections(std::move(saved), "Save selection");
            }
            case 9:
                return document_.set_cameras(
                    below(2) == 0
                        ? std::vector<CameraBookmark>{}
                        : std::vector<CameraBookmark>{{"here", Vec3(below(3), 1, 0), Vec3::Zero(), 1.0}});
            case 10:
            case 11: return change_props();
            default: return change_types();
        }
    }

  private:
    std::vector<FaceId> faces() {
        std::vector<FaceId> chosen(below(12));
        for (FaceId& face : chosen)
            face = below(static_cast<std::uint32_t>(document_.face_count()) + 8);  // a few beyond the level
        return chosen;
    }
    SurfaceId surface() {
        return static_cast<SurfaceId>(below(static_cast<std::uint32_t>(document_.level().surfaces.size())));
    }

    void change_types() {
        std::vector<SurfaceType> surfaces = document_.level().surfaces;
        switch (below(4)) {
            case 0:
                if (surfaces.size() > 12) return;
                surfaces.push_back({});
                surfaces.back().name = "type " + std::to_string(random_());
                return document_.set_surfaces(std::move(surfaces), "Add type");
            case 1:
                surfaces[surface()].friction = 0.25 * below(4);
                return document_.set_surfaces(std::move(surfaces), "Change friction");
            case 2: return document_.rename_surface(surface(), "name " + std::to_string(below(30)));
            default: return document_.remove_surface(surface());
        }
    }

    // Adds, copies, removes, replaces or moves one.
    void change_props() {
        std::vector<Prop> props = document_.level().props;
        std::vector<std::uint32_t> from = every_prop(document_.level());
        const std::uint32_t choice = below(5), at = below(static_cast<std::uint32_t>(props.size()));
        const std::string name = "prop " + std::to_string(random_());
        if (choice == 0 || props.empty()) {
            if (props.size() > 5) return;
            Prop prop;
            prop.name = name;
            prop.mesh = below(3) == 0 ? "post.obj" : "box.obj";
            props.insert(props.begin() + at, prop);
            from.insert(from.begin() + at, no_id);
        } else if (choice == 1) {
            props.push_back(props[at]);
            props.back().name = name;
            from.push_back(at);
        } else if (choice == 2) {
            props.erase(props.begin() + at);
            from.erase(from.begin() + at);
        } else if (choice == 3) {
            props[at].mesh = props[at].mesh == "box.obj" ? "post.obj" : "box.obj";
        } else {
            props[at].position.x() += 0.5;
        }
        document_.set_props(std::move(props), from, "Change props");
    }

    void transaction() {
        document_.begin("Several changes");
        const std::uint32_t changes = below(6);
        for (std::uint32_t i = 0; i < changes; ++i) {
            change();
            document_.undo();  // must not do anything now
        }
        if (below(3) == 0)
            document_.cancel();
        else
            document_.commit();
    }

    Document& document_;
    std::mt19937 random_;
};

TEST_F(HistoryFuzz, EveryStateIsMetAgain) {
    write_text(folder / "box.obj",
               "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\n"
               "f 5 8 7 6\nf 1 2 3 4\nf 4 3 7 8\nf 2 1 5 6\nf 3 2 6 7\nf 1 4 8 5\n");
    write_text(folder / "post.obj", "v 0 0 0\nv 0.3 0 0\nv 0.3 2 0\nv 0 2 0.1\nf 1 2 3 4\nf 1 4 2\n");
    const auto document = open();
    ASSERT_TRUE(document->save().ok());
    Monkey monkey(*document, 20240607);
    std::vector<std::uint64_t> states{state_of(*document)};  // [cursor]
    std::size_t undone = 0, dirty = 0;
    std::uint64_t last_revision = document->revision();
    for (int i = 0; i < 10000; ++i) {
        const std::size_t cursor = document->history_cursor();
        const Monkey::Did did = monkey.act();
        const std::size_t now = document->history_cursor();
        const std::uint64_t state = state_of(*document);
        if (did == Monkey::Did::change && now != cursor) {
            // A new step, and the end of every future there was.
            ASSERT_EQ(now, cursor + 1);
            ASSERT_EQ(document->history().size(), now);
            states.resize(now);
            states.push_back(state);
        }
        ASSERT_EQ(state, states[now]) << "command " << i << ", at step " << now;
        if (now < cursor) ++undone;
        if (document->dirty())
            ++dirty;
        else
            ASSERT_EQ(read_text(level_file), level_to_json(document->level())) << "command " << i;
        ASSERT_GE(document->revision(), last_revision);
        last_revision = document->revision();
    }
    EXPECT_GT(undone, 1000u);  // the walk did go back and forth
    EXPECT_GT(dirty, 1000u);

    for (std::size_t at = document->history_cursor() + 1; at-- > 0;) {
        ASSERT_EQ(state_of(*document), states[at]);
        document->undo();
    }
    for (std::size_t at = 0; at <= document->history().size(); ++at) {
        ASSERT_EQ(state_of(*document), states[at]);
        document->redo();
    }
    const ResolvedSurfaces fresh = resolve_surfaces(document->level());
    EXPECT_EQ(document->resolved().surface, fresh.surface);
    EXPECT_EQ(document->resolved().source, fresh.source);
    for (FaceId face = 0; face < face_count; ++face)
        EXPECT_EQ(document->collision().face_surface(face), fresh.surface[face]);
}

}  // namespace
}  // namespace slipface

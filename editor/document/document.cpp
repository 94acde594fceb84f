// An open level: reading, changing and writing it.
#include "document/document.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <functional>
#include <map>
#include <utility>

#include "document/faces.h"
#include "slipface/base/files.h"

namespace slipface {
namespace {

bool same_names(const std::vector<SurfaceType>& a, const std::vector<SurfaceType>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const SurfaceType& x, const SurfaceType& y) { return x.name == y.name; });
}

// Ascending, each once, none beyond the level.
void tidy(std::vector<FaceId>& faces, std::size_t face_count) {
    if (std::adjacent_find(faces.begin(), faces.end(), std::greater_equal<FaceId>()) != faces.end()) {
        std::sort(faces.begin(), faces.end());
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    }
    faces.erase(std::lower_bound(faces.begin(), faces.end(), face_count), faces.end());
}

std::string paint_step_name(const Level& level, std::optional<SurfaceId> surface) {
    return surface ? "Paint " + level.surfaces[*surface].name : "Unset faces";
}

}  // namespace

Document::Document() {
    static std::atomic<std::uint64_t> documents = 0;
    constexpr int changes_bits = 40;
    revision_ = face_revision_ = ++documents << changes_bits;
}

Result<std::unique_ptr<Document>> Document::open(const std::filesystem::path& path, Progress* progress) {
    try {
        // The text before and after the level is loaded: the same, unless it was written meanwhile.
        const std::filesystem::path file = path.extension() == ".json" ? path : level_file_for(path);
        Result<LevelBase> base = read_level_base(file);
        Result<LoadedLevel> loaded = load_level(path, progress);
        constexpr int max_tries = 5;
        for (int tries = 1; base && loaded && tries < max_tries; ++tries) {
            const std::uint64_t before = base->content;
            base = read_level_base(file);
            if (base && base->content == before) break;
            loaded = load_level(path, progress);
        }
        if (!loaded) return loaded.error();
        if (!base) return base.error();
        std::unique_ptr<Document> document(new Document);
        document->level_ = std::move(loaded->level);
        document->warnings_ = std::move(loaded->warnings);
        document->match_ = loaded->match;
        document->second_ = std::move(loaded->second);
        document->base_ = std::move(*base);
        document->level_.overrides.resize(
            std::max(document->level_.overrides.size(), own_mesh(document->level_)->face_count()));
        begin_stage(progress, "Building the collision world", 1.0, 1.0);
        if (const Status status = document->rebuild_geometry(); !status) return status.error();
        document->resolve_again();
        if (cancelled(progress)) return cancelled_error(path);
        return document;
    } catch (const std::exception& exception) {
        return Error{path.string(), std::string("cannot be opened: ") + exception.what()};
    }
}

Status Document::save() {
    return save_as(level_.file_path);
}

Status Document::save_as(const std::filesystem::path& level_file) {
    std::error_code ignored;
    if (level_file.empty()) return Error{"", "no file name was given; expected NAME.slipface.json"};
    if (level_file == level_.mesh_path || std::filesystem::equivalent(level_file, level_.mesh_path, ignored))
        return Error{level_file.string(), "is the level's geometry; expected another name, such as " +
                                              level_file_for(level_.mesh_path).filename().string()};
    // A copy, because save() hands in level_.file_path itself.
    const std::filesystem::path before = std::exchange(level_.file_path, std::filesystem::path(level_file));
    try {
        LevelBase written = level_base(level_to_json(level_));
        if (Status status = write_file_atomic(level_.file_path, *written.text); !status) {
            level_.file_path = before;
            return status;
        }
        base_ = std::move(written);
    } catch (const std::exception& error) {
        level_.file_path = before;
        return Error{level_file.string(), std::string("could not be written: ") + error.what()};
    }
    // A stroke in progress may still change what was written.
    if (open_step_.changes_file())
        saved_cursor_.reset();
    else
        saved_cursor_ = cursor_;
    ++revision_;
    return {};
}

std::size_t Document::paint(std::span<const FaceId> faces, std::optional<SurfaceId> surface) {
    if (surface && *surface >= level_.surfaces.size()) return 0;
    FaceEdit edit;
    edit.faces.resize(faces.size());
    const std::size_t all = face_count();
    std::size_t count = 0;
    for (const FaceId face : faces) {
        if (face >= all) continue;
        const std::optional<SurfaceId> before = paint_of(face);
        edit.faces[count] = {face, before, surface};
        count += before != surface ? 1 : 0;
    }
    edit.faces.resize(count);
    const auto not_earlier = [](const FaceEdit::Face& a, const FaceEdit::Face& b) {
        return a.face >= b.face;
    };
    if (std::adjacent_find(edit.faces.begin(), edit.faces.end(), not_earlier) != edit.faces.end()) {
        std::ranges::sort(edit.faces, {}, &FaceEdit::Face::face);
        const auto same = [](const FaceEdit::Face& a, const FaceEdit::Face& b) { return a.face == b.face; };
        edit.faces.erase(std::unique(edit.faces.begin(), edit.faces.end(), same), edit.faces.end());
    }
    const std::size_t changed = edit.faces.size();
    Transaction transaction(*this, paint_step_name(level_, surface));
    if (changed > 0) perform({}, std::move(edit));
    accept_guessed(faces);  // whatever the user paints is no guess
    transaction.commit();
    return changed;
}

template <class ValueOf>
void Document::change(ValueEdit<ValueOf> edit, std::string step_name) {
    if (!(edit.before == edit.after)) perform(std::move(step_name), std::move(edit));
}

void Document::select(std::vector<FaceId> faces, std::string step_name) {
    tidy(faces, face_count());
    if (!level_.hidden.empty()) std::erase_if(faces, [this](FaceId face) { return is_hidden(face); });
    if (faces == selection_) return;
    if (step_name.empty()) step_name = faces.empty() ? "Select nothing" : "Select faces";
    perform(std::move(step_name), SelectionEdit{selection_, std::move(faces)});
}

void Document::hide(std::vector<FaceId> faces, std::string step_name) {
    tidy(faces, face_count());
    if (faces == level_.hidden) return;
    Transaction transaction(*this, std::move(step_name));
    perform({}, HiddenEdit{level_.hidden, std::move(faces)});
    select({selection_.begin(), selection_.end()});
    transaction.commit();
}

void Document::set_saved_selections(std::vector<SavedSelection> selections, std::string step_name) {
    if (selections.size() > max_saved_selections) return;
    for (SavedSelection& saved : selections)
        tidy(saved.faces, face_count());
    change(SavedSelectionsEdit{level_.selections, std::move(selections)}, std::move(step_name));
}

void Document::set_movement(const MovementSettings& movement, std::string step_name) {
    change(MovementEdit{level_.movement, movement}, std::move(step_name));
}

void Document::set_surfaces(std::vector<SurfaceType> surfaces, std::string step_name) {
    if (surfaces.empty() || surfaces.size() > max_surface_types) return;
    const bool painted_beyond =
        surfaces.size() < level_.surfaces.size() &&
        std::any_of(level_.overrides.begin(), level_.overrides.end(),
                    [&](std::optional<SurfaceId> painted) { return painted && *painted >= surfaces.size(); });
    if (!painted_beyond) change(SurfacesEdit{level_.surfaces, std::move(surfaces)}, std::move(step_name));
}

std::string Document::rename_problem(SurfaceId surface, std::string_view name) const {
    if (surface >= level_.surfaces.size()) return "The type does not exist";
    if (level_.surfaces[surface].name == name) return {};
    if (surface == default_surface) return "The default type keeps its name";
    if (name.empty()) return "A type needs a name";
    if (find_surface(level_, name)) return "Another type has this name";
    return {};
}

void Document::rename_surface(SurfaceId surface, const std::string& name) {
    if (!rename_problem(surface, name).empty()) return;
    const std::string old = level_.surfaces[surface].name;
    Transaction transaction(*this, "Rename " + old);
    std::vector<SurfaceType> surfaces = level_.surfaces;
    surfaces[surface].name = name;
    std::vector<MaterialRule> rules = level_.rules;
    for (MaterialRule& rule : rules)
        if (rule.type == old) rule.type = name;
    std::vector<Orphan> orphans = level_.orphans;
    for (Orphan& orphan : orphans)
        if (orphan.type == old) orphan.type = name;
    change(SurfacesEdit{level_.surfaces, std::move(surfaces)}, {});
    change(RulesEdit{level_.rules, std::move(rules)}, {});
    change(OrphansEdit{level_.orphans, std::move(orphans)}, {});
    std::vector<Prop> props = level_.props;
    for (Prop& prop : props)
        if (prop.type == old) prop.type = name;
    set_props(std::move(props), every_prop(level_), {});
    transaction.commit();
}

std::string Document::removal_problem(SurfaceId surface) const {
    if (surface >= level_.surfaces.size()) return "The type does not exist";
    if (surface == default_surface) return "Every level has the default type";
    const std::string& name = level_.surfaces[surface].name;
    if (const std::size_t count = face_count_of(surface); count > 0)
        return count == 1 ? "1 face has this type" : std::to_string(count) + " faces have this type";
    if (std::any_of(level_.rules.begin(), level_.rules.end(),
                    [&](const MaterialRule& rule) { return rule.type == name; }))
        return "A material rule gives this type";
    if (std::any_of(level_.orphans.begin(), level_.orphans.end(),
                    [&](const Orphan& orphan) { return orphan.type == name; }))
        return "An orphaned face has this type";
    if (std::ranges::count(level_.props, name, &Prop::type) > 0) return "A prop has this type";
    return {};
}

void Document::remove_surface(SurfaceId surface) {
    if (!removal_problem(surface).empty()) return;
    Transaction transaction(*this, "Remove " + level_.surfaces[surface].name);
    FaceEdit moved;
    for (std::size_t face = 0; face < level_.overrides.size(); ++face) {
        const std::optional<SurfaceId> painted = level_.overrides[face];
        if (painted && *painted > surface)
            moved.faces.push_back({static_cast<FaceId>(face), painted, static_cast<SurfaceId>(*painted - 1)});
    }
    if (!moved.faces.empty()) perform({}, std::move(moved));
    std::vector<SurfaceType> surfaces = level_.surfaces;
    surfaces.erase(surfaces.begin() + surface);
    set_surfaces(std::move(surfaces), {});
    transaction.commit();
}

void Document::set_rules(std::vector<MaterialRule> rules, std::string step_name) {
    change(RulesEdit{level_.rules, std::move(rules)}, std::move(step_name));
}

void Document::set_spawn(const Spawn& to) {
    std::vector<Spawn> spawns = all_spawns(level_);
    if (spawns.empty()) spawns.emplace_back();
    spawns.front().position = to.position;
    spawns.front().yaw = to.yaw;
    set_spawns(std::move(spawns), "Set spawn point");
}

void Document::set_spawns(std::vector<Spawn> spawns, std::string step_name) {
    if (spawns_problem(spawns).empty())
        change(SpawnsEdit{all_spawns(level_), std::move(spawns)}, std::move(step_name));
}

void Document::set_fall_limit(std::optional<double> height) {
    if (!height || (std::isfinite(*height) && std::abs(*height) <= 1e9))
        change(FallLimitEdit{{level_.fall_limit}, {height}}, "Set fall limit");
}

void Document::set_cameras(std::vector<CameraBookmark> cameras, std::string step_name) {
    change(CamerasEdit{level_.cameras, std::move(cameras)}, std::move(step_name));
}

void Document::set_goals(std::vector<Goal> goals, std::string step_name) {
    change(GoalsEdit{level_.goals, std::move(goals)}, std::move(step_name));
}

void Document::restore(Level level, std::string step_name, std::optional<std::vector<FaceId>> selected) {
    if (in_transaction() || own_mesh(level) != own_mesh(level_)) return;
    if (level.heightfield == level_.heightfield)
        level.terrain = level_.terrain;
    else
        static_cast<void>(load_terrain(level));  // without a readable image there is no terrain
    level.overrides.resize(std::max(level.overrides.size(), own_mesh(level)->face_count()));
    Transaction transaction(*this, std::move(step_name));
    perform({}, LevelEdit{std::make_shared<const Level>(level_),
                          std::make_shared<const Level>(std::move(level))});
    select(selected ? std::move(*selected) : selection_);  // without faces that are hidden now
    transaction.commit();
}

void Document::accept_guessed(std::span<const FaceId> faces) {
    if (level_.guessed.empty()) return;
    std::vector<FaceId> accepted(faces.begin(), faces.end()), left;
    tidy(accepted, face_count());
    std::set_difference(level_.guessed.begin(), level_.guessed.end(), accepted.begin(), accepted.end(),
                        std::back_inserter(left));
    change(GuessedEdit{level_.guessed, std::move(left)}, "Accept guessed paint");
}

const SecondReading& Document::second_reading() const {
    static const SecondReading none;
    if (second_.empty() || level_.guessed.empty()) return none;
    if (second_known_ != revision_) {
        const auto is_guessed = [&](FaceId face) { return std::ranges::binary_search(level_.guessed, face); };
        second_is_open_ = std::ranges::any_of(second_.faces, is_guessed);
        second_known_ = revision_;
    }
    return second_is_open_ ? second_ : none;
}

void Document::take_second_reading() {
    const SecondReading second = second_reading();
    Transaction transaction(*this, "Take the other reading of the paint");
    std::map<std::optional<SurfaceId>, std::vector<FaceId>> faces;
    for (std::size_t i = 0; i < second.faces.size(); ++i)
        faces[second.types[i]].push_back(second.faces[i]);
    for (const auto& [type, list] : faces)
        paint(list, type);
    transaction.commit();
}

namespace {

template <class T>
const T& side(const ValueEdit<T>& edit, bool forward) {
    return forward ? edit.after : edit.before;
}

}  // namespace

void Document::apply(const Edit& edit, bool forward, Touched& touched) {
    struct Apply {
        Document& self;
        bool forward;
        Touched& touched;
        void operator()(const FaceEdit& one) const {
            std::vector<std::optional<SurfaceId>>& overrides = self.level_.overrides;
            // Their places in memory are looked up once, not for every face.
            std::optional<SurfaceId>* to = overrides.data();
            std::size_t size = overrides.size(), done = touched.faces.size();
            touched.faces.resize(done + one.faces.size());
            FaceId* const faces = touched.faces.data();
            const auto put = [&](FaceId face, std::optional<SurfaceId> surface) {
                if (face >= size) {
                    overrides.resize(size = std::size_t{face} + 1);
                    to = overrides.data();
                }
                to[face] = surface;
                faces[done++] = face;
            };
            // Backwards, so that a face listed twice ends with its first `before`.
            if (forward)
                for (const FaceEdit::Face& change : one.faces)
                    put(change.face, change.after);
            else
                for (auto change = one.faces.rbegin(); change != one.faces.rend(); ++change)
                    put(change->face, change->before);
        }
        void operator()(const SelectionEdit& one) const {
            self.selection_ = forward ? one.after : one.before;
        }
        void operator()(const HiddenEdit& one) const {
            self.level_.hidden = forward ? one.after : one.before;
            touched.hidden = true;
        }
        void operator()(const GuessedEdit& one) const { self.level_.guessed = side(one, forward); }
        void operator()(const SavedSelectionsEdit& one) const { self.level_.selections = side(one, forward); }
        void operator()(const MovementEdit& one) const { self.level_.movement = side(one, forward); }
        void operator()(const SurfacesEdit& one) const {
            touched.types = touched.types || !same_names(one.before, one.after);
            touched.parameters = true;
            self.level_.surfaces = side(one, forward);
        }
        void operator()(const RulesEdit& one) const {
            touched.types = true;
            self.level_.rules = side(one, forward);
        }
        void operator()(const SpawnsEdit& one) const {
            slipface::set_spawns(self.level_, side(one, forward));
        }
        void operator()(const FallLimitEdit& one) const {
            self.level_.fall_limit = side(one, forward).height;
        }
        void operator()(const CamerasEdit& one) const { self.level_.cameras = side(one, forward); }
        void operator()(const GoalsEdit& one) const { self.level_.goals = side(one, forward); }
        void operator()(const OrphansEdit& one) const { self.level_.orphans = side(one, forward); }
        void operator()(const GeometryEdit& one) const {
            const Geometry& geometry = side(one, forward);
            self.level_.mesh = geometry.mesh;
            self.level_.placed = geometry.placed;
            self.level_.import_transform = geometry.import_transform;
            self.level_.import_summary = geometry.import_summary;
            self.level_.mesh_stamp = geometry.stamp;
            self.level_.overrides = geometry.overrides;
            self.level_.orphans = geometry.orphans;
            self.selection_ = geometry.selection;
            self.level_.hidden = geometry.hidden;
            self.level_.selections = geometry.saved_selections;
            self.warnings_ = geometry.warnings;
            self.match_ = geometry.match;
            self.second_ = geometry.second;
            self.level_.guessed = geometry.guessed;
            touched.geometry = touched.types = true;
        }
        void operator()(const PropsEdit& one) const {
            put_props(one, forward, self.level_.props);
            self.prop_warnings_ = place_props(self.level_);
            self.take(forward ? one.after : one.before);
            // A mesh that was there before may be gone.
            self.level_.overrides.resize(std::min(self.level_.overrides.size(), self.face_count()));
            for (auto* faces : {&self.selection_, &self.level_.hidden, &self.level_.guessed})
                tidy(*faces, self.face_count());
            touched.props = touched.hidden = true;
        }
        void operator()(const LevelEdit& one) const {
            Level level = *side(one, forward);
            level.file_path = self.level_.file_path;
            level.mesh_path = self.level_.mesh_path;
            level.mesh_stamp = self.level_.mesh_stamp;
            level.import_transform = self.level_.import_transform;
            level.import_summary = self.level_.import_summary;
            touched.geometry = level.mesh != self.level_.mesh;
            self.level_ = std::move(level);
            touched.types = touched.hidden = true;
        }
    };
    std::visit(Apply{*this, forward, touched}, edit);
}

// If an edit throws, those before it are reverted; an edit that throws midway can be reverted as well.
void Document::apply(const HistoryStep& step, bool forward) {
    const std::size_t count = step.edits.size();
    const auto edit = [&](std::size_t i) -> const Edit& { return step.edits[forward ? i : count - 1 - i]; };
    std::size_t begun = 0;
    Touched touched;
    try {
        for (; begun < count; ++begun)
            apply(edit(begun), forward, touched);
        refresh(touched);
    } catch (const std::exception&) {
        for (std::size_t i = std::min(begun + 1, count); i > 0; --i)
            apply(edit(i - 1), !forward, touched);
        refresh(touched);
        throw;
    }
}

}  // namespace slipface

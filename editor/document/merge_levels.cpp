#include "document/merge_levels.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "slipface/level/find_start.h"

namespace slipface {
namespace {

// A list as a map of its members' names.
template <class T, class NameOf>
auto by_name(const std::vector<T>& list, NameOf name_of) {
    std::map<std::decay_t<std::invoke_result_t<NameOf, const T&>>, const T*> named;
    for (const T& one : list)
        named.emplace(std::invoke(name_of, one), &one);
    return named;
}

template <class Map>
auto find_in(const Map& map, const typename Map::key_type& key) {
    const auto found = map.find(key);
    return found == map.end() ? nullptr : found->second;
}

class Merger {
  public:
    Merger(const Level& base, const Level& mine, const Level& theirs, MergeSide winner)
        : base_(base), mine_(mine), theirs_(theirs), winner_(winner) {}

    Result<MergedLevels> run() {
        const bool same_props = mine_.props == theirs_.props;
        const Level& with_props = choose("Props", base_.props, mine_.props, theirs_.props) ? theirs_ : mine_;
        merged_.level = with_props;
        Level& level = merged_.level;
        const std::size_t faces = same_props ? std::max(mine_.mesh.face_count(), theirs_.mesh.face_count())
                                             : own_mesh(mine_)->face_count();
        std::vector<SurfaceType> types =
            list("Type", &Level::surfaces, [](const SurfaceType& type) { return type.name; });
        merge_faces(faces, with_props, types);
        if (types.size() > max_surface_types)
            return Error{mine_.file_path.string(), "the merged level would have too many types"};
        level.surfaces = std::move(types);
        level.rules = list("Rule", &Level::rules,
                           [](const MaterialRule& rule) { return std::pair(rule.pattern, rule.type); });
        level.orphans = list("Orphan", &Level::orphans, [](const Orphan& orphan) {
            const FaceKey& key = orphan.key;
            return std::tuple(key.loop_hash, key.copy, key.material, key.centroid.x(), key.centroid.y(),
                              key.centroid.z());
        });
        if (same_props) level.selections = list("Selection", &Level::selections, &SavedSelection::name);
        level.cameras = list("Camera", &Level::cameras, &CameraBookmark::name);
        level.goals = list("Goal", &Level::goals, &Goal::name);
        level.platforms = list("Platform", &Level::platforms, &Platform::name);
        set_spawns(level,
                   named("Spawn", all_spawns(base_), all_spawns(mine_), all_spawns(theirs_), &Spawn::name));
        for (const SettingInfo& info : settings_table()) {
            const auto value = [&](const Level& of) { return get_setting(of.movement, info); };
            const bool take_theirs = choose(std::string("Movement setting ") + info.label, value(base_),
                                            value(mine_), value(theirs_));
            // Each value was in a level, so it is in range.
            static_cast<void>(set_setting(level.movement, info, value(take_theirs ? theirs_ : mine_)));
        }
        value("Fall limit", &Level::fall_limit);
        value("Terrain", &Level::heightfield);
        value("Sectors", &Level::sectors);
        value("Light", &Level::light);
        value("Keys of other programs", &Level::unknown);
        return std::move(merged_);
    }

  private:
    // True: theirs. Notes a conflict.
    template <class T>
    bool choose(const std::string& what, const T& base, const T& mine, const T& theirs) {
        if (mine == base || mine == theirs) return true;
        if (theirs == base) return false;
        merged_.other_conflicts.push_back(what);
        return winner_ == MergeSide::theirs;
    }

    template <class T>
    void value(const char* what, T Level::*member) {
        merged_.level.*member =
            choose(what, base_.*member, mine_.*member, theirs_.*member) ? theirs_.*member : mine_.*member;
    }

    template <class T, class NameOf>
    std::vector<T> list(const char* what, std::vector<T> Level::*member, NameOf name_of) {
        return named(what, base_.*member, mine_.*member, theirs_.*member, name_of);
    }

    // Member by member, in the order of mine; what only they have comes last.
    template <class T, class NameOf>
    std::vector<T> named(const std::string& what, const std::vector<T>& base, const std::vector<T>& mine,
                         const std::vector<T>& theirs, NameOf name_of) {
        if (mine == base || mine == theirs) return theirs;
        if (theirs == base) return mine;
        const auto in_base = by_name(base, name_of), in_mine = by_name(mine, name_of),
                   in_theirs = by_name(theirs, name_of);
        std::vector<T> merged;
        const auto add = [&](const T& one) {
            const auto name = std::invoke(name_of, one);
            const T* const before = find_in(in_base, name);
            const T* const ours = find_in(in_mine, name);
            const T* const other = find_in(in_theirs, name);
            const auto optional = [](const T* from) { return from ? std::optional<T>(*from) : std::nullopt; };
            std::string text = what;
            if constexpr (std::is_convertible_v<decltype(name), std::string>) text += " " + name;
            const T* const taken =
                choose(text, optional(before), optional(ours), optional(other)) ? other : ours;
            if (taken != nullptr) merged.push_back(*taken);
        };
        for (const T& one : mine)
            add(one);
        for (const T& one : theirs)
            if (find_in(in_mine, std::invoke(name_of, one)) == nullptr) add(one);
        return merged;
    }

    // Numbers of types that mean the same in all three levels; -1: no type.
    class TypeNumbers {
      public:
        std::vector<int> of(const Level& level) {
            std::vector<int> numbers;
            for (const SurfaceType& type : level.surfaces) {
                const auto entry = known_.emplace(type.name, static_cast<int>(types_.size())).first;
                if (static_cast<std::size_t>(entry->second) == types_.size()) types_.push_back(type);
                numbers.push_back(entry->second);
            }
            return numbers;
        }
        const SurfaceType& type(int number) const { return types_[static_cast<std::size_t>(number)]; }
        std::size_t size() const { return types_.size(); }

      private:
        std::map<std::string, int> known_;
        std::vector<SurfaceType> types_;
    };

    static int painted(const Level& level, const std::vector<int>& numbers, std::size_t face) {
        if (face >= level.overrides.size() || !level.overrides[face]) return -1;
        const SurfaceId type = *level.overrides[face];
        return type < numbers.size() ? numbers[type] : -1;
    }

    static std::vector<std::uint8_t> flags(const std::vector<FaceId>& ascending, std::size_t faces) {
        std::vector<std::uint8_t> flags(faces);
        for (const FaceId face : ascending)
            if (face < faces) flags[face] = 1;
        return flags;
    }

    // Paint, guesses and hidden faces. A removed type that still stands on a face returns to `types`.
    void merge_faces(std::size_t faces, const Level& with_props, std::vector<SurfaceType>& types) {
        TypeNumbers numbers;
        const std::vector<int> of_winner = numbers.of(winner_ == MergeSide::mine ? mine_ : theirs_),
                               of_mine = numbers.of(mine_), of_theirs = numbers.of(theirs_),
                               of_base = numbers.of(base_);
        const std::vector<int>& of_props = &with_props == &mine_ ? of_mine : of_theirs;
        const auto guessed_mine = flags(mine_.guessed, faces), guessed_theirs = flags(theirs_.guessed, faces);
        const auto hidden_base = flags(base_.hidden, faces), hidden_mine = flags(mine_.hidden, faces),
                   hidden_theirs = flags(theirs_.hidden, faces);
        const std::size_t all = std::max(faces, with_props.overrides.size());
        std::vector<int> paint(all);
        std::vector<FaceId> guessed, hidden;
        for (std::size_t face = 0; face < faces; ++face) {
            const auto id = static_cast<FaceId>(face);
            const int before = painted(base_, of_base, face), ours = painted(mine_, of_mine, face),
                      other = painted(theirs_, of_theirs, face);
            const bool conflict = ours != before && other != before && ours != other;
            if (conflict) merged_.conflicts.push_back(id);
            const bool from_theirs = conflict ? winner_ == MergeSide::theirs : ours == before;
            paint[face] = from_theirs ? other : ours;
            const bool guess = ours == other ? guessed_mine[face] != 0 && guessed_theirs[face] != 0
                               : from_theirs ? guessed_theirs[face] != 0
                                             : guessed_mine[face] != 0;
            if (guess) guessed.push_back(id);
            if (hidden_mine[face] == hidden_base[face] ? hidden_theirs[face] != 0 : hidden_mine[face] != 0)
                hidden.push_back(id);
        }
        for (std::size_t face = faces; face < all; ++face)
            paint[face] = painted(with_props, of_props, face);
        for (const FaceId face : with_props.guessed)
            if (face >= faces) guessed.push_back(face);
        for (const FaceId face : with_props.hidden)
            if (face >= faces) hidden.push_back(face);

        std::map<std::string, SurfaceId> id_of;
        for (const SurfaceType& type : types)
            id_of.emplace(type.name, static_cast<SurfaceId>(id_of.size()));
        std::vector<std::optional<SurfaceId>> ids(numbers.size());
        merged_.level.overrides.assign(all, std::nullopt);
        for (std::size_t face = 0; face < all; ++face) {
            if (paint[face] < 0) continue;
            std::optional<SurfaceId>& known = ids[static_cast<std::size_t>(paint[face])];
            if (!known) {
                const SurfaceType& type = numbers.type(paint[face]);
                const auto entry = id_of.emplace(type.name, static_cast<SurfaceId>(types.size()));
                if (entry.second) types.push_back(type);
                known = entry.first->second;
            }
            merged_.level.overrides[face] = known;
        }
        merged_.level.guessed = std::move(guessed);
        merged_.level.hidden = std::move(hidden);
    }

    const Level &base_, &mine_, &theirs_;
    MergeSide winner_;
    MergedLevels merged_;
};

}  // namespace

Result<MergedLevels> merge_levels(const Level& base, const Level& mine, const Level& theirs,
                                  MergeSide winner) {
    return Merger(base, mine, theirs, winner).run();
}

Result<Level> annotated(const std::string* text, const std::string& location, const Level& on) {
    if (text != nullptr) {
        Result<LoadedLevel> read = level_from_json(*text, location, on);
        if (!read) return read.error();
        read->level.file_path = on.file_path;
        read->level.mesh_path = on.mesh_path;
        read->level.import_transform = on.import_transform;
        return std::move(read->level);
    }
    Level plain;
    plain.mesh_path = on.mesh_path;
    plain.file_path = on.file_path;
    plain.mesh = own_mesh(on);
    plain.import_transform = on.import_transform;
    plain.spawn_is_set = false;
    return plain;
}

}  // namespace slipface

// Changing the props, and what refers to their faces.
#include <algorithm>
#include <numeric>
#include <utility>

#include "document/document.h"

namespace slipface {
namespace {

// [face before] the faces after that it became: none if its prop is gone, several if its prop was copied.
class FaceMap {
  public:
    FaceMap(const Level& before, const Level& after, std::span<const std::uint32_t> from) {
        ranges_.push_back({0, 0, static_cast<FaceId>(own_mesh(before)->face_count())});
        const std::vector<FaceId>&was = before.placed.first_face, &is = after.placed.first_face;
        for (std::size_t prop = 0; prop + 1 < is.size(); ++prop) {
            const std::uint32_t source = from[prop];
            if (source >= before.props.size()) continue;
            // With another mesh the faces are others.
            if (before.props[source].mesh != after.props[prop].mesh) continue;
            const FaceId count = is[prop + 1] - is[prop];
            if (count == was[source + 1] - was[source]) ranges_.push_back({was[source], is[prop], count});
        }
    }
    std::vector<FaceId> moved(std::span<const FaceId> faces) const {
        std::vector<FaceId> moved;
        for (const Range& range : ranges_) {
            const auto begin = std::lower_bound(faces.begin(), faces.end(), range.before);
            const auto end = std::lower_bound(begin, faces.end(), range.before + range.count);
            for (auto face = begin; face != end; ++face)
                moved.push_back(*face - range.before + range.after);
        }
        std::sort(moved.begin(), moved.end());
        return moved;
    }
    template <class T>
    std::vector<T> moved_values(const std::vector<T>& values, std::size_t face_count) const {
        std::vector<T> moved(face_count);
        for (const Range& range : ranges_)
            std::copy_n(values.begin() + range.before, range.count, moved.begin() + range.after);
        return moved;
    }

  private:
    struct Range {
        FaceId before, after, count;
    };
    std::vector<Range> ranges_;
};

// Platforms of props that are gone go with them.
std::vector<Platform> moved_platforms(const Level& before, std::span<const Prop> after,
                                      std::span<const std::uint32_t> from) {
    std::vector<Platform> platforms;
    for (Platform platform : before.platforms) {
        const auto prop = std::ranges::find(before.props, platform.group, &Prop::name);
        if (prop != before.props.end()) {
            const auto index = static_cast<std::uint32_t>(prop - before.props.begin());
            const auto is = std::ranges::find(from, index);
            if (is == from.end()) continue;
            const Prop& now = after[static_cast<std::size_t>(is - from.begin())];
            platform.group = now.name;
            platform.spin_pivot += now.position - prop->position;
        }
        platforms.push_back(std::move(platform));
    }
    return platforms;
}

}  // namespace

std::vector<std::uint32_t> every_prop(const Level& level) {
    std::vector<std::uint32_t> from(level.props.size());
    std::iota(from.begin(), from.end(), 0U);
    return from;
}

PropsState Document::props_state() const {
    return {level_.props, level_.platforms, level_.overrides, selection_, level_.hidden, level_.selections};
}

void Document::set_props(std::vector<Prop> props, std::span<const std::uint32_t> from,
                         std::string step_name) {
    if (props == level_.props || from.size() != props.size() || !props_problem(props).empty()) return;
    Level after = level_;
    after.props = std::move(props);
    after.platforms = moved_platforms(level_, after.props, from);
    (void)place_props(after);
    const FaceMap map(level_, after, from);
    PropsState state{std::move(after.props),
                     std::move(after.platforms),
                     map.moved_values(level_.overrides, after.mesh->face_count()),
                     map.moved(selection_),
                     map.moved(level_.hidden),
                     level_.selections};
    for (SavedSelection& saved : state.saved_selections)
        saved.faces = map.moved(saved.faces);
    perform(std::move(step_name), PropsEdit{std::make_shared<const PropsState>(props_state()),
                                            std::make_shared<const PropsState>(std::move(state))});
}

void Document::set_platforms(std::vector<Platform> platforms, std::string step_name) {
    if (platforms == level_.platforms) return;
    PropsState state = props_state();
    state.platforms = std::move(platforms);
    perform(std::move(step_name), PropsEdit{std::make_shared<const PropsState>(props_state()),
                                            std::make_shared<const PropsState>(std::move(state))});
}

}  // namespace slipface

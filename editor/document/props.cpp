// Changing the props, and what refers to their faces.
#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "document/document.h"

namespace slipface {
namespace {

// [face before] the faces after that it became: none if its prop is gone, several if its prop was copied.
class FaceMap {
  public:
    // `was`, `is`: PlacedProps::first_face before and after.
    FaceMap(std::size_t own, std::span<const Prop> before, std::span<const FaceId> was,
            std::span<const Prop> after, std::span<const FaceId> is, std::span<const std::uint32_t> from) {
        ranges_.push_back({0, 0, static_cast<FaceId>(own)});
        for (std::size_t prop = 0; prop + 1 < is.size(); ++prop) {
            const std::uint32_t source = from[prop];
            if (source >= before.size() || source + 1 >= was.size()) continue;
            // With another mesh the faces are others.
            if (before[source].mesh != after[prop].mesh) continue;
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
    // `paint` and the result: of the faces from `own` on.
    std::vector<std::optional<SurfaceId>> moved_paint(std::span<const std::optional<SurfaceId>> paint,
                                                      std::size_t own) const {
        std::vector<std::optional<SurfaceId>> moved;
        for (const Range& range : ranges_) {
            for (FaceId i = 0; range.before >= own && i < range.count; ++i) {
                if (range.before - own + i >= paint.size()) break;
                if (!paint[range.before - own + i]) continue;
                moved.resize(std::max(moved.size(), range.after - own + i + 1));
                moved[range.after - own + i] = paint[range.before - own + i];
            }
        }
        return moved;
    }

  private:
    struct Range {
        FaceId before, after, count;
    };
    std::vector<Range> ranges_;
};

// Platforms of props that are gone go with them.
std::vector<Platform> moved_platforms(const std::vector<Platform>& all, std::span<const Prop> before,
                                      std::span<const Prop> after, std::span<const std::uint32_t> from) {
    std::vector<Platform> platforms;
    for (Platform platform : all) {
        const auto prop = std::ranges::find(before, platform.group, &Prop::name);
        if (prop != before.end()) {
            const auto index = static_cast<std::uint32_t>(prop - before.begin());
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

void put_props(const PropsEdit& edit, bool forward, std::vector<Prop>& props) {
    const std::vector<Prop>& from = forward ? edit.before.props : edit.after.props;
    const std::vector<Prop>& to = forward ? edit.after.props : edit.before.props;
    const std::size_t end = edit.first + from.size();
    const std::span<const Prop> all(props);
    if (end > all.size() ||
        !std::equal(from.begin(), from.end(), all.begin() + static_cast<std::ptrdiff_t>(edit.first)))
        return;
    std::vector<Prop> now(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(edit.first));
    now.insert(now.end(), to.begin(), to.end());
    now.insert(now.end(), all.begin() + static_cast<std::ptrdiff_t>(end), all.end());
    props = std::move(now);
}

// Keeps of two lists what lies between their common beginning and their common end.
static void keep_difference(PropsEdit& edit, std::span<const Prop> before, std::span<const Prop> after) {
    const auto [a, b] = std::mismatch(before.begin(), before.end(), after.begin(), after.end());
    const auto [c, d] = std::mismatch(before.rbegin(), std::make_reverse_iterator(a), after.rbegin(),
                                      std::make_reverse_iterator(b));
    edit.first = static_cast<std::size_t>(a - before.begin());
    edit.before.props.assign(a, c.base());
    edit.after.props.assign(b, d.base());
}

void merge_into(PropsEdit& earlier, PropsEdit&& later, std::vector<Prop> now) {
    std::vector<Prop> before = now;
    put_props(later, false, before);
    put_props(earlier, false, before);
    earlier.after = std::move(later.after);
    keep_difference(earlier, before, now);
}

PropsState Document::props_state() const {
    const std::size_t own = own_mesh(level_)->face_count();
    PropsState state{{}, level_.platforms, {}, selection_, level_.hidden, level_.guessed, level_.selections};
    if (level_.overrides.size() > own)
        state.paint.assign(level_.overrides.begin() + static_cast<std::ptrdiff_t>(own),
                           level_.overrides.end());
    return state;
}

void Document::take(const PropsState& state) {
    const std::size_t own = own_mesh(level_)->face_count();
    level_.platforms = state.platforms;
    level_.overrides.resize(own);
    level_.overrides.insert(level_.overrides.end(), state.paint.begin(), state.paint.end());
    selection_ = state.selection;
    level_.hidden = state.hidden;
    level_.guessed = state.guessed;
    level_.selections = state.saved_selections;
}

void Document::set_props(std::vector<Prop> props, std::span<const std::uint32_t> from,
                         std::string step_name) {
    if (props == level_.props || from.size() != props.size() || !props_problem(props).empty()) return;
    PropsEdit edit{0, props_state(), {}};
    const std::vector<FaceId> was = level_.placed.first_face;
    std::swap(props, level_.props);
    prop_warnings_ = place_props(level_);
    edit.after = edit.before;
    edit.after.platforms = moved_platforms(level_.platforms, props, level_.props, from);
    const std::vector<std::uint32_t> same = every_prop(level_);
    if (was != level_.placed.first_face || !std::equal(from.begin(), from.end(), same.begin(), same.end())) {
        const std::size_t own = own_mesh(level_)->face_count();
        const FaceMap map(own, props, was, level_.props, level_.placed.first_face, from);
        edit.after.paint = map.moved_paint(edit.before.paint, own);
        edit.after.selection = map.moved(selection_);
        edit.after.hidden = map.moved(level_.hidden);
        edit.after.guessed = map.moved(level_.guessed);
        for (SavedSelection& saved : edit.after.saved_selections)
            saved.faces = map.moved(saved.faces);
    }
    take(edit.after);
    Touched touched;
    touched.hidden = touched.props = true;
    refresh(touched);
    keep_difference(edit, props, level_.props);
    HistoryStep step{std::move(step_name), {}, false};
    step.edits.emplace_back(std::move(edit));
    record(std::move(step));
}

void Document::set_platforms(std::vector<Platform> platforms, std::string step_name) {
    if (platforms == level_.platforms) return;
    PropsEdit edit{0, props_state(), props_state()};
    edit.after.platforms = std::move(platforms);
    perform(std::move(step_name), std::move(edit));
}

}  // namespace slipface

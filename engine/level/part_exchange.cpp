// Equal parts that seem to have changed places, because a tool wrote the objects in another order than it
// read them: each has the vertices' numbers of the other. The objects' names say whether somebody really
// moved them.
#include <algorithm>
#include <map>
#include <set>

#include "motion_finder.h"

namespace slipface {

// `says`: what the numbers of the vertices say, `named`: in the object of the part's name. What a tool
// exchanged gets the motion that most parts made. What else goes to the place of one of these, or into
// another object of the old file, is open again: its own object was deleted or got another name, and its
// numbers are others' now.
void MotionFinder::undo_exchanges(Motions& says, std::vector<bool> named) {
    const PartMotion usual = usual_motion(says);
    std::vector<bool> taken(support_.all().parts.size(), false);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (!says[i]) continue;
        if (const Exchange exchange = exchange_of(i, *says[i], usual); exchange != Exchange::none) {
            const bool unclear = exchange == Exchange::unclear && types_.differ(i, usual, *says[i]);
            says[i] = usual;
            says[i]->guessed = unclear;
            named[i] = true;
        }
        if (!named[i]) continue;
        if (const std::uint32_t place = part_at(i, *says[i]); place != no_id) taken[place] = true;
    }
    std::set<std::uint32_t> names;
    for (const PaintPart& part : stored_.parts)
        names.insert(part.object.name);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (!says[i] || named[i]) continue;
        const std::uint32_t place = part_at(i, *says[i]);
        if (place == no_id) continue;
        const std::uint32_t name = support_.all().parts[place].object.name;
        if (taken[place] || (name != stored_.parts[i].object.name && names.contains(name))) says[i].reset();
    }
}

PartMotion MotionFinder::usual_motion(const Motions& says) const {
    constexpr std::size_t max_different = 64;
    struct Made {
        PartMotion motion;
        std::size_t faces;
    };
    std::vector<Made> made{{PartMotion{}, 0}};
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (!says[i]) continue;
        const auto known = std::find_if(made.begin(), made.end(), [&](const Made& one) {
            return same(stored_.bounds, one.motion, *says[i]);
        });
        if (known != made.end())
            known->faces += stored_.parts[i].faces;
        else if (made.size() < max_different)
            made.push_back({*says[i], stored_.parts[i].faces});
    }
    return std::max_element(made.begin(), made.end(),
                            [](const Made& a, const Made& b) { return a.faces < b.faces; })
        ->motion;
}

// by_tool: what most did explains the part as well, and its name came with it. unclear: so it seems, but the
// names of the objects are gone.
MotionFinder::Exchange MotionFinder::exchange_of(std::size_t i, const PartMotion& says,
                                                 const PartMotion& most) {
    const PaintPart& part = stored_.parts[i];
    const std::uint32_t name = part.object.name;
    if (name == 0 || same(part.box, says, most) ||
        support_.support(i, most, 0.0).sum() < support_.support(i, says, 0.0).sum() - 1e-9)
        return Exchange::none;
    if (name_at(i, says) == name) return Exchange::none;
    if (name_at(i, most) == name) return Exchange::by_tool;
    // Parts of one object keep their order when it gets another name, but not when objects are joined.
    const PartMotion back{.linear = most.linear.inverse(), .offset = -(most.linear.inverse() * most.offset)};
    const bool of_other_object =
        std::any_of(stored_.parts.begin(), stored_.parts.end(), [&](const PaintPart& other) {
            return other.faces == part.faces && other.object.name != name &&
                   std::all_of(support_.points(i).begin(), support_.points(i).end(), [&](const Vec3& point) {
                       const Vec3 there = back(says(point));
                       const double slack = position_tolerance(there) * 4.0;
                       return (there.array() >= other.box.min.array() - slack).all() &&
                              (there.array() <= other.box.max.array() + slack).all();
                   });
        });
    return of_other_object ? Exchange::unclear : Exchange::none;
}

std::uint32_t MotionFinder::name_at(std::size_t i, const PartMotion& motion) {
    const std::uint32_t part = part_at(i, motion);
    return part == no_id ? 0 : support_.all().parts[part].object.name;
}

// The part of the mesh at most of the part's points after the motion; no_id: none.
std::uint32_t MotionFinder::part_at(std::size_t i, const PartMotion& motion) {
    std::map<std::uint32_t, std::size_t> count;
    for (const std::uint32_t part : support_.parts_at(i, motion))
        ++count[part];
    const auto most = std::max_element(count.begin(), count.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == count.end() ? no_id : most->first;
}

}  // namespace slipface

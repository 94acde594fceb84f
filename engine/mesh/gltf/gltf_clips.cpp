// Source: glTF 2.0, section 3.11.
#include "gltf/gltf_clips.h"

#include <fmt/format.h>

#include <algorithm>

#include "obj/obj_text.h"

namespace slipface {
namespace {

constexpr std::string_view paths[] = {"translation", "rotation", "scale", "weights"};
constexpr std::string_view interpolations[] = {"STEP", "LINEAR", "CUBICSPLINE"};

// Which of `names`, as a number; `otherwise` if it is not there or none of them.
template <std::size_t count>
std::size_t which(const GltfValue& value, const std::string_view (&names)[count], std::size_t otherwise) {
    const std::string text = value.text("");
    const auto found = std::find(std::begin(names), std::end(names), text);
    return found == std::end(names) ? otherwise : static_cast<std::size_t>(found - std::begin(names));
}

RigTrack track_of(GltfFile& file, const GltfValue& sampler, std::uint32_t node, std::size_t path,
                  std::size_t weights) {
    RigTrack track;
    track.node = node;
    track.moves = static_cast<RigTrack::Moves>(path);
    track.between = static_cast<RigTrack::Between>(which(sampler["interpolation"], interpolations, 1));
    track.times = file.numbers(sampler["input"], 1).values;
    if (track.times.empty()) sampler["input"].refuse("has no times");
    for (std::size_t i = 0; i < track.times.size(); ++i)
        if (track.times[i] < 0.0F || (i > 0 && !(track.times[i] > track.times[i - 1])))
            sampler["input"].refuse(
                fmt::format("time {} is {}; expected ascending times from 0", i, track.times[i]));
    const std::size_t per_time = (track.moves == RigTrack::Moves::rotation  ? 4
                                  : track.moves == RigTrack::Moves::weights ? weights
                                                                            : 3) *
                                 (track.between == RigTrack::Between::cubic ? 3 : 1);
    track.values = file.numbers(sampler["output"]).values;
    if (track.values.size() != per_time * track.times.size())
        sampler["output"].refuse(
            fmt::format("has {} numbers; expected {}", track.values.size(), per_time * track.times.size()));
    return track;
}

}  // namespace

std::vector<Clip> gltf_clips(GltfFile& file, const Rig& rig, const std::vector<std::uint32_t>& index_of) {
    std::vector<Clip> clips;
    const GltfValue list = file.root()["animations"];
    for (std::size_t i = 0; i < list.size(); ++i) {
        const GltfValue from = list.at(i);
        Clip clip;
        clip.name = from["name"].text(fmt::format("clip {}", i + 1));
        const GltfValue channels = from["channels"], samplers = from["samplers"];
        for (std::size_t k = 0; k < channels.size(); ++k) {
            const GltfValue target = channels.at(k)["target"];
            const std::size_t path = which(target["path"], paths, std::size(paths));
            if (!target["node"] || path == std::size(paths)) continue;
            file.element("nodes", target["node"]);
            const std::uint32_t node = index_of[target["node"].whole()];
            if (node == no_id) continue;
            const std::size_t weights = rig.nodes[node].weights;
            if (static_cast<RigTrack::Moves>(path) == RigTrack::Moves::weights && weights == 0) continue;
            clip.tracks.push_back(
                track_of(file, samplers.at(channels.at(k)["sampler"].whole()), node, path, weights));
            clip.seconds = std::max(clip.seconds, clip.tracks.back().times.back());
        }
        std::stable_sort(clip.tracks.begin(), clip.tracks.end(),
                         [](const RigTrack& a, const RigTrack& b) { return a.node < b.node; });
        if (!clip.tracks.empty()) clips.push_back(std::move(clip));
    }
    return clips;
}

}  // namespace slipface

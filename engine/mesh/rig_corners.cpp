#include "rig_corners.h"

#include <algorithm>
#include <stdexcept>

namespace slipface {

std::uint16_t RigCorners::bone(std::uint32_t node, const Affine& bind) {
    std::vector<std::uint16_t>& known = bones_of_[node];
    for (const std::uint16_t bone : known)
        if (rig_->bones[bone].bind == bind) return bone;
    if (rig_->bones.size() > 0xffff) throw std::length_error("more than 65536 bones move the mesh");
    known.push_back(static_cast<std::uint16_t>(rig_->bones.size()));
    rig_->bones.push_back({node, bind});
    return known.back();
}

void RigCorners::begin_corner(const Vec3f& position) {
    rig_->corner_position.push_back(position);
    influences_.clear();
}

void RigCorners::end_corner(std::uint16_t otherwise) {
    if (influences_.empty()) influences_.emplace_back(1.0F, otherwise);
    std::stable_sort(influences_.begin(), influences_.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    influences_.resize(std::min(influences_.size(), Rig::bones_per_corner));
    float sum = 0.0F;
    for (const auto& [weight, bone] : influences_)
        sum += weight;
    auto& bones = rig_->corner_bones.emplace_back();
    auto& weights = rig_->corner_weights.emplace_back();
    bones.fill(0);
    weights.fill(0.0F);
    for (std::size_t i = 0; i < influences_.size(); ++i) {
        bones[i] = influences_[i].second;
        weights[i] = influences_[i].first / sum;
    }
    rig_->corner_first_delta.push_back(static_cast<std::uint32_t>(rig_->deltas.size()));
}

std::shared_ptr<Rig> RigCorners::take() {
    if (rig_ == nullptr) return nullptr;
    if (rig_->deltas.empty()) rig_->corner_first_delta.clear();
    prepare_rig(*rig_);
    return std::move(rig_);
}

}  // namespace slipface

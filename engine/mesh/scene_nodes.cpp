#include "scene_nodes.h"

#include <utility>

namespace slipface {

void drop_empty_nodes(PolygonSoup& soup, const NodeShapes& shapes) {
    std::vector<bool> used(soup.nodes.size());
    for (std::size_t i = soup.nodes.size(); i-- > 0;) {
        used[i] = used[i] || soup.nodes[i].group != no_id;
        if (used[i] && soup.nodes[i].parent != no_id) used[soup.nodes[i].parent] = true;
    }
    std::map<std::vector<std::size_t>, std::uint32_t> first;
    std::vector<std::uint32_t> number(soup.nodes.size(), no_id);
    std::vector<MeshNode> kept;
    for (std::size_t i = 0; i < soup.nodes.size(); ++i) {
        if (!used[i]) continue;
        number[i] = static_cast<std::uint32_t>(kept.size());
        MeshNode& node = kept.emplace_back(std::move(soup.nodes[i]));
        if (node.parent != no_id) node.parent = number[node.parent];
        const auto shape = shapes.find(static_cast<std::uint32_t>(i));
        if (shape != shapes.end()) node.shape = first.try_emplace(shape->second, number[i]).first->second;
    }
    soup.nodes = std::move(kept);
}

}  // namespace slipface

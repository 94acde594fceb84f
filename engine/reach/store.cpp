// Searches on disk, so that they can go on.
//
//   slipface-reach 2 IDENTITY BYTES HASH\n      (of the level and its settings; of the body, before packing)
//   report as JSON, one line\n                  (for people and for `reach diff`)
//   packed body
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "impl.h"
#include "slipface/base/files.h"
#include "slipface/base/hash.h"
#include "slipface/base/text.h"
#include "slipface/base/version.h"
#include "slipface/image/pack.h"
#include "slipface/reach/report.h"
#include "slipface/sim/level_fingerprint.h"
#include "state_bytes.h"

namespace slipface {
namespace {

constexpr std::string_view magic = "slipface-reach 2";
constexpr std::uint64_t max_body = std::uint64_t{16} << 30;

void put_reached(StateWriter& to, const std::vector<Reached>& list) {
    to.put(std::uint64_t{list.size()});
    for (const Reached& one : list) {
        to.put(one.node);
        to.put(one.tick);
    }
}

void get_reached(StateReader& from, std::size_t nodes, std::vector<Reached>& list) {
    const std::size_t count = from.count(8, "a number of faces");
    if (count != list.size())
        return from.fail(fmt::format("a list of {}", count), fmt::format("one of {}", list.size()));
    for (Reached& one : list) {
        one.node = from.index(nodes, "a node");
        one.tick = from.get<std::uint32_t>();
    }
}

}  // namespace

std::uint64_t ReachSearch::Impl::identity() const {
    const Level& level = *world.level;
    Hasher hasher;
    const auto add = [&](const Vec3& vector) {
        for (int axis = 0; axis < 3; ++axis)
            hasher.f64(vector[axis]);
    };
    hasher.text(program_version());
    hasher.u64(level.mesh.fingerprint());
    hasher.u64(level_fingerprint(level, scene.at(0.0, world.options.dt)));
    for (const SettingInfo& info : settings_table()) {
        hasher.text(info.name);
        hasher.f64(get_setting(level.movement, info));
    }
    for (const Goal& goal : level.goals) {
        add(goal.position);
        hasher.f64(goal.radius);
    }
    return hasher.value();
}

std::string ReachSearch::Impl::body() const {
    StateWriter to;
    to.put(world.options.seed);
    to.put(world.options.dt);
    to.put(world.options.cell_m);
    to.put(start);
    to.put(std::uint64_t{archive.presses.size()});
    for (const Press& press : archive.presses) {
        to.put(press.ticks);
        to.put(press.stick);
        to.put(press.buttons);
    }
    to.put(std::uint64_t{archive.nodes.size()});
    for (const ReachNode& node : archive.nodes) {
        put_state(to, node.state);
        to.put(node.cell);
        to.put(node.parent);
        to.put(node.tick);
        to.put(node.first_press);
        to.put(node.press_count);
        to.put(static_cast<std::uint16_t>(node.visits * 8u + node.superseded * 4u + node.returns * 2u +
                                          node.is_cell));
    }
    put_reached(to, faces);
    put_reached(to, goals);
    to.put(std::uint64_t{exits.size()});
    for (const ReachExit& exit : exits) {
        to.put(exit.from);
        to.put(exit.hole);
        to.put(exit.spot);
        for (const std::uint32_t part : {exit.face, exit.tick, exit.times, exit.node, exit.first_press})
            to.put(part);
        to.put(exit.press_count);
    }
    to.put(std::uint64_t{rounds.size()});
    for (const ReachRound& one : rounds) {
        to.put(one.steps);
        to.put(one.cells);
        to.put(one.faces);
    }
    to.put(steps);
    for (const std::uint32_t cells : face_cells)
        to.put(cells);
    for (std::size_t cost = 0; cost < queue.size(); ++cost) {
        to.put(std::uint64_t{queue[cost].size() - queue_begin[cost]});
        for (std::size_t i = queue_begin[cost]; i < queue[cost].size(); ++i)
            to.put(queue[cost][i]);
    }
    to.put(std::uint64_t{archive.edges.size()});
    for (const ReachArchive::Edge& edge : archive.edges) {
        to.put(edge.from);
        to.put(edge.next);
    }
    for (const std::uint32_t edge : archive.first_edge)
        to.put(edge);
    to.put(archive.free_edge);
    return std::move(to.bytes);
}

// `prepare` has run: lists have their sizes.
Status ReachSearch::Impl::read_body(std::string_view bytes, const std::string& location) {
    StateReader from(bytes);
    const Level& level = *world.level;
    (void)from.get<std::uint64_t>();  // options and start, which resume() has read
    for (int i = 0; i < 5; ++i)
        (void)from.get<double>();
    archive.presses.resize(from.count(4, "a number of inputs"));
    for (Press& press : archive.presses) {
        press.ticks = from.get<std::uint16_t>();
        press.stick = from.get<std::uint8_t>();
        press.buttons = from.get<std::uint8_t>();
    }
    const auto check_presses = [&](std::uint32_t first, std::uint16_t count) {
        if (std::uint64_t{first} + count > archive.presses.size())
            from.fail(fmt::format("inputs {} to {}", first, std::uint64_t{first} + count),
                      fmt::format("at most {}", archive.presses.size()));
    };
    archive.nodes.resize(from.count(100, "a number of nodes"));
    const std::size_t count = archive.nodes.size();
    for (std::size_t i = 0; i < count && !from.problem; ++i) {
        ReachNode& node = archive.nodes[i];
        node.state = get_state(from, level);
        node.cell = from.get<std::uint64_t>();
        node.parent = from.index(i, "a parent");
        node.tick = from.up_to<std::uint32_t>(max_tape_ticks, "a tick");
        node.first_press = from.get<std::uint32_t>();
        node.press_count = from.get<std::uint16_t>();
        check_presses(node.first_press, node.press_count);
        if (i > 0 && node.parent == no_id) from.fail("a second start", "a parent");
        const std::uint32_t bits = from.get<std::uint16_t>();
        node.visits = (bits >> 3) & 0x1fffu;
        node.superseded = (bits >> 2) & 1u;
        node.returns = (bits >> 1) & 1u;
        node.is_cell = bits & 1u;
    }
    get_reached(from, count, faces);
    get_reached(from, count, goals);
    exits.resize(from.count(70, "a number of exits"));
    for (ReachExit& exit : exits) {
        exit.from = from.vector("an exit");
        exit.hole = from.vector("an exit");
        exit.spot = from.get<std::uint64_t>();
        exit.face = from.index(level.mesh.face_count(), "a face");
        exit.tick = from.get<std::uint32_t>();
        exit.times = from.get<std::uint32_t>();
        exit.node = from.index(count, "a node");
        if (exit.node == no_id) from.fail("an exit without a way", "a node");
        exit.first_press = from.get<std::uint32_t>();
        exit.press_count = from.get<std::uint16_t>();
        check_presses(exit.first_press, exit.press_count);
        exit_at.emplace(exit.spot, static_cast<std::uint32_t>(&exit - exits.data()));
    }
    rounds.resize(from.count(16, "a number of rounds"));
    for (ReachRound& one : rounds) {
        one.steps = from.get<std::uint64_t>();
        one.cells = from.get<std::uint32_t>();
        one.faces = from.get<std::uint32_t>();
    }
    steps = from.get<std::uint64_t>();
    for (std::uint32_t& cells : face_cells)
        cells = from.get<std::uint32_t>();
    const auto node_in = [&](const char* what) {
        const NodeId node = from.index(count, what);
        if (node == no_id) from.fail("no node", "a node");
        return from.problem ? 0 : node;
    };
    for (std::vector<NodeId>& waiting : queue) {
        waiting.resize(from.count(4, "a queue of"));
        for (NodeId& node : waiting)
            node = node_in("a node");
    }
    archive.edges.resize(from.count(8, "a number of edges"));
    for (std::size_t i = 0; i < archive.edges.size() && !from.problem; ++i) {
        archive.edges[i].from = node_in("a node");
        archive.edges[i].next = from.index(archive.edges.size(), "an edge");
    }
    archive.first_edge.resize(count);
    // No edge is in two lists, or twice in one: so every list ends.
    std::vector<bool> listed(archive.edges.size());
    const auto check_list = [&](std::uint32_t edge) {
        for (; edge != no_id && !from.problem; edge = archive.edges[edge].next) {
            if (listed[edge]) return from.fail("an edge a second time", "each once");
            listed[edge] = true;
        }
    };
    for (std::uint32_t& edge : archive.first_edge) {
        edge = from.index(archive.edges.size(), "an edge");
        check_list(edge);
    }
    archive.free_edge = from.index(archive.edges.size(), "an edge");
    check_list(archive.free_edge);
    if (!from.problem && count == 0) from.fail("no nodes", "at least the start");
    if (!from.problem && !from.at_end()) from.fail("more data", "the end");
    if (from.problem) return Error{location, *from.problem};
    archive.rebuild_index();
    return {};
}

Status ReachSearch::store(const std::filesystem::path& path) const {
    const std::string body = impl_->body();
    Hasher hasher;
    hasher.u64(hash_blocks(body.data(), body.size()));
    std::string text =
        fmt::format("{} {:016x} {} {:016x}\n", magic, impl_->identity(), body.size(), hasher.value());
    text += reach_to_json(make_reach_report(*this), false) + "\n";
    text += pack(body, pack_fast);
    return write_file_atomic(path, text);
}

std::uint64_t ReachSearch::identity() const {
    return impl_->identity();
}

Result<ReachSearch> ReachSearch::resume(const Level& level, const std::filesystem::path& path) {
    const Result<std::string> file = read_file(path);
    if (!file) return file.error();
    return resume_text(level, *file, path.string());
}

Result<ReachSearch> ReachSearch::resume_text(const Level& level, std::string_view all,
                                             const std::string& location) {
    const std::size_t line = std::min(all.find('\n'), all.size());
    const std::vector<std::string_view> words = split(all.substr(0, std::min<std::size_t>(line, 200)), ' ');
    const auto hex = [](std::string_view text) -> std::optional<std::uint64_t> {
        std::uint64_t value = 0;
        const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
        if (error != std::errc() || rest != text.data() + text.size() || text.size() != 16) return {};
        return value;
    };
    if (words.size() != 5 || fmt::format("{} {}", words[0], words[1]) != magic)
        return Error{location + ":1", "found no search, expected a file that `slipface reach --out` wrote"};
    const auto identity = hex(words[2]), hash = hex(words[4]);
    const std::optional<std::int64_t> size = parse_int(words[3]);
    const std::size_t summary = all.find('\n', line + 1);
    if (!identity || !hash || !size || *size < 0 || static_cast<std::uint64_t>(*size) > max_body ||
        summary == std::string_view::npos)
        return Error{location + ":1", "found a damaged first line, expected hashes and a size"};
    const std::optional<std::string> body = unpack(all.substr(summary + 1), static_cast<std::size_t>(*size));
    Hasher hasher;
    if (body) hasher.u64(hash_blocks(body->data(), body->size()));
    if (!body || hasher.value() != *hash)
        return Error{location, "found damaged data, expected what its first line promises"};

    StateReader head(*body);
    ReachOptions options;
    options.seed = head.get<std::uint64_t>();
    options.dt = head.number("a step");
    options.cell_m = head.number("a cell");
    const Vec3 start = head.vector("the start");
    if (head.problem) return Error{location, *head.problem};
    if (options.dt != ReachOptions{}.dt) options.dt_text = to_text(options.dt);
    Result<LevelScene> scene = LevelScene::build(level);
    if (!scene) return scene.error();
    auto impl = std::make_unique<Impl>(std::move(*scene));
    if (Status status = impl->prepare(level, start, options); !status) return status.error();
    if (impl->identity() != *identity)
        return Error{location,
                     fmt::format("found a search of another level, of other settings or by another program "
                                 "({:016x}), expected one of {} as it is ({:016x})",
                                 *identity, level.mesh_path.filename().string(), impl->identity())};
    if (Status status = impl->read_body(*body, location); !status) return status.error();
    return ReachSearch(std::move(impl));
}

}  // namespace slipface

#include "tools/lab/link.h"

#include <fmt/format.h>

#include <array>

#include "document/folders.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "slipface/scenes/demo.h"
#include "tools/editor.h"
#include "tools/lab/lab_actions.h"
#include "tools/lab/reach_job.h"
#include "tools/lab/run_link.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

struct Link {
    std::optional<Capsule> capsule{};
    const DemoInfo* demo = nullptr;
    fs::path level{};
    std::optional<std::pair<Vec3, Vec3>> camera{}, probe{};
    std::string view{};  // of `camera`, if that has no points
    std::optional<double> reach_s{};
    bool focus = false;  // all but the view and `only` is hidden
    std::optional<PanelId> only{};
};

Error bad(std::string message) {
    return {"link", std::move(message)};
}

Status read_capsule(Link& link, std::string_view value) {
    Result<Capsule> capsule = parse_capsule("capsule=" + std::string(value));
    if (!capsule) return capsule.error();
    link.capsule = std::move(*capsule);
    return {};
}

Status read_demo(Link& link, std::string_view value) {
    link.demo = find_demo(value);
    if (link.demo == nullptr) return bad("there is no demo \"" + std::string(value) + "\"");
    return {};
}

Status read_level(Link& link, std::string_view value) {
    std::string names;
    for (const fs::path& level : sample_levels()) {
        if (level.stem() == value) link.level = level;
        names += (names.empty() ? "" : ", ") + level.stem().string();
    }
    if (link.level.empty())
        return bad("no level \"" + std::string(value) + "\" comes with Slipface; there are: " + names);
    return {};
}

std::optional<std::pair<Vec3, Vec3>> two_points(std::string_view value) {
    std::size_t comma = 0;
    for (int i = 0; i < 3 && comma != std::string_view::npos; ++i)
        comma = value.find(',', comma + 1);
    if (comma == std::string_view::npos) return std::nullopt;
    const auto first = parse_vec3(value.substr(0, comma)), second = parse_vec3(value.substr(comma + 1));
    if (!first || !second) return std::nullopt;
    return std::pair(*first, *second);
}

Status read_camera(Link& link, std::string_view value) {
    link.camera = two_points(value);
    link.view = value;
    if (link.camera || named_view(value, {}, 1.0)) return {};
    return bad("expected a view such as iso or top, or two points X,Y,Z,X,Y,Z, found \"" +
               std::string(value) + "\"");
}

Status read_probe(Link& link, std::string_view value) {
    link.probe = two_points(value);
    if (!link.probe) return bad("expected two points X,Y,Z,X,Y,Z, found \"" + std::string(value) + "\"");
    return {};
}

Status read_reach(Link& link, std::string_view value) {
    link.reach_s = parse_double(value);
    if (!link.reach_s || *link.reach_s <= 0.0 || *link.reach_s > 600.0)
        return bad("expected a number of seconds up to 600, found \"" + std::string(value) + "\"");
    return {};
}

Status read_only(Link& link, std::string_view value) {
    link.focus = true;
    if (value == "view") return {};
    for (const PanelInfo& info : panel_table())
        if (value == info.name) link.only = info.id;
    if (!link.only) return bad("there is no panel \"" + std::string(value) + "\"");
    return {};
}

struct Row {
    LinkPart part;
    Status (*read)(Link& link, std::string_view value);
};
constexpr Row rows[] = {
    {{"capsule", "SIZE.DATA", "A run: opens its level at its tick, with Why"}, read_capsule},
    {{"demo", "step-up", "The demo of a movement hack"}, read_demo},
    {{"level", "easy", "A level that comes with Slipface"}, read_level},
    {{"camera", "X,Y,Z,X,Y,Z", "Where the camera is, and where it looks, in metres; or a view of all: iso"},
     read_camera},
    {{"probe", "X,Y,Z,X,Y,Z", "The sweep probe, pulled from the first point to the second"}, read_probe},
    {{"reach", "SECONDS", "A search for all that the player can reach"}, read_reach},
    {{"only", "PANEL", "Only the view and this panel are shown, or the view alone: only=view"}, read_only},
};
constexpr auto parts = [] {
    std::array<LinkPart, std::size(rows)> list{};
    for (std::size_t i = 0; i < list.size(); ++i)
        list[i] = rows[i].part;
    return list;
}();

const Row* row_of(std::string_view part) {
    for (const Row& row : rows)
        if (part.starts_with(row.part.name) &&
            part.substr(std::string_view(row.part.name).size()).starts_with('='))
            return &row;
    return nullptr;
}

std::string_view behind_hash(std::string_view text) {
    return text.substr(text.find('#') + 1);  // all of it if there is none
}

Result<Link> read_link(std::string_view text) {
    Link link;
    for (const std::string_view part : split(text, '&')) {
        const Row* const row = row_of(part);
        if (row == nullptr) {
            std::string names;
            for (const LinkPart& known : parts)
                names += fmt::format("{}{}=", names.empty() ? "" : ", ", known.name);
            return bad(fmt::format("found \"{}\"; expected {}", part.substr(0, 40), names));
        }
        if (Status status = row->read(link, part.substr(part.find('=') + 1)); !status) return status.error();
    }
    return link;
}

Status open_shipped(Editor& editor, const fs::path& level) {
    if (editor.document && editor.document->dirty())
        return bad("the open level has unsaved changes; save or undo them, then open the link again");
    Result<std::unique_ptr<Document>> opened = Document::open(level);
    if (!opened) return opened.error();
    adopt_document(editor, std::move(opened).value(), level);
    return {};
}

constexpr double usual_aspect = 1.5;  // of a view beside a panel

void act(Editor& editor, const Link& link) {
    if (link.probe) {
        editor.lab.close();  // its paths would cover the sweep
        editor.tool = Tool::probe;
        editor.probe = {
            .placed = true, .from = link.probe->first, .move = link.probe->second - link.probe->first};
        editor.layout.show(PanelId::probe);
        if (!link.camera) go_to_position(editor, link.probe->first);
    }
    if (link.camera) editor.view.look_at(link.camera->first, link.camera->second);
    if (const auto all = named_view(link.view, editor.document->bounds(), usual_aspect))
        editor.view.look_at(all->eye, all->target);
    if (link.reach_s) {
        ReachSettings settings;
        settings.duration_s = *link.reach_s;
        editor.reach = ReachJob::start(*editor.document, settings, editor.session.wake, nullptr);
        editor.layout.show(PanelId::reach);
        editor.style.overlay = 0.0f;  // the types' colours and their legend would cover the map
    }
    if (link.focus) editor.layout.focus_on(link.only);
}

}  // namespace

std::span<const LinkPart> link_parts() {
    return parts;
}

bool is_link(std::string_view text) {
    return text.ends_with(".link") || row_of(behind_hash(text)) != nullptr;
}

Status open_link(Editor& editor, std::string_view text) {
    std::string content;
    if (text.ends_with(".link")) {
        Result<std::string> read = read_file(fs::path(text), 2 * max_capsule_bytes);
        if (!read) return read.error();
        content = std::move(*read);
        text = trim(content);
    }
    const Result<Link> link = read_link(behind_hash(text));
    if (!link) return link.error();
    if (link->capsule)
        if (Status status = open_capsule(editor, *link->capsule); !status) return status;
    if (!link->level.empty())
        if (Status status = open_shipped(editor, link->level); !status) return status;
    if (link->demo) open_demo(editor, *link->demo);
    if (!editor.document || editor.unsaved) return {};
    act(editor, *link);
    return {};
}

}  // namespace slipface

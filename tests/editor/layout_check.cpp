#include "layout_check.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>

#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

// Rows that can be chosen reach over half the space to their neighbours.
float row_slack_x() {
    return 0.5f * ImGui::GetStyle().ItemSpacing.x + 1.5f;
}
float row_slack_y() {
    return 0.5f * ImGui::GetStyle().ItemSpacing.y + 1.5f;
}
constexpr float slack = 1.5f;  // pixels: borders, and letters that reach out of their advance

using Defects = std::vector<std::string>;

std::string box(ImVec2 min, ImVec2 max) {
    return fmt::format("({:.0f}, {:.0f}) to ({:.0f}, {:.0f})", min.x, min.y, max.x, max.y);
}

bool scrolls_y(const ImGuiWindow& window) {
    for (const ImGuiWindow* w = &window; w; w = w->ParentWindow)
        if (w->ScrollbarY) return true;
    return false;
}
bool scrolls_x(const ImGuiWindow& window) {
    return window.ScrollbarX;
}

void check_widgets(Defects& defects, float width, float height) {
    struct Placed {
        std::string_view path;
        const ui::WidgetRect* rect;
        ImVec2 min, max;  // of it, what can be seen
    };
    std::vector<Placed> seen;
    for (const auto& [path, rect] : ui::widgets()) {
        const ImGuiWindow* const window = ImGui::FindWindowByName(rect.window.c_str());
        if (!window || path.ends_with("Tooltip")) continue;  // they have a test of their own
        const auto report = [&defects, &path = path, &rect = rect](const char* what) {
            defects.push_back(fmt::format("{} {}: {}", path, what, box(rect.min, rect.max)));
        };
        const bool scrolled_away = rect.max.y <= rect.clip_min.y || rect.min.y >= rect.clip_max.y;
        if (!scrolls_y(*window)) {
            if (rect.min.y < -slack || rect.max.y > height + slack) report("leaves the window");
            if (scrolled_away || rect.min.y < rect.clip_min.y - row_slack_y() ||
                rect.max.y > rect.clip_max.y + row_slack_y())
                report("is cut from above or below");
        }
        if (!scrolls_x(*window)) {
            if (rect.min.x < -slack || rect.max.x > width + slack) report("leaves the window");
            if (rect.min.x < rect.clip_min.x - row_slack_x() || rect.max.x > rect.clip_max.x + row_slack_x())
                report("is cut at a side");
        }
        const ImVec2 min{std::max(rect.min.x, rect.clip_min.x), std::max(rect.min.y, rect.clip_min.y)};
        const ImVec2 max{std::min(rect.max.x, rect.clip_max.x), std::min(rect.max.y, rect.clip_max.y)};
        if (!rect.ground && min.x < max.x && min.y < max.y) seen.push_back({path, &rect, min, max});
    }
    for (std::size_t i = 0; i < seen.size(); ++i)
        for (std::size_t j = i + 1; j < seen.size(); ++j) {
            const Placed &a = seen[i], &b = seen[j];
            if (a.rect->window != b.rect->window) continue;
            const float x = std::min(a.max.x, b.max.x) - std::max(a.min.x, b.min.x);
            const float y = std::min(a.max.y, b.max.y) - std::max(a.min.y, b.min.y);
            if (x > slack && y > slack)
                defects.push_back(fmt::format("{} and {} lie on each other: {}, {}", a.path, b.path,
                                              box(a.min, a.max), box(b.min, b.max)));
        }
}

void check_contents(Defects& defects) {
    for (const ImGuiWindow* window : GImGui->Windows) {
        // A menu bar's height is its own; its menus are widgets.
        constexpr ImGuiWindowFlags others = ImGuiWindowFlags_Tooltip | ImGuiWindowFlags_MenuBar;
        if (!window->WasActive || window->Hidden || (window->Flags & others) != 0) continue;
        // A box of several lines scrolls with its caret.
        if (std::string_view(window->Name).find("/##Text_") != std::string_view::npos) continue;
        if (window->ScrollMax.x > slack && !window->ScrollbarX)
            defects.push_back(fmt::format("{}: contents {:.0f} pixels wider than the region", window->Name,
                                          window->ScrollMax.x));
        if (window->ScrollMax.y > slack && !window->ScrollbarY)
            defects.push_back(fmt::format("{}: contents {:.0f} pixels higher than the region", window->Name,
                                          window->ScrollMax.y));
    }
}

// Letters as the fonts' atlas has them. One that is cut while it is drawn has only a part of its place there.
class Glyphs {
  public:
    Glyphs() {
        const ui::Fonts& fonts = ui::fonts();
        for (const ui::Font& font : {fonts.regular, fonts.semibold, fonts.small, fonts.title})
            for (const ImFontGlyph& glyph : ui::glyphs(font))
                glyphs_.insert({glyph.U0, glyph.V0, glyph.U1, glyph.V1});
    }
    // How many pixels of a letter's width are missing; nothing for what is no letter.
    std::optional<float> missing(const ImDrawVert& low, const ImDrawVert& high) const {
        const Box part{low.uv.x, low.uv.y, high.uv.x, high.uv.y};
        if (glyphs_.contains(part)) return 0.0f;
        const auto [u0, v0, u1, v1] = part;
        for (const auto& [whole_u0, whole_v0, whole_u1, whole_v1] : glyphs_)
            if (whole_u0 <= u0 && whole_v0 <= v0 && whole_u1 >= u1 && whole_v1 >= v1)
                return (high.pos.x - low.pos.x) * ((whole_u1 - whole_u0) / (u1 - u0) - 1.0f);
        return std::nullopt;
    }

  private:
    using Box = std::tuple<float, float, float, float>;
    std::set<Box> glyphs_;
};

struct Letter {
    ImVec2 min, max;
    int run;  // letters that follow each other on a line
};

bool in_text_box(ImVec2 at) {
    for (const auto& [path, rect] : ui::widgets())
        if (rect.text_box && at.x >= rect.min.x - 20.0f && at.x < rect.max.x && at.y >= rect.min.y &&
            at.y < rect.max.y)
            return true;
    return false;
}

void check_letters(Defects& defects) {
    const Glyphs glyphs;
    const ImDrawData& data = *ImGui::GetDrawData();
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        const std::string name = list._OwnerName ? list._OwnerName : "";
        const ImGuiWindow* const window = ImGui::FindWindowByName(name.c_str());
        if (!window) continue;
        std::vector<Letter> letters;
        std::set<std::string> found;
        const auto report = [&](const char* what, ImVec2 at) {
            if (in_text_box(at)) return;
            // Once for each line of text.
            if (found.insert(fmt::format("{} {:.0f}", what, at.y / 12.0f)).second)
                defects.push_back(fmt::format("{}: {} at ({:.0f}, {:.0f})", name, what, at.x, at.y));
        };
        int run = 0;
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback || !ui::draws_letters(command)) continue;
            const ImVec4 clip = command.ClipRect;
            for (unsigned at = command.IdxOffset; at + 6 <= command.IdxOffset + command.ElemCount; at += 3) {
                const auto vertex = [&](unsigned index) -> const ImDrawVert& {
                    return list.VtxBuffer[static_cast<int>(command.VtxOffset +
                                                           list.IdxBuffer[static_cast<int>(at + index)])];
                };
                // A letter: two triangles 0 1 2, 0 2 3 over a rectangle of the atlas.
                const ImDrawVert &a = vertex(0), &b = vertex(1), &c = vertex(2), &d = vertex(5);
                if (&vertex(3) != &a || &vertex(4) != &c || a.pos.y != b.pos.y || b.pos.x != c.pos.x ||
                    d.pos.x != a.pos.x || a.uv.x == c.uv.x)
                    continue;
                at += 3;
                if (c.pos.x <= clip.x || a.pos.x >= clip.z || c.pos.y <= clip.y || a.pos.y >= clip.w)
                    continue;
                const std::optional<float> missing = glyphs.missing(a, c);
                if (!missing) continue;
                if (*missing > slack) report("a letter is cut", a.pos);
                if (a.pos.x < clip.x - slack || c.pos.x > clip.z + slack) report("a letter is cut", a.pos);
                const bool follows = !letters.empty() && std::abs(letters.back().max.y - c.pos.y) < 20.0f &&
                                     a.pos.x > letters.back().min.x && a.pos.x < letters.back().max.x + 16.0f;
                if (!follows) ++run;
                letters.push_back({a.pos, c.pos, run});
            }
        }
        for (std::size_t p = 0; p < letters.size(); ++p)
            for (std::size_t q = p + 1; q < letters.size(); ++q) {
                if (letters[p].run == letters[q].run) continue;
                const float x = std::min(letters[p].max.x, letters[q].max.x) -
                                std::max(letters[p].min.x, letters[q].min.x);
                const float y = std::min(letters[p].max.y, letters[q].max.y) -
                                std::max(letters[p].min.y, letters[q].min.y);
                if (x > 2.0f && y > 2.0f) report("two texts lie on each other", letters[q].min);
            }
    }
}

}  // namespace

std::vector<std::string> layout_defects(float width, float height) {
    Defects defects;
    check_widgets(defects, width, height);
    check_contents(defects);
    check_letters(defects);
    return defects;
}

}  // namespace slipface

// What a program shows, for `slipface snapshot` (docs/snapshots.md, "Any program"): a frame as PNG, the boxes
// of its named widgets, and its numbers. One header for C++11 and every compiler, without dependencies.
//
//   slipface::Capture capture("menu");                 // of a row with "command": NAME/menu
//   capture.number("triangles", triangles);
//   capture.widget("Menu/Open", x, y, width, height);
//   capture.write(rgba, width, height);                // rows from top to bottom
//
// It writes menu.png and menu.json into the folder that the variable SLIPFACE_CAPTURE names, and without that
// variable nothing.
//
// Included after a header of OpenGL, it has capture_framebuffer(capture, width, height); after imgui.h,
// capture_item(capture, "Open"), to be called after a widget; after imgui_internal.h,
// capture_windows(capture), to be called after ImGui::Render(). Where Dear ImGui and the program are compiled
// with IMGUI_ENABLE_TEST_ENGINE, one file of the program defines SLIPFACE_CAPTURE_ITEMS before it includes
// this header, and capture_windows() has every widget of the frame by its label.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace slipface {

class Capture {
  public:
    // `name`: letters, digits, '-' and '_'.
    explicit Capture(const std::string& name) {
        const char* const folder = std::getenv("SLIPFACE_CAPTURE");
        if (folder != nullptr && *folder != '\0') path_ = std::string(folder) + "/" + name;
    }
    bool wanted() const { return !path_.empty(); }

    // Pixels from the upper left corner. A name that comes again replaces the earlier one.
    void widget(const std::string& name, double x, double y, double width, double height) {
        const auto whole = [](double value) {
            return std::to_string(static_cast<long>(value < 0 ? value - 0.5 : value + 0.5));
        };
        add(widgets_, name,
            "[" + whole(x) + ", " + whole(y) + ", " + whole(width) + ", " + whole(height) + "]");
    }
    // Compared within 1e-6.
    void number(const std::string& name, double value) {
        char text[40];
        std::snprintf(text, sizeof text, "%.17g", value);
        for (char& c : text)
            if (c == ',') c = '.';  // of the locale
        add(numbers_, name, value - value == 0 ? text : quoted(text));
    }
    void text(const std::string& name, const std::string& value) { add(numbers_, name, quoted(value)); }
    // What draws. Where it is the one that drew the golden, the check forgives no pixel.
    void renderer(const std::string& name, const std::string& value) { add(renderer_, name, quoted(value)); }

    // Writes both files. `rgba` has width x height pixels of 4 bytes, row by row from the top, or from the
    // bottom. False: a file cannot be written.
    bool write(const std::uint8_t* rgba, int width, int height, bool from_bottom = false) const {
        if (!wanted()) return true;
        const std::string json = "{\n\"numbers\": " + object(numbers_) +
                                 ",\n\"widgets\": " + object(widgets_) +
                                 ",\n\"renderer\": " + object(renderer_) + "\n}\n";
        return save(path_ + ".json", json) && save(path_ + ".png", png(rgba, width, height, from_bottom));
    }

  private:
    using Members = std::vector<std::pair<std::string, std::string>>;

    static void add(Members& members, const std::string& name, const std::string& value) {
        for (auto& member : members)
            if (member.first == name) {
                member.second = value;
                return;
            }
        members.emplace_back(name, value);
    }
    static std::string quoted(const std::string& text) {
        std::string out = "\"";
        for (const char c : text) {
            if (c == '"' || c == '\\') out += '\\';
            out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
        return out + "\"";
    }
    static std::string object(const Members& members) {
        std::string out = "{";
        for (const auto& member : members)
            out += (out.size() > 1 ? ",\n  " : "\n  ") + quoted(member.first) + ": " + member.second;
        return out + "}";
    }
    static bool save(const std::string& path, const std::string& bytes) {
        std::FILE* const file = std::fopen(path.c_str(), "wb");
        if (file == nullptr) return false;
        const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
        return std::fclose(file) == 0 && written;
    }

    static void add_u32(std::string& out, std::uint32_t value) {
        for (int shift = 24; shift >= 0; shift -= 8)
            out += static_cast<char>(value >> shift & 0xff);
    }
    static void add_chunk(std::string& out, const char* kind, const std::string& data) {
        add_u32(out, static_cast<std::uint32_t>(data.size()));
        const std::string body = kind + data;
        std::uint32_t crc = 0xffffffff;
        for (const char c : body) {
            crc ^= static_cast<unsigned char>(c);
            for (int bit = 0; bit < 8; ++bit)
                crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
        }
        out += body;
        add_u32(out, ~crc);
    }
    // Without compression: the check writes what it keeps again.
    static std::string png(const std::uint8_t* rgba, int width, int height, bool from_bottom) {
        const std::size_t row = static_cast<std::size_t>(width) * 4;
        std::string rows;
        for (int y = 0; y < height; ++y) {
            rows += '\0';  // no filter
            const std::size_t at = static_cast<std::size_t>(from_bottom ? height - 1 - y : y) * row;
            rows.append(reinterpret_cast<const char*>(rgba) + at, row);
        }
        std::string data("\x78\x01");
        std::uint32_t a = 1, b = 0;
        const std::size_t most = 65535;
        for (std::size_t at = 0; at < rows.size(); at += most) {
            const std::size_t size = rows.size() - at < most ? rows.size() - at : most;
            data += at + size == rows.size() ? '\1' : '\0';
            for (const std::size_t length : {size, ~size}) {
                data += static_cast<char>(length & 0xff);
                data += static_cast<char>(length >> 8 & 0xff);
            }
            data.append(rows, at, size);
            for (std::size_t i = at; i < at + size; ++i) {
                a = (a + static_cast<unsigned char>(rows[i])) % 65521;
                b = (b + a) % 65521;
            }
        }
        add_u32(data, b << 16 | a);
        std::string head;
        add_u32(head, static_cast<std::uint32_t>(width));
        add_u32(head, static_cast<std::uint32_t>(height));
        head += std::string("\x08\x06\0\0\0", 5);  // 8 bits, RGBA
        std::string out("\x89PNG\r\n\x1a\n");
        add_chunk(out, "IHDR", head);
        add_chunk(out, "IDAT", data);
        add_chunk(out, "IEND", "");
        return out;
    }

    std::string path_;
    Members numbers_, widgets_, renderer_;
};

#if defined(GL_VERSION_1_1) || defined(GL_VERSION_3_0)
// The framebuffer that is bound for reading, and what draws into it. Its alpha is not looked at.
inline bool capture_framebuffer(Capture& capture, int width, int height) {
    if (!capture.wanted()) return true;
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    for (std::size_t i = 3; i < rgba.size(); i += 4)
        rgba[i] = 255;
    const auto text = [](GLenum what) {
        const GLubyte* const found = glGetString(what);
        return std::string(found ? reinterpret_cast<const char*>(found) : "");
    };
    capture.renderer("renderer", text(GL_RENDERER));
    capture.renderer("version", text(GL_VERSION));
    return capture.write(rgba.data(), width, height, true);
}
#endif

#if defined(IMGUI_VERSION)
// The widget that was submitted last.
inline void capture_item(Capture& capture, const char* name) {
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const ImVec2 origin = ImGui::GetMainViewport()->Pos;
    capture.widget(name, min.x - origin.x, min.y - origin.y, max.x - min.x, max.y - min.y);
}
#endif

#if defined(IMGUI_TEST_ENGINE_ITEM_INFO)
// Of the frame that items were added to last.
struct CaptureItem {
    ImGuiID id;
    int frame;
    ImRect box;
    std::string name;  // "Window/Label"; empty: not known yet
};
inline std::vector<CaptureItem>& capture_items() {
    static std::vector<CaptureItem> items;
    return items;
}

// To be called once, behind ImGui::CreateContext(): from then on it reports every widget.
inline void capture_every_item() {
    ImGui::GetCurrentContext()->TestEngineHookItems = true;
}

// The windows that are shown, and the widgets that it reports.
inline void capture_windows(Capture& capture) {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    const ImVec2 origin = ImGui::GetMainViewport()->Pos;
    for (const ImGuiWindow* const window : context.Windows)
        if (window->Active && !window->Hidden)
            capture.widget(window->Name, window->Pos.x - origin.x, window->Pos.y - origin.y,
                           window->SizeFull.x, window->Collapsed ? window->Size.y : window->SizeFull.y);
    for (const CaptureItem& item : capture_items())
        if (item.frame == context.FrameCount && !item.name.empty())
            capture.widget(item.name, item.box.Min.x - origin.x, item.box.Min.y - origin.y,
                           item.box.GetWidth(), item.box.GetHeight());
}

inline void capture_item_box(ImGuiContext* context, ImGuiID id, const ImRect& box) {
    std::vector<CaptureItem>& items = capture_items();
    if (!items.empty() && items.front().frame != context->FrameCount) items.clear();
    const ImGuiWindow* const window = context->CurrentWindow;
    if (id != 0 && window->ClipRect.Overlaps(box)) items.push_back({id, context->FrameCount, box, ""});
}
inline void capture_item_label(ImGuiContext* context, ImGuiID id, const char* label) {
    std::vector<CaptureItem>& items = capture_items();
    for (std::size_t i = items.size(); label != nullptr && i-- > 0;)
        if (items[i].id == id) {
            items[i].name = std::string(context->CurrentWindow->Name) + "/" + label;
            return;
        }
}
#endif

}  // namespace slipface

#if defined(SLIPFACE_CAPTURE_ITEMS)
#if IMGUI_VERSION_NUM < 18900
void ImGuiTestEngineHook_ItemAdd(ImGuiContext* context, const ImRect& box, ImGuiID id) {
    slipface::capture_item_box(context, id, box);
}
#else
void ImGuiTestEngineHook_ItemAdd(ImGuiContext* context, ImGuiID id, const ImRect& box,
                                 const ImGuiLastItemData*) {
    slipface::capture_item_box(context, id, box);
}
const char* ImGuiTestEngine_FindItemDebugLabel(ImGuiContext*, ImGuiID) {
    return nullptr;
}
#endif
void ImGuiTestEngineHook_ItemInfo(ImGuiContext* context, ImGuiID id, const char* label,
                                  ImGuiItemStatusFlags) {
    slipface::capture_item_label(context, id, label);
}
void ImGuiTestEngineHook_Log(ImGuiContext*, const char*, ...) {}
#endif

// The differences between Dear ImGui 1.86 and 1.92, here and in imgui_compat.cpp. All other files include
// ImGui through this one or use what both have.
#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <cfloat>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string_view>

namespace slipface::ui {

#if IMGUI_VERSION_NUM < 18700
inline constexpr ImGuiKey key_pad_enter = ImGuiKey_KeyPadEnter;
#else
inline constexpr ImGuiKey key_pad_enter = ImGuiKey_KeypadEnter;
#endif

// The navigation and editing keys that Dear ImGui knows in every version, by the names that shortcuts use.
struct NamedKey {
    std::string_view name;
    ImGuiKey key;
};
inline constexpr NamedKey named_keys[] = {
    {"Tab", ImGuiKey_Tab},
    {"Left", ImGuiKey_LeftArrow},
    {"Right", ImGuiKey_RightArrow},
    {"Up", ImGuiKey_UpArrow},
    {"Down", ImGuiKey_DownArrow},
    {"PageUp", ImGuiKey_PageUp},
    {"PageDown", ImGuiKey_PageDown},
    {"Home", ImGuiKey_Home},
    {"End", ImGuiKey_End},
    {"Insert", ImGuiKey_Insert},
    {"Delete", ImGuiKey_Delete},
    {"Backspace", ImGuiKey_Backspace},
    {"Space", ImGuiKey_Space},
    {"Enter", ImGuiKey_Enter},
    {"Escape", ImGuiKey_Escape},
    {"KeypadEnter", key_pad_enter},
    {"A", ImGuiKey_A},
    {"C", ImGuiKey_C},
    {"V", ImGuiKey_V},
    {"X", ImGuiKey_X},
    {"Y", ImGuiKey_Y},
    {"Z", ImGuiKey_Z},
};

// Gives Dear ImGui our key number for each named key. Hosts with their own platform backend do not call this.
inline void fill_key_map() {
#if IMGUI_VERSION_NUM < 18700
    ImGuiIO& io = ImGui::GetIO();
    for (int key = 0; key < ImGuiKey_COUNT; ++key)
        io.KeyMap[key] = key;
#endif
}

inline void feed_mouse_position(ImVec2 position) {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
    io.AddMousePosEvent(position.x, position.y);
#else
    io.MousePos = position;
#endif
}

inline void feed_mouse_button(int button, bool down) {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
    io.AddMouseButtonEvent(button, down);
#else
    io.MouseDown[button] = down;
#endif
}

inline void feed_wheel(float notches) {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
    io.AddMouseWheelEvent(0.0f, notches);
#else
    io.MouseWheel += notches;
#endif
}

inline void feed_modifiers(bool ctrl, bool shift, bool alt) {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18900
    io.AddKeyEvent(ImGuiMod_Ctrl, ctrl);
    io.AddKeyEvent(ImGuiMod_Shift, shift);
    io.AddKeyEvent(ImGuiMod_Alt, alt);
#elif IMGUI_VERSION_NUM >= 18700
    io.AddKeyEvent(ImGuiKey_ModCtrl, ctrl);
    io.AddKeyEvent(ImGuiKey_ModShift, shift);
    io.AddKeyEvent(ImGuiKey_ModAlt, alt);
#else
    io.KeyCtrl = ctrl;
    io.KeyShift = shift;
    io.KeyAlt = alt;
#endif
}

inline void feed_key(ImGuiKey key, bool down) {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
    io.AddKeyEvent(key, down);
#else
    io.KeysDown[io.KeyMap[key]] = down;
#endif
}

inline bool key_pressed(ImGuiKey key) {
#if IMGUI_VERSION_NUM >= 18700
    return ImGui::IsKeyPressed(key);
#else
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
#endif
}

inline void feed_text(const char* utf8) {
    ImGui::GetIO().AddInputCharactersUTF8(utf8);
}

// Scripts feed one event per frame; the queue of later versions must not add its own delays.
inline void feed_without_trickling() {
#if IMGUI_VERSION_NUM >= 18700
    ImGui::GetIO().ConfigInputTrickleEventQueue = false;
#endif
}

// After an exception: ends what was begun since construction, directly after ImGui::NewFrame(), and not
// ended.
class FrameRecovery {
  public:
#if IMGUI_VERSION_NUM >= 19130
    FrameRecovery() {
        ImGui::ErrorRecoveryStoreState(&state_);
    }
    void recover() const {
        ImGuiIO& io = ImGui::GetIO();
        const ImGuiIO before = io;
        io.ConfigErrorRecoveryEnableAssert = io.ConfigErrorRecoveryEnableDebugLog = false;
        io.ConfigErrorRecoveryEnableTooltip = false;
        ImGui::ErrorRecoveryTryToRecoverState(&state_);
        io.ConfigErrorRecoveryEnableAssert = before.ConfigErrorRecoveryEnableAssert;
        io.ConfigErrorRecoveryEnableDebugLog = before.ConfigErrorRecoveryEnableDebugLog;
        io.ConfigErrorRecoveryEnableTooltip = before.ConfigErrorRecoveryEnableTooltip;
    }

  private:
    ImGuiErrorRecoveryState state_;
#else
    FrameRecovery() : fonts_(ImGui::GetCurrentContext()->FontStack.Size) {}
    void recover() const {
        while (ImGui::GetCurrentContext()->FontStack.Size > fonts_)
            ImGui::PopFont();
        ImGui::ErrorCheckEndFrameRecover(nullptr);
    }

  private:
    int fonts_;
#endif
};

// Ends what ImGui::Begin(), BeginChild(), BeginGroup() or another began: `what` is its end. Where
// SetCursorPos() was last is part of its content, as Dear ImGui took for granted until 1.91.
inline void end(void (*what)()) {
#if IMGUI_VERSION_NUM >= 19200
    if (ImGui::GetCurrentWindow()->DC.IsSetPos) ImGui::Dummy({0, 0});
#endif
    what();
}

inline ImTextureID texture_id(unsigned texture) {
#if IMGUI_VERSION_NUM >= 19140
    return static_cast<ImTextureID>(texture);
#else
    return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));
#endif
}

inline unsigned texture_name(ImTextureID id) {
#if IMGUI_VERSION_NUM >= 19140
    return static_cast<unsigned>(id);
#else
    return static_cast<unsigned>(reinterpret_cast<std::uintptr_t>(id));
#endif
}

// A face at a size in pixels. Until 1.91 a face has one size, since then any.
struct Font {
    ImFont* face = nullptr;
    float pixels = 0.0f;
};
void use_default_font(const Font& font);
// Until ImGui::PopFont().
void push_font(const Font& font);
// The text box of that label, which follows, takes the keyboard. Dear ImGui's own SetKeyboardFocusHere() does
// nothing in 1.90 after a click into a child window.
void focus_text_box(const char* label);
ImVec2 text_size(const Font& font, const char* text);
bool has_glyph(const Font& font, unsigned code);
// Those that can be drawn without another upload: all of them, and since 1.92 those drawn so far.
const ImVector<ImFontGlyph>& glyphs(const Font& font);

// Since 1.92 a source gives all its letters, and this keeps some out; until then, those of its ranges.
void exclude_glyphs(ImFontConfig& config, const ImWchar* ranges);

// A letter that no file of a font has: how much of the pixel (x, y) of `side` it covers, 0 to 1.
struct DrawnGlyph {
    ImWchar code;
    int side;  // pixels
    float advance;
    ImVec2 offset;
    float (*coverage)(int x, int y, int side);
};
// Lets a font take such letters. Called after its files were added and before the next font is: only the last
// font of an atlas can be added to.
void make_room_for_drawn_glyphs(const Font& font);
// Adds it to the fonts that have room. All fonts of the atlas have been added before.
void add_drawn_glyph(std::initializer_list<Font> fonts, const DrawnGlyph& glyph);

// How a renderer holds textures, which it names by numbers above 0. Pixels are RGBA.
struct TextureStore {
    std::function<unsigned(int width, int height, const void* pixels)> make;
    // A part of a texture; `row` is the width of the whole, in pixels.
    std::function<void(unsigned name, int x, int y, int width, int height, const void* pixels, int row)>
        update;
    std::function<void(unsigned name)> remove;
};
// After fonts were loaded; between two frames, before `data` is drawn; and at the end.
void make_textures(const TextureStore& store);
void serve_textures(const ImDrawData& data, const TextureStore& store);
void remove_textures(const TextureStore& store);
// Equal for commands with the same texture, also before that is made.
std::uint64_t texture_key(const ImDrawCmd& command);
bool draws_letters(const ImDrawCmd& command);

// Draws `text` from `min`, cut by an ellipsis at `right`.
void ellipsis_text(ImDrawList& list, ImVec2 min, ImVec2 max, float right, const char* text,
                   const char* end = nullptr, const ImVec2* size = nullptr);

}  // namespace slipface::ui

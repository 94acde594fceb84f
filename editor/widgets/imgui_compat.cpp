#include "widgets/imgui_compat.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

namespace slipface::ui {
namespace {

unsigned char alpha_of(const DrawnGlyph& glyph, int x, int y) {
    return static_cast<unsigned char>(
        std::lround(std::clamp(glyph.coverage(x, y, glyph.side), 0.0f, 1.0f) * 255.0f));
}

}  // namespace

ImVec2 text_size(const Font& font, const char* text) {
    return font.face->CalcTextSizeA(font.pixels, FLT_MAX, 0.0f, text);
}

void focus_text_box(const char* label) {
#if IMGUI_VERSION_NUM >= 18900
    ImGuiContext& context = *ImGui::GetCurrentContext();
    context.NavActivateId = ImGui::GetID(label);
    context.NavActivateFlags = ImGuiActivateFlags_PreferInput;
#else
    (void)label;
    ImGui::SetKeyboardFocusHere();
#endif
}

#ifdef IMGUI_HAS_TEXTURES

namespace {

std::vector<DrawnGlyph> drawn_glyphs;

const DrawnGlyph* find_drawn(ImWchar code) {
    const auto found = std::ranges::find(drawn_glyphs, code, &DrawnGlyph::code);
    return found == drawn_glyphs.end() ? nullptr : &*found;
}

bool holds_drawn(ImFontAtlas*, ImFontConfig*, ImWchar code) {
    return find_drawn(code) != nullptr;
}

bool load_drawn(ImFontAtlas* atlas, ImFontConfig* source, ImFontBaked* baked, void*, ImWchar code,
                ImFontGlyph* out, float* advance) {
    const DrawnGlyph* const glyph = find_drawn(code);
    if (!glyph) return false;
    if (advance) {
        *advance = glyph->advance;
        return true;
    }
    const ImFontAtlasRectId place = ImFontAtlasPackAddRect(atlas, glyph->side, glyph->side);
    if (place == ImFontAtlasRectId_Invalid) return false;
    std::vector<unsigned char> alpha;
    for (int y = 0; y < glyph->side; ++y)
        for (int x = 0; x < glyph->side; ++x)
            alpha.push_back(alpha_of(*glyph, x, y));
    out->Codepoint = code;
    out->AdvanceX = glyph->advance;
    out->X0 = glyph->offset.x;
    out->Y0 = glyph->offset.y;
    out->X1 = out->X0 + static_cast<float>(glyph->side);
    out->Y1 = out->Y0 + static_cast<float>(glyph->side);
    out->Visible = true;
    out->PackId = place;
    ImFontAtlasBakedSetFontGlyphBitmap(atlas, baked, source, out, ImFontAtlasPackGetRect(atlas, place),
                                       alpha.data(), ImTextureFormat_Alpha8, glyph->side);
    return true;
}

void remove_texture(ImTextureData& texture, const TextureStore& store) {
    if (texture.TexID != ImTextureID_Invalid) store.remove(texture_name(texture.TexID));
    texture.SetTexID(ImTextureID_Invalid);
    texture.SetStatus(ImTextureStatus_Destroyed);
}

}  // namespace

void use_default_font(const Font& font) {
    ImGui::GetIO().FontDefault = font.face;
    ImGui::GetStyle().FontSizeBase = font.pixels;
}

void push_font(const Font& font) {
    ImGui::PushFont(font.face, font.pixels);
}

void exclude_glyphs(ImFontConfig& config, const ImWchar* ranges) {
    config.GlyphExcludeRanges = ranges;
}

bool has_glyph(const Font& font, unsigned code) {
    return font.face->IsGlyphInFont(static_cast<ImWchar>(code));
}

const ImVector<ImFontGlyph>& glyphs(const Font& font) {
    return font.face->GetFontBaked(font.pixels)->Glyphs;
}

void make_room_for_drawn_glyphs(const Font& font) {
    static const ImFontLoader loader = [] {
        ImFontLoader made;
        made.Name = "drawn";
        made.FontSrcContainsGlyph = holds_drawn;
        made.FontBakedLoadGlyph = load_drawn;
        return made;
    }();
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.MergeMode = true;
    config.SizePixels = font.pixels;
    config.FontLoader = &loader;
    ImGui::GetIO().Fonts->AddFont(&config);
}

void add_drawn_glyph(std::initializer_list<Font>, const DrawnGlyph& glyph) {
    std::erase_if(drawn_glyphs, [&](const DrawnGlyph& old) { return old.code == glyph.code; });
    drawn_glyphs.push_back(glyph);
}

void make_textures(const TextureStore&) {
    ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasTextures;
}

void serve_textures(const ImDrawData& data, const TextureStore& store) {
    if (!data.Textures) return;
    for (ImTextureData* const texture : *data.Textures) {
        switch (texture->Status) {
            case ImTextureStatus_WantCreate:
                texture->SetTexID(
                    texture_id(store.make(texture->Width, texture->Height, texture->GetPixels())));
                texture->SetStatus(ImTextureStatus_OK);
                break;
            case ImTextureStatus_WantUpdates:
                for (const ImTextureRect& part : texture->Updates)
                    store.update(texture_name(texture->TexID), part.x, part.y, part.w, part.h,
                                 texture->GetPixelsAt(part.x, part.y), texture->Width);
                texture->SetStatus(ImTextureStatus_OK);
                break;
            case ImTextureStatus_WantDestroy:
                if (texture->UnusedFrames > 0) remove_texture(*texture, store);
                break;
            case ImTextureStatus_OK:
            case ImTextureStatus_Destroyed: break;
        }
    }
}

void remove_textures(const TextureStore& store) {
    for (ImTextureData* const texture : ImGui::GetPlatformIO().Textures)
        if (texture->RefCount == 1) remove_texture(*texture, store);
}

std::uint64_t texture_key(const ImDrawCmd& command) {
    const ImTextureRef& texture = command.TexRef;
    // Both count from 1; the atlas's own are few.
    return texture._TexData ? ~static_cast<std::uint64_t>(texture._TexData->UniqueID)
                            : texture_name(texture._TexID);
}

bool draws_letters(const ImDrawCmd& command) {
    return command.TexRef._TexData == ImGui::GetIO().Fonts->TexData;
}

#else

void use_default_font(const Font& font) {
    ImGui::GetIO().FontDefault = font.face;
}

void push_font(const Font& font) {
    ImGui::PushFont(font.face);
}

void exclude_glyphs(ImFontConfig&, const ImWchar*) {}

bool has_glyph(const Font& font, unsigned code) {
    return font.face->FindGlyphNoFallback(static_cast<ImWchar>(code)) != nullptr;
}

const ImVector<ImFontGlyph>& glyphs(const Font& font) {
    return font.face->Glyphs;
}

void make_room_for_drawn_glyphs(const Font&) {}

void add_drawn_glyph(std::initializer_list<Font> fonts, const DrawnGlyph& glyph) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    std::vector<int> places;
    for (const Font& font : fonts)
        places.push_back(atlas.AddCustomRectFontGlyph(font.face, glyph.code, glyph.side, glyph.side,
                                                      glyph.advance, glyph.offset));
    atlas.Build();
    unsigned char* alpha = nullptr;
    int width = 0;
    atlas.GetTexDataAsAlpha8(&alpha, &width, nullptr);
    for (const int place : places) {
        const ImFontAtlasCustomRect* const rect = atlas.GetCustomRectByIndex(place);
        for (int y = 0; y < glyph.side; ++y)
            for (int x = 0; x < glyph.side; ++x)
                alpha[(rect->Y + y) * width + rect->X + x] = alpha_of(glyph, x, y);
    }
}

void remove_textures(const TextureStore& store) {
    ImTextureID& letters = ImGui::GetIO().Fonts->TexID;
    if (letters != ImTextureID()) store.remove(texture_name(letters));
    letters = ImTextureID();
}

void make_textures(const TextureStore& store) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    remove_textures(store);
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    atlas.GetTexDataAsRGBA32(&pixels, &width, &height);
    atlas.SetTexID(texture_id(store.make(width, height, pixels)));
    atlas.ClearTexData();
}

void serve_textures(const ImDrawData&, const TextureStore&) {}

std::uint64_t texture_key(const ImDrawCmd& command) {
    return texture_name(command.GetTexID());
}

bool draws_letters(const ImDrawCmd& command) {
    return command.GetTexID() == ImGui::GetIO().Fonts->TexID;
}

#endif

namespace {

// Until 1.91 it takes where the text and where the ellipsis ends, since then one number.
template <class Render>
void render_ellipsis(Render* render, ImDrawList* list, ImVec2 min, ImVec2 max, float right, const char* text,
                     const char* end, const ImVec2* size) {
    if constexpr (std::is_invocable_v<Render, ImDrawList*, ImVec2, ImVec2, float, float, const char*,
                                      const char*, const ImVec2*>)
        render(list, min, max, right, right, text, end, size);
    else
        render(list, min, max, right, text, end, size);
}

}  // namespace

void ellipsis_text(ImDrawList& list, ImVec2 min, ImVec2 max, float right, const char* text, const char* end,
                   const ImVec2* size) {
    render_ellipsis(&ImGui::RenderTextEllipsis, &list, min, max, right, text, end, size);
}

}  // namespace slipface::ui

#include <algorithm>
#include <cstring>

#include "gl_util.h"

namespace slipface {

namespace {

// Every GL 3.3 driver has 4 samples; Mesa's software renderer has no other number.
constexpr GLsizei samples = 4;

int bounded_side(const GladGLContext& gl, int side) {
    GLint texture_limit = 0, renderbuffer_limit = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture_limit);
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer_limit);
    return std::clamp(side, 1,
                      std::max(1, std::min({texture_limit, renderbuffer_limit, max_framebuffer_side})));
}

}  // namespace

Framebuffer::Framebuffer(GlTable gl, int width, int height)
    : gl_(std::move(gl)), width_(bounded_side(*gl_, width)), height_(bounded_side(*gl_, height)) {
    gl_->GenRenderbuffers(1, &msaa_color_);
    gl_->BindRenderbuffer(GL_RENDERBUFFER, msaa_color_);
    gl_->RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width_, height_);
    gl_->GenRenderbuffers(1, &msaa_depth_);
    gl_->BindRenderbuffer(GL_RENDERBUFFER, msaa_depth_);
    gl_->RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH24_STENCIL8, width_, height_);
    gl_->BindRenderbuffer(GL_RENDERBUFFER, 0);
    gl_->GenFramebuffers(1, &msaa_framebuffer_);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, msaa_framebuffer_);
    gl_->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, msaa_color_);
    gl_->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, msaa_depth_);

    gl_->GenTextures(1, &resolve_texture_);
    gl_->BindTexture(GL_TEXTURE_2D, resolve_texture_);
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl_->BindTexture(GL_TEXTURE_2D, 0);
    gl_->GenFramebuffers(1, &resolve_framebuffer_);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, resolve_framebuffer_);
    gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, resolve_texture_, 0);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, 0);
    assert_no_gl_error(*gl_, "Framebuffer");
}

Framebuffer::~Framebuffer() {
    gl_->DeleteFramebuffers(1, &msaa_framebuffer_);
    gl_->DeleteFramebuffers(1, &resolve_framebuffer_);
    gl_->DeleteRenderbuffers(1, &msaa_color_);
    gl_->DeleteRenderbuffers(1, &msaa_depth_);
    gl_->DeleteRenderbuffers(1, &draft_depth_);
    gl_->DeleteTextures(1, &resolve_texture_);
}

void Framebuffer::bind() {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, msaa_framebuffer_);
    gl_->Viewport(0, 0, width_, height_);
}

void Framebuffer::bind_draft() {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, resolve_framebuffer_);
    if (draft_depth_ == 0) {
        gl_->GenRenderbuffers(1, &draft_depth_);
        gl_->BindRenderbuffer(GL_RENDERBUFFER, draft_depth_);
        gl_->RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width_, height_);
        gl_->BindRenderbuffer(GL_RENDERBUFFER, 0);
        gl_->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                                     draft_depth_);
    }
    gl_->Viewport(0, 0, width_, height_);
    assert_no_gl_error(*gl_, "Framebuffer::bind_draft");
}

void Framebuffer::resolve() {
    gl_->Disable(GL_SCISSOR_TEST);
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, msaa_framebuffer_);
    gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolve_framebuffer_);
    gl_->BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, 0);
    assert_no_gl_error(*gl_, "Framebuffer::resolve");
}

Image Framebuffer::read() {
    resolve();
    Image image;
    image.width = width_;
    image.height = height_;
    image.rgba.resize(4 * image.pixel_count());
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, resolve_framebuffer_);
    gl_->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl_->PixelStorei(GL_PACK_ROW_LENGTH, 0);
    gl_->ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    gl_->BindFramebuffer(GL_FRAMEBUFFER, 0);
    assert_no_gl_error(*gl_, "Framebuffer::read");

    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
        image.rgba[i] = 255;
    const auto row_bytes = 4 * static_cast<std::ptrdiff_t>(width_);
    for (int top = 0, bottom = height_ - 1; top < bottom; ++top, --bottom) {
        std::swap_ranges(image.rgba.begin() + top * row_bytes, image.rgba.begin() + (top + 1) * row_bytes,
                         image.rgba.begin() + bottom * row_bytes);
    }
    return image;
}

}  // namespace slipface

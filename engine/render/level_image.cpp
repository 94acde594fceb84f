#include "slipface/render/level_image.h"

#include <glad/gl.h>

#include <algorithm>
#include <chrono>
#include <iterator>

#include "show_level.h"

namespace slipface {

struct LevelPainter::Impl {
    explicit Impl(OffscreenContext& of) : context(of), level(of.gl()), overlay(of.gl()) {}

    OffscreenContext& context;
    LevelRenderer level;
    OverlayRenderer overlay;
    std::unique_ptr<Framebuffer> target;  // of the last image's size
    double drawing_s = 0.0;
};

LevelPainter::LevelPainter() = default;

LevelPainter::~LevelPainter() {
    if (impl_) impl_->context.make_current();  // null: making it failed
}

double LevelPainter::drawing_s() const {
    return impl_->drawing_s;
}

Result<std::unique_ptr<LevelPainter>> LevelPainter::make(OffscreenContext& context, const Level& level,
                                                         Warnings* warnings) {
    if (!context.make_current()) return Error{context.backend_name(), "the context cannot be made current"};
    while (context.gl()->GetError() != GL_NO_ERROR) {
    }
    std::unique_ptr<LevelPainter> painter(new LevelPainter);
    painter->impl_ = std::make_unique<Impl>(context);
    Impl& impl = *painter->impl_;
    if (Status status = impl.level.status(); !status) return status.error();
    if (Status status = impl.overlay.status(); !status) return status.error();
    Warnings found = show_level(impl.level, level);
    if (warnings != nullptr) std::move(found.begin(), found.end(), std::back_inserter(*warnings));
    return painter;
}

Result<Image> LevelPainter::image(const Camera& camera, int width, int height, const LevelStyle& style,
                                  const Overlay* overlay) {
    OffscreenContext& context = impl_->context;
    if (width < 1 || height < 1 || width > max_framebuffer_side || height > max_framebuffer_side) {
        return Error{"picture size", "found " + std::to_string(width) + "x" + std::to_string(height) +
                                         ", expected 1 to " + std::to_string(max_framebuffer_side) +
                                         " pixels a side"};
    }
    if (!context.make_current()) return Error{context.backend_name(), "the context cannot be made current"};
    std::unique_ptr<Framebuffer>& target = impl_->target;
    if (!target || target->width() != width || target->height() != height)
        target = std::make_unique<Framebuffer>(context.gl(), width, height);
    const auto start = std::chrono::steady_clock::now();
    target->bind();
    impl_->level.draw(camera, width, height, style);
    if (overlay != nullptr) impl_->overlay.draw(*overlay, camera, width, height);
    target->resolve();
    context.gl()->Finish();
    impl_->drawing_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Image image = target->read();
    if (const unsigned error = context.gl()->GetError(); error != GL_NO_ERROR) {
        return Error{context.renderer(), "OpenGL reports error " + std::to_string(error)};
    }
    if (image.width != width || image.height != height) {
        return Error{context.renderer(), "cannot draw an image of " + std::to_string(width) + "x" +
                                             std::to_string(height) + " pixels"};
    }
    return image;
}

Result<Image> render_level_image(OffscreenContext& context, const Level& level, const Camera& camera,
                                 int width, int height, const LevelStyle& style, const Overlay* overlay,
                                 Warnings* warnings) {
    const auto painter = LevelPainter::make(context, level, warnings);
    if (!painter) return painter.error();
    return (*painter)->image(camera, width, height, style, overlay);
}

}  // namespace slipface

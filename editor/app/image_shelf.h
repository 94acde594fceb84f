// Small images of levels that are not open, drawn once and stored as textures.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "panels/panels.h"
#include "slipface/render/gl_context.h"

namespace slipface {

class ImageShelf final : public ImageServices {
  public:
    explicit ImageShelf(GlTable gl);
    ~ImageShelf() override;
    unsigned image(const std::string& key, int width, int height,
                   const std::function<ImageRequest()>& request) override;

  private:
    GlTable gl_;
    std::map<std::string, std::unique_ptr<Framebuffer>> images_;
};

}  // namespace slipface

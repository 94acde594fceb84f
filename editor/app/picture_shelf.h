// Small pictures of levels that are not open, drawn once and kept as textures.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "panels/panels.h"
#include "slipface/render/gl_context.h"

namespace slipface {

class PictureShelf final : public PictureServices {
  public:
    explicit PictureShelf(GlTable gl);
    ~PictureShelf() override;
    unsigned picture(const std::string& key, int width, int height,
                     const std::function<PictureRequest()>& request) override;

  private:
    GlTable gl_;
    std::map<std::string, std::unique_ptr<Framebuffer>> pictures_;
};

}  // namespace slipface

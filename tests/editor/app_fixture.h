// The editor off-screen with a small level, and short names for what a test does with it.
#pragma once

#include "app/offscreen_host.h"
#include "app/script.h"
#include "level_fixture.h"
#include "widgets/ui.h"

namespace slipface {

class AppFixture : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        start({});
    }

    void start(OffscreenOptions options) {
        host.reset();
        auto made = OffscreenHost::make(options);
        ASSERT_TRUE(made) << made.error().text();
        host = std::move(made).value();
        open_level(editor(), obj);
        ASSERT_FALSE(editor().message) << editor().message->text;
        editor().import_card.shown = false;  // it covers a part of the view
        host->frame();
    }

    Editor& editor() { return host->editor(); }
    const Document& document() { return *host->editor().document; }

    // Runs lines of a script; the failure's text, or nothing.
    std::string run(const std::string& text) {
        const ScriptResult result = run_script(*host, text, "test.script", folder);
        return result ? std::string() : result.error.text();
    }
    // Looks straight down on the floor, 8 x 8 m around (4, 0, 4).
    void look_down() { ASSERT_EQ(run("camera eye 4,14,4.01 target 4,0,4"), ""); }

    std::unique_ptr<OffscreenHost> host;
};

}  // namespace slipface

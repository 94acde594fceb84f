// The editor in a page: the third driver of the app's frame beside a window and an off-screen image.
#pragma once

#include "app/app.h"

namespace slipface {

struct PageOptions {
    float scale = 1.0f;  // the screen's pixels per CSS pixel
    std::filesystem::path
        home;  // the folder that the page stores: levels, preferences, autosaves; empty: none
};

// Makes the context and the app, and asks the browser to call for frames. Fails if there is no WebGL 2.
Status start_page(const PageOptions& options);
App* page_app();  // null before start_page() and after Quit
// Writes what is not saved into the autosaves now; the page is about to be hidden or closed.
void autosave_now();
void page_needs_frames();  // after a change that no event of this file made
void page_pasted(std::string text);

}  // namespace slipface

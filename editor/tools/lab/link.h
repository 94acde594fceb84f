// Links: what stands behind the '#' of a page's address, and opening it.
#pragma once

#include <span>
#include <string_view>

#include "slipface/base/result.h"

namespace slipface {

struct Editor;

// A link has parts, "demo=step-up&only=view"; one row for each.
struct LinkPart {
    const char* name;
    const char* value;  // what it looks like
    const char* meaning;
};
std::span<const LinkPart> link_parts();

// Whether `text` is meant as a link: parts, an address that ends with '#' and parts, or the name of a file
// *.link.
bool is_link(std::string_view text);

// Opens it. All parts are read before the first is acted on: damaged texts and unknown names change nothing.
// A demo asks first if there are unsaved changes; with them a capsule and a level are an error.
Status open_link(Editor& editor, std::string_view text);

}  // namespace slipface

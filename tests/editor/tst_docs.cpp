// The pages of docs/ that are made from tables say what the tables say. `slipface docs` writes them again.
#include <gtest/gtest.h>

#include "app/script.h"
#include "slipface/base/files.h"
#include "tools/commands/docs.h"

namespace slipface {
namespace {

void expect_page(const std::string& name, const std::string& text) {
    const auto file = read_file(std::string(SLIPFACE_SOURCE_DIR) + "/docs/" + name);
    ASSERT_TRUE(file.ok()) << file.error().text();
    EXPECT_EQ(*file, text) << "run: slipface docs";
}

TEST(Docs, CommandsPageFollowsTheTable) {
    expect_page("commands.md", commands_markdown());
}

TEST(Docs, SettingsPageFollowsTheTable) {
    expect_page("settings.md", settings_markdown());
}

TEST(Docs, ScriptingPageFollowsTheVerbs) {
    expect_page("scripting.md", script_verbs_markdown());
}

}  // namespace
}  // namespace slipface

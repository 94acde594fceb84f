// The formats that the entry in the desktop's menu names are those that are read.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "slipface/mesh/formats.h"

namespace slipface {
namespace {

std::string desktop_file(const std::string& name) {
    const Result<std::string> text = read_file(std::string(SLIPFACE_SOURCE_DIR) + "/editor/desktop/" + name);
    return text ? *text : std::string();
}

TEST(Desktop, OpensEveryFormatThatIsRead) {
    // The types by ending, as the desktop learns them.
    const std::string types = desktop_file("slipface.xml"), entry = desktop_file("slipface.desktop");
    std::map<std::string, std::string> type_of;
    std::string type;
    const std::regex line(R"re(<mime-type type="([^"]+)">|<glob pattern="\*\.([^"]+)")re");
    for (std::sregex_iterator found(types.begin(), types.end(), line), end; found != end; ++found) {
        if ((*found)[1].matched) type = (*found)[1];
        if ((*found)[2].matched) type_of[(*found)[2]] = type;
    }
    std::set<std::string> expected{type_of["slipface.json"]};
    for (const MeshFormat& format : mesh_formats()) {
        const std::string ending(format.ending);
        EXPECT_TRUE(type_of.contains(ending)) << "slipface.xml has no glob for *." << ending;
        expected.insert(type_of[ending]);
    }
    EXPECT_EQ(type_of.size(), mesh_formats().size() + 1);

    std::set<std::string> found;
    for (const std::string_view text : split(entry, '\n'))
        if (text.starts_with("MimeType="))
            for (const std::string_view word : split(text.substr(text.find('=') + 1), ';'))
                if (!word.empty()) found.emplace(word);
    EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace slipface

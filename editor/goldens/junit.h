// JUnit's XML, which CIs read.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slipface {

struct JunitCase {
    std::string name;
    std::optional<double> seconds = {};
    std::string failure = {};  // its kind; empty: passed
    std::string message = {}, details = {};
};
std::string junit_text(const std::string& suite, const std::vector<JunitCase>& cases,
                       std::optional<double> seconds = {});

// `text` inside of XML or HTML; control characters are left out.
std::string xml_text(std::string_view text);

}  // namespace slipface

// slipface nightly PROJECT.json, slipface nightly merge REPORTS.
#pragma once

namespace CLI {
class App;
}

namespace slipface {

void add_nightly_verb(CLI::App& app, int& exit_code);

}  // namespace slipface

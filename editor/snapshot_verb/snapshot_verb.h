// slipface snapshot: the goldens.
#pragma once

namespace CLI {
class App;
}

namespace slipface {
void add_snapshot_verb(CLI::App& app, int& exit_code);
}

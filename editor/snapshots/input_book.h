// What the snapshots are made from, each read once: levels, demo scenes and tapes, by meaning.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "goldens/golden.h"
#include "goldens/numbers_json.h"

namespace slipface {

class InputBook {
  public:
    // `project` is the folder that names begin in: that of the goldens' folder.
    explicit InputBook(std::filesystem::path project);

    // "inputs/levels/easy" of levels/easy.obj or its level file, "inputs/levels/run.tape" of a tape,
    // "inputs/demo/step-up-on" of demo:step-up:on.
    std::string add(const std::filesystem::path& file);
    // The files below `folder` that a text names: levels and tapes are inputs, their names in `inputs`; of
    // others, but not of those that can be executed, a hash goes into row["files"].
    struct Named {
        std::vector<std::string> inputs;
        std::set<std::filesystem::path> files;  // all of them
    };
    void add_named(std::string_view text, const std::filesystem::path& folder, Named& named, Numbers& row);
    std::vector<std::string> names() const;  // ascending
    // The input as it is now. Error: no such name, or its files cannot be read.
    Result<Input> read(const std::string& name);
    // The snapshot without an image that an input is.
    Snapshot snapshot(const std::string& name);

  private:
    std::filesystem::path project_;
    std::map<std::string, std::filesystem::path> files_;
    std::map<std::string, Input> read_;
};

}  // namespace slipface

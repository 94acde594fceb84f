// What the snapshots are made from, each read once: levels, demo scenes and tapes, by meaning.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "goldens/golden.h"

namespace slipface {

class InputBook {
  public:
    // `project` is the folder that names begin in: that of the goldens' folder.
    explicit InputBook(std::filesystem::path project);

    // "inputs/levels/easy" of levels/easy.obj or its level file, "inputs/levels/run.tape" of a tape,
    // "inputs/demo/step-up-on" of demo:step-up:on.
    std::string add(const std::filesystem::path& file);
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

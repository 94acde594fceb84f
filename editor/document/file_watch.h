// Noticing that other programs change the open level's files.
#pragma once

#include <cstdint>
#include <filesystem>

#include "slipface/mesh/import.h"

namespace slipface {

// Looks at time of change and size, which together tell nearly every change, whenever it is polled.
class FileWatch {
  public:
    // From now on these two, as they are now; after opening, saving and reloading.
    void start(const std::filesystem::path& mesh, const std::filesystem::path& level_file);
    void stop() { watching_ = false; }
    // True once for each change that has come to rest: the same stamp in two polls in a row, and the
    // geometry is there (tools that replace a file take it away for a moment).
    bool poll();
    bool at_rest() const { return at_rest_; }  // the last poll saw what the one before saw
    bool mesh_changed() const { return mesh_now_ != mesh_known_; }
    bool level_changed() const { return level_now_ != level_known_; }
    bool level_gone() const { return !level_now_.there; }
    // Reads the level file: false if it holds the bytes that it held at start(), as after a `touch`. (What
    // the geometry held is known to the document.)
    bool level_has_other_content() const;

  private:
    struct Stamp {
        std::int64_t changed_ns = 0;
        std::uint64_t bytes = 0;
        bool there = false;
        friend bool operator==(const Stamp&, const Stamp&) = default;
    };
    static Stamp stamp_of(const std::filesystem::path& file);

    std::filesystem::path mesh_, level_;
    FileStamp level_content_;
    Stamp mesh_known_, level_known_, mesh_now_, level_now_;
    bool watching_ = false, reported_ = false, at_rest_ = true;
};

}  // namespace slipface

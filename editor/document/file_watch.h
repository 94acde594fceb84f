// Noticing that other programs change the open level's files.
#pragma once

#include <cstdint>
#include <filesystem>

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
    bool mesh_changed() const { return mesh_now_ != mesh_known_; }
    bool level_changed() const { return level_now_ != level_known_; }

  private:
    struct Stamp {
        std::int64_t changed_ns = 0;
        std::uint64_t bytes = 0;
        bool there = false;
        friend bool operator==(const Stamp&, const Stamp&) = default;
    };
    static Stamp stamp_of(const std::filesystem::path& file);

    std::filesystem::path mesh_, level_;
    Stamp mesh_known_, level_known_, mesh_now_, level_now_;
    bool watching_ = false, told_ = false;
};

}  // namespace slipface

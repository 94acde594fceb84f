// Detects changes of the open level's files by other programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace slipface {

// Compares modification time and size at each poll, which finds nearly every change.
class FileWatch {
  public:
    // Watches these files from their present state on. Call it after opening, saving and reloading. The
    // libraries define the mesh's materials, which name the textures. `level_is_known`: false if the level
    // file has been written again meanwhile, so that poll() reports it.
    void start(const std::filesystem::path& mesh, const std::filesystem::path& level_file,
               bool level_is_known, std::vector<std::filesystem::path> libraries = {},
               std::vector<std::filesystem::path> textures = {});
    void stop() { watching_ = false; }
    // True once per completed change: two polls in a row found the same stamp, and the geometry file exists
    // (tools that replace a file remove it for a moment).
    bool poll();
    bool at_rest() const { return at_rest_; }  // the last two polls found the same
    bool mesh_changed() const { return mesh_now_ != mesh_known_; }
    bool level_changed() const { return level_now_ != level_known_; }
    bool level_gone() const { return !level_now_.there; }
    bool libraries_changed() const { return libraries_.now != libraries_.known; }
    bool textures_changed() const { return textures_.now != textures_.known; }

  private:
    struct Stamp {
        std::int64_t changed_ns = 0;
        std::uint64_t bytes = 0;
        bool there = false;
        friend bool operator==(const Stamp&, const Stamp&) = default;
    };
    static Stamp stamp_of(const std::filesystem::path& file);
    struct Group {
        std::vector<std::filesystem::path> files;
        std::vector<Stamp> known, now;  // [file]
    };
    static void look(Group& group);

    std::filesystem::path mesh_, level_;
    Stamp mesh_known_, level_known_, mesh_now_, level_now_;
    Group libraries_, textures_;
    bool watching_ = false, reported_ = false, at_rest_ = true;
};

}  // namespace slipface

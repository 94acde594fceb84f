#pragma once

#include <assimp/IOSystem.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace slipface {

// Lets assimp read only the regular files of one folder and below: a level from elsewhere must not make the
// program read a device, a pipe or private keys.
class FolderIo final : public Assimp::IOSystem {
  public:
    // `asked_for`: gets the path of each file below the folder that is opened or missing, once.
    FolderIo(const std::filesystem::path& folder, std::vector<std::string>& asked_for);

    bool Exists(const char* file) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* file, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;

  private:
    bool readable(const std::filesystem::path& file) const;
    std::filesystem::path folder_;
    std::vector<std::string>& asked_for_;
};

}  // namespace slipface

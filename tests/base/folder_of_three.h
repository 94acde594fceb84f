// A folder of files that are replaced together.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>

#include "scratch_folder.h"
#include "slipface/base/files.h"

namespace slipface::test {

class InFolderOfThree : public InScratchFolder {
  protected:
    void SetUp() override { std::filesystem::create_directory(folder / "inner"); }

    // Three files of one age, one of them in a folder below.
    static std::map<std::string, std::string> contents(const std::string& age) {
        return {
            {"a.obj", age + " geometry"}, {"a.json", age + " level"}, {"inner/a.mtl", age + " materials"}};
    }
    Status write(const std::string& age) const {
        const std::map<std::string, std::string> texts = contents(age);
        std::vector<FileToWrite> files;
        for (const auto& [name, text] : texts)
            files.push_back({folder / name, text});
        return write_files_atomic(files);
    }
    std::map<std::string, std::string> read() const {
        std::map<std::string, std::string> found;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.is_regular_file())
                found[entry.path().lexically_relative(folder).generic_string()] = *read_file(entry.path());
        return found;
    }
    bool has_list() const {
        const auto found = read();
        return std::any_of(found.begin(), found.end(),
                           [](const auto& file) { return file.first.ends_with(".renames"); });
    }
};

}  // namespace slipface::test

// Files of other programs that crash assimp, nest deeper than its stack or take all memory: the program reads
// them in a child process, says what happened, and goes on.
#include <gtest/gtest.h>

#include <vector>

#include "program/run_program.h"

namespace slipface::test {
namespace {

std::string repeated(const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i)
        all += text;
    return all;
}

std::string chain_of_nodes(int count) {
    std::string nodes = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)";
    for (int i = 1; i < count; ++i)
        nodes += "{\"children\":[" + std::to_string(i) + "]},";
    return nodes + "{}]}";
}

// Few bytes that stand for 400 million vertices.
std::string sparse_accessor() {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"buffers":[{"byteLength":36,)"
           R"("uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"componentType":5126,"type":"VEC3",)"
           R"("count":400000000,"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5125},)"
           R"("values":{"bufferView":0}}}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})";
}

struct HostileFile {
    std::string name;
    std::string bytes;
    std::string reason;
};

std::vector<HostileFile> hostile_files() {
    const std::string deep = "is nested too deeply";
    return {
        {"brackets.gltf",
         R"({"asset":{"version":"2.0"},"x":)" + repeated("[", 1'000'000) + repeated("]", 1'000'000) + "}",
         "has no faces"},  // read as deep as it is
        {"chain.gltf", chain_of_nodes(20'000), "has no faces"},
        {"deep.dae",
         R"(<?xml version="1.0"?><COLLADA version="1.4.1"><asset/><library_visual_scenes><visual_scene id="s">)" +
             repeated("<node>", 50'000) + repeated("</node>", 50'000) +
             R"(</visual_scene></library_visual_scenes></COLLADA>)",
         deep},
        {"deep.x", "xof 0303txt 0032\n" + repeated("Frame f {\n", 100'000) + repeated("}\n", 100'000), deep},
        {"deep.ac", "AC3Db\nMATERIAL \"m\" rgb 1 1 1\n" + repeated("OBJECT group\nkids 1\n", 100'000), deep},
        {"deep.fbx", "; FBX 7.3.0 project file\n" + repeated("A: {\n", 200'000) + repeated("}\n", 200'000),
         deep},
        {"sparse.gltf", sparse_accessor(), "too many"},
    };
}

TEST(SceneChild, HostileFilesAreRefusedWithTheReason) {
    const ScratchFolder folder;
    for (const HostileFile& file : hostile_files()) {
        const ProgramRun run = run_program("info " + folder.write(file.name, file.bytes));
        EXPECT_EQ(run.exit_code, 2) << file.name;
        EXPECT_NE(run.output.find(file.name), std::string::npos) << run.output.substr(0, 400);
        EXPECT_NE(run.output.find(file.reason), std::string::npos) << run.output.substr(0, 400);
    }
}

TEST(SceneChild, TheEditorKeepsItsLevel) {
    const ScratchFolder folder;
    const std::string level = std::string(SLIPFACE_SOURCE_DIR) + "/assets/levels/easy.obj";
    for (const HostileFile& file : hostile_files()) {
        const std::string bad = folder.write(file.name, file.bytes);
        const std::string script = folder.write("script", "drop " + bad + "\nwait 3\nexpect message \"*" +
                                                              file.reason + "*\"\nexpect title \"*easy*\"\n");
        const ProgramRun run = run_program("edit " + level + " --script " + script);
        EXPECT_EQ(run.exit_code, 0) << file.name << ": " << run.output.substr(0, 400);
    }
}

TEST(SceneChild, WhatItReadsIsWhatWasWritten) {
    const ScratchFolder folder;
    const std::string level = std::string(SLIPFACE_SOURCE_DIR) + "/assets/levels/playground.obj";
    const std::string copy = (folder / "copy.gltf").string();
    ASSERT_EQ(run_program("export " + level + " --gltf " + copy).exit_code, 0);
    const auto line = [](const std::string& text, const std::string& name) {
        const std::size_t begin = text.find("\n" + name);
        return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin + 1) - begin);
    };
    const std::string written = run_program("info " + level).output,
                      read = run_program("info " + copy).output;
    for (const std::string name : {"triangles", "bounds min", "bounds max", "size"}) {
        EXPECT_NE(line(read, name), "") << read;
        EXPECT_EQ(line(read, name), line(written, name));
    }
}

}  // namespace
}  // namespace slipface::test

// slipface/capture.h in a program with Dear ImGui: the frame's windows and widgets by name.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "slipface/capture.h"
#include "slipface/image/image.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

class CaptureTest : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(folder_);
        setenv("SLIPFACE_CAPTURE", folder_.c_str(), 1);
    }
    void TearDown() override {
        unsetenv("SLIPFACE_CAPTURE");
        fs::remove_all(folder_);
    }
    nlohmann::json json(const char* name) const {
        std::ifstream file(folder_ / name);
        return nlohmann::json::parse(file, nullptr, false);
    }
    const fs::path folder_ =
        fs::path(testing::TempDir()) / ("slipface_capture_" + std::to_string(::getpid()));
};

TEST_F(CaptureTest, NothingIsWrittenWithoutTheVariable) {
    unsetenv("SLIPFACE_CAPTURE");
    Capture capture("a");
    EXPECT_FALSE(capture.wanted());
    EXPECT_TRUE(capture.write(nullptr, 4, 4));
    setenv("SLIPFACE_CAPTURE", (folder_ / "gone").c_str(), 1);
    const std::uint8_t pixel[4] = {};
    EXPECT_FALSE(Capture("a").write(pixel, 1, 1));
}

// Images of more than one block of data, and rows in either order, are read back as they were.
TEST_F(CaptureTest, ImagesAreReadBack) {
    for (const bool from_bottom : {false, true}) {
        Image image{211, 97, {}};
        for (int i = 0; i < image.width * image.height * 4; ++i)
            image.rgba.push_back(static_cast<std::uint8_t>(i * 7 + i / 900));
        std::vector<std::uint8_t> rows = image.rgba;
        const std::size_t row = static_cast<std::size_t>(image.width) * 4;
        if (from_bottom)
            for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
                std::copy_n(image.rgba.data() + (static_cast<std::size_t>(image.height) - 1 - y) * row, row,
                            rows.data() + y * row);
        ASSERT_TRUE(Capture("frame").write(rows.data(), image.width, image.height, from_bottom));
        const Result<Image> read = load_image(folder_ / "frame.png");
        ASSERT_TRUE(read.ok()) << read.error().text();
        EXPECT_EQ(*read, image);
    }
}

TEST_F(CaptureTest, WindowsAndWidgetsOfDearImGui) {
    ImGuiContext* const other = ImGui::GetCurrentContext();
    ImGuiContext* const own = ImGui::CreateContext();
    ImGui::SetCurrentContext(own);
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().DisplaySize = {200, 100};
    unsigned char* letters = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&letters, &width, &height);
    Capture capture("window");
    for (int frame = 0; frame < 3; ++frame) {
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({10, 20});
        ImGui::SetNextWindowSize({120, 70});
        ImGui::Begin("Tools");
        ImGui::Button("Save \"all\"", {60, 20});
        capture_item(capture, "Save \"all\"");
        // What Dear ImGui calls where it is compiled with IMGUI_ENABLE_TEST_ENGINE.
        const ImGuiID id = ImGui::GetItemID();
        capture_item_box(own, id, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
        capture_item_label(own, id, "Save");
        ImGui::End();
        ImGui::Render();
    }
    capture_windows(capture);
    capture.number("half", 0.5);
    capture.number("none", 0.0 / std::strtod("0", nullptr));
    const std::vector<std::uint8_t> pixels(4 * 2 * 2);
    ASSERT_TRUE(capture.write(pixels.data(), 2, 2));
    ImGui::DestroyContext(own);
    ImGui::SetCurrentContext(other);
    const nlohmann::json found = json("window.json");
    ASSERT_TRUE(found.is_object());
    EXPECT_EQ(found["widgets"]["Tools"], nlohmann::json({10, 20, 120, 70}));
    EXPECT_EQ(found["widgets"]["Save \"all\""][2], 60);
    EXPECT_EQ(found["widgets"]["Tools/Save"], found["widgets"]["Save \"all\""]);
    EXPECT_EQ(found["numbers"]["half"], 0.5);
    EXPECT_TRUE(found["numbers"]["none"].is_string());
}

}  // namespace
}  // namespace slipface

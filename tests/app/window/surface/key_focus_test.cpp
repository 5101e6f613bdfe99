// Tests of app/window/surface/key_focus, in Dear ImGui's frames without a window.
#include "app/window/surface/key_focus.h"

#include <gtest/gtest.h>
#include <imgui.h>

namespace seldinger::app {
namespace {

// A briefing in little: what leads on is there after what leads out.
class KeyFocusTest : public testing::Test {
 protected:
  void SetUp() override {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.KeyMap[ImGuiKey_Space] = 32;  // Dear ImGui asks for one where keys walk
    io.DisplaySize = {800.0F, 600.0F};
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  }
  void TearDown() override {
    walk_by_keys(false, false, false, true);
    ImGui::DestroyContext();
  }
  void frame(bool tab, bool press, bool ready) {
    walk_by_keys(true, tab, press, false);
    ImGui::GetIO().DeltaTime = 1.0F / 60.0F;
    ImGui::NewFrame();
    ImGui::Begin("briefing");
    begin_way();
    out_ = ImGui::Button("Back") || out_;
    at_back_ = framed();
    ImGui::BeginDisabled(!ready);
    on_ = ImGui::Button("Enter the room") || on_;
    if (at_back_ && ready && !was_ready_) focus_here();
    was_ready_ = ready;
    at_enter_ = framed();
    ImGui::EndDisabled();
    end_way();
    ImGui::End();
    ImGui::Render();
  }
  bool at_back_ = false, at_enter_ = false, out_ = false, on_ = false, was_ready_ = false;
};

TEST_F(KeyFocusTest, GoesOnFromWhatItIsBroughtTo) {
  frame(true, false, false);
  for (int i = 0; i < 3; ++i) frame(false, false, false);
  ASSERT_TRUE(at_back_);
  frame(false, false, true);
  frame(false, false, true);
  EXPECT_FALSE(at_back_);
  EXPECT_TRUE(at_enter_);
  frame(false, true, true);
  for (int i = 0; i < 3; ++i) frame(false, false, true);
  EXPECT_TRUE(on_);
  EXPECT_FALSE(out_) << "Enter would lead out";
}

}  // namespace
}  // namespace seldinger::app

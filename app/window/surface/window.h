// The workstation's window: GLFW's window with a GL 4.3 context, and Dear ImGui in it. The door of GLFW, and with
// app/window/screens/panel_* of Dear ImGui.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/surface/window_size_json.h"
#include "sim/devices/hands/gamepad_hands.h"
#include "sim/gpu/context.h"

namespace seldinger::app {

// Keys as GLFW numbers them; letters and digits are their capital ASCII.
enum Key : int {
  kSpace = 32,
  kEscape = 256,
  kEnter = 257,
  kTab = 258,
  kBackspace = 259,
  kRight = 262,
  kLeft = 263,
  kDown = 264,
  kUp = 265,
  kPageUp = 266,
  kPageDown = 267,
  kHomeKey = 268,
  kF1 = 290,
  kF5 = 294,
  kF9 = 298,
  kF12 = 301,
};

// Where the mouse is in the window, and its buttons: left, right, middle.
struct Pointer {
  double x_px = 0.0, y_px = 0.0;
  std::array<bool, 3> down{};
};

// What the keyboard did since the last frame. A key that went down and up again in between counts as well: a slow
// frame loses no press.
class Keys {
 public:
  bool pressed(int key) const noexcept;  // went down; while a text is typed, F keys only
  bool held(int key) const noexcept;     // is down, or was
  bool alt_enter() const noexcept;       // Enter with Alt, which is the window's and no screen's
  bool shift = false, control = false, alt = false;

 private:
  friend class Window;
  std::vector<int> pressed_, down_;
  bool typing_ = false;
};

// In less the screens' columns do not fit beside each other.
inline constexpr int kLeastWidth = 800, kLeastHeight = 600;

class Window {
 public:
  struct Settings {
    std::string title;
    int width = 1280, height = 800;  // kLeastWidth and kLeastHeight at least
    bool whole_screen = false;
    double letters = 1.0;  // their size, times what screen and window make of it
  };
  // Throws base::Failure("display") where there is none, or ("gl") where it has no GL 4.3.
  explicit Window(const Settings& settings);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  gpu::Context& context() noexcept;
  bool open() const noexcept;  // until it is closed, by its user or by close
  void close() noexcept;
  bool hidden() const noexcept;   // nobody sees it: it is an icon
  double scale() const noexcept;  // of letters and distances: 1 on a screen of 96 dots an inch, at 1280 × 800
  // Without a frame, or as it was before.
  bool whole_screen() const noexcept;
  void set_whole_screen(bool whole);
  WindowSize size() const noexcept;

  // Between these two what is in the window is said to Dear ImGui. `walks`: keys go from item to item
  // (key_focus.h).
  void begin_frame(bool walks = false);
  void end_frame();
  const Keys& keys() const noexcept;  // of this frame
  // Since the window opened; nothing while what was typed waits for a later frame.
  std::optional<int> keys_heard() const noexcept;
  // Draws what was said, and is back when that is on the screen, as far as a program can tell. `pixels`: what it
  // shows, red, green, blue, row by row from the upper left.
  void show(std::vector<unsigned char>* pixels = nullptr);
  // Between end_frame and the next begin_frame, as often as one likes: what came meanwhile, for hands, which are
  // not to wait for a frame. Keys are as they are now; what went down counts until the next frame, which has it
  // too.
  const Keys& poll();
  // As poll, where nobody's hands are read: back when anything came, or after so long. Whether something came.
  bool wait(double most_s);
  bool touched() const noexcept;  // a key or a button of the mouse is down
  Pointer pointer() const;
  // Notches since the frame, or the last call; those that are taken the next frame does not have.
  double take_wheel();
  // What was dropped on the window since the last call; empty: nothing was.
  std::string take_dropped();
  // The first that GLFW has a mapping for, as it is now; nothing: there is none.
  std::optional<devices::GamepadReading> gamepad() const;
  void set_title(const std::string& title);

  int width_px() const noexcept;  // of what is drawn on
  int height_px() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Whether there is a display to open one on: tries, and closes it again. Not while a Window is open.
bool display_opens();

}  // namespace seldinger::app

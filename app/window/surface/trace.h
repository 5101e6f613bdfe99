// What the workstation does, a line of JSON now and then, for whoever looks after it or tests it: which screen is
// up, how fast pictures come, and how long they lag behind the hands. Nothing of a person.
#pragma once

#include <filesystem>
#include <fstream>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/window/surface/panel_items.h"
#include "sim/base/result.h"
#include "sim/case/console.h"

namespace seldinger::app {

// What is in the case editor.
struct EditorTrace {
  std::string state, refusal;
  bool checking = false, entry = false;
  std::size_t lesions = 0, structures = 0;
  std::vector<std::string> failing, holding;  // checks
  std::optional<std::size_t> rehearsed, met;  // attempts of "Can it be passed?", and how many of them passed
  glm::dvec3 cursor_lps_mm{0.0};
  double mm_per_pixel = 0.0;
  // Of a CT that is prepared anew, once it is: "skin_hu -250", triangles, the farthest from the full surface.
  std::optional<std::string> prepared;
  std::size_t triangles = 0;
  double most_mm = 0.0;
};

// Since the line before.
struct TraceLine {
  double t_s = 0.0;  // since the window opened
  // "log_in", "choose", "briefing", "ready", "attempt", "storing", "debrief", "answer", "watch", "editor",
  // "devices"
  std::string screen;
  int frames = 0;                                                                  // since the window opened
  double frames_s = 0.0;                                                           // the window's
  double pictures_s = 0.0;                                                         // the guidance's
  std::string method;                                                              // how these are made
  double hand_to_force_ms = 0.0, hand_to_room_ms = 0.0, hand_to_picture_ms = 0.0;  // the longest
  std::string held;  // "needle" or "probe"; outside an attempt empty, as the rest
  double inserted_mm = 0.0, press_mm = 0.0, attempt_s = 0.0;
  bool fired = false;
  std::optional<double> watched_s{};                 // where in an attempt that is watched
  cases::ConsoleSetting console{};                   // of the picture that is shown
  double gain_db = 0.0;                              // of the knob
  glm::dvec3 needle_lps_mm{0.0}, probe_lps_mm{0.0};  // tip, middle of the face
  double heap_mib = 0.0;                             // what the program holds; told outside attempts only
  std::vector<std::string> sounds;                   // that began, heard or not
  std::optional<EditorTrace> editor{};
  std::vector<std::string> arms;    // left, right: "ok", "at_limit", "late", "lost"; empty: none are used
  std::string asks;                 // what the device page asks its user for
  int keys = 0;                     // pressed since the window opened, of which the screen shows what they did
  std::string focus;                // the item that the keyboard is on; empty: one without a name, or none
  int width_px = 0, height_px = 0;  // the window's
  std::vector<ShownItem> items;     // what can be pressed
};

std::string json_of(const TraceLine& line);

class Trace {
 public:
  // Without a path nothing is written. Throws base::Failure("disk") when the file cannot be.
  explicit Trace(const std::filesystem::path& path);
  void write(const TraceLine& line);
  bool wanted() const { return file_.is_open(); }

 private:
  std::ofstream file_;
};

}  // namespace seldinger::app

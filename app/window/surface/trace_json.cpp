#include <nlohmann/json.hpp>

#include "app/window/surface/trace.h"
#include "sim/base/failure.h"

namespace seldinger::app {

std::string json_of(const TraceLine& line) {
  nlohmann::ordered_json json = {{"t_s", line.t_s},       {"screen", line.screen},
                                 {"frames", line.frames}, {"frames_s", line.frames_s},
                                 {"keys", line.keys},     {"window_px", {line.width_px, line.height_px}}};
  if (!line.held.empty())
    json.update({{"pictures_s", line.pictures_s},
                 {"method", line.method},
                 {"hand_to_force_ms", line.hand_to_force_ms},
                 {"hand_to_room_ms", line.hand_to_room_ms},
                 {"hand_to_picture_ms", line.hand_to_picture_ms},
                 {"held", line.held},
                 {"inserted_mm", line.inserted_mm},
                 {"press_mm", line.press_mm},
                 {"attempt_s", line.attempt_s},
                 {"fired", line.fired},
                 {"depth_mm", line.console.depth_mm},
                 {"focus_mm", line.console.focus_mm},
                 {"frequency_mhz", line.console.frequency_mhz},
                 {"slice_mm", line.console.slice_mm},
                 {"colour_mm_s", line.console.colour_mm_s},
                 {"compound_deg", line.console.compound_deg},
                 {"lean_deg", line.console.lean_deg},
                 {"box_across", line.console.box_across},
                 {"box_down", line.console.box_down},
                 {"gain_db", line.gain_db},
                 {"needle_lps_mm", {line.needle_lps_mm.x, line.needle_lps_mm.y, line.needle_lps_mm.z}},
                 {"probe_lps_mm", {line.probe_lps_mm.x, line.probe_lps_mm.y, line.probe_lps_mm.z}}});
  if (line.watched_s) json["watched_s"] = *line.watched_s;
  if (line.heap_mib > 0.0) json["heap_mib"] = line.heap_mib;
  if (!line.sounds.empty()) json["sounds"] = line.sounds;
  if (line.editor) {
    const EditorTrace& editor = *line.editor;
    json["editor"] = {{"state", editor.state},
                      {"refusal", editor.refusal},
                      {"checking", editor.checking},
                      {"entry", editor.entry},
                      {"lesions", editor.lesions},
                      {"structures", editor.structures},
                      {"failing", editor.failing},
                      {"holding", editor.holding},
                      {"cursor_lps_mm", {editor.cursor_lps_mm.x, editor.cursor_lps_mm.y, editor.cursor_lps_mm.z}},
                      {"mm_per_pixel", editor.mm_per_pixel}};
  }
  if (line.editor && line.editor->rehearsed) {
    json["editor"]["rehearsed"] = *line.editor->rehearsed;
    json["editor"]["met"] = line.editor->met.value_or(0);
  }
  if (line.editor && line.editor->prepared)
    json["editor"]["prepared"] = {{"settings", *line.editor->prepared},
                                  {"triangles", line.editor->triangles},
                                  {"most_mm", line.editor->most_mm}};
  if (!line.arms.empty()) json["arms"] = line.arms;
  if (!line.asks.empty()) json["asks"] = line.asks;
  if (!line.focus.empty()) json["focus"] = line.focus;
  for (const ShownItem& item : line.items)
    json["items"][item.name] = {item.x_px, item.y_px, item.width_px, item.height_px};
  return json.dump();
}

Trace::Trace(const std::filesystem::path& path) {
  if (path.empty()) return;
  file_.open(path, std::ios::binary | std::ios::trunc);
  if (!file_) throw base::Failure("disk", "the trace cannot be written");
}

void Trace::write(const TraceLine& line) {
  if (file_.is_open()) file_ << json_of(line) << std::endl;
}

}  // namespace seldinger::app

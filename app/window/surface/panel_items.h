// What can be pressed or looked for in the window's frame, by name and place: the trace tells of it, so that
// whoever works the window by mouse, as its tests do, finds a button by its name wherever the layout has put it.
#pragma once

#include <string>
#include <vector>

namespace seldinger::app {

struct ShownItem {
  std::string name;  // the second of a name in a frame is "name#2", and so on
  double x_px = 0.0, y_px = 0.0, width_px = 0.0, height_px = 0.0;  // of the window, from its upper left
};

// Nothing is noted, at the cost of one comparison, until this has been called with true.
void note_items(bool wanted);
void forget_items();  // before each frame
// After an item of Dear ImGui: nothing where it is disabled or cannot be seen. Text after "##" is no name.
void note_item(const char* name);
// A part of the last item, in Dear ImGui's coordinates: where in it something stands.
void note_part(const char* name, float left, float top, float width, float height);
// What stands in the window without being an item.
void note_place(const char* name, float left, float top, float width, float height);
// The frame's, in the order in which they were drawn.
const std::vector<ShownItem>& noted_items();

// A button that is noted by its label.
bool noted_button(const char* label, float width = 0.0F);

}  // namespace seldinger::app

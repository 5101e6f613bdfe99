// The keyboard's way through a screen: Tab and Shift+Tab go from item to item in the order in which they are drawn,
// arrows to the nearest one, Enter or Space presses what is framed. In the room keys are hands, and none of this
// is.
#pragma once

#include <string>

namespace seldinger::app {

// Before Dear ImGui's frame: whether keys walk in it, and what was pressed for it. True: the framed item took Enter
// or Space; nobody else is to hear of it.
bool walk_by_keys(bool walks, bool tab, bool press, bool by_mouse);
// Once Dear ImGui's frame has begun: 1.86 goes on with Tab from a field that is typed into only, from what is
// framed it would begin anew. `back`: Shift was down when Tab was pressed, however short.
void go_on_from_focus(bool back);
// Whether a frame stands around what has the focus.
bool walking();

// Around the items of a screen.
void begin_way();
void end_way();
void header_row();  // of a table: nothing to stop at
// The keyboard goes on from the item just drawn, where keys walk.
void focus_here();
// Of the item just drawn: whether it is framed. A picture that is keeps arrows, Enter and Space for itself.
bool framed();
bool keep_keys();
// What the keyboard is on, as its item was noted (panel_items.h); empty: on nothing that has a name.
void note_focus(const std::string& name);
const std::string& focus();

}  // namespace seldinger::app

// The JSON documents that `render` answers.
#pragma once

#include <string>

#include "app/pictures/scene_picture.h"

namespace seldinger::app {

std::string json_of_room(const ColourPicture& picture);
std::string json_of_picture(const ScenePicture& picture, double min, double max);

}  // namespace seldinger::app

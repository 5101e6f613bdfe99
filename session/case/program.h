// What attempts take from the program that makes them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "session/guidance/grey_picture.h"

namespace seldinger::session {

struct Program {
  std::string version;  // stored with each attempt
  // A picture as a file to be stored; none of a picture without pixels.
  std::vector<std::byte> (*file_of)(const GreyPicture& picture);
};

}  // namespace seldinger::session

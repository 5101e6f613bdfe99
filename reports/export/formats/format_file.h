// A file of another program's format, in the export's folder.
#pragma once

#include <string>

namespace seldinger::reports {

struct FormatFile {
  std::string name;  // below the export's folder
  std::string content;
};

}  // namespace seldinger::reports

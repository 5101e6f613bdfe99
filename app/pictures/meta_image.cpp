#include "app/pictures/meta_image.h"

#include <glm/geometric.hpp>
#include <locale>
#include <sstream>

namespace seldinger::app {

std::string meta_image(const std::vector<float>& picture, const PicturePlane& plane) {
  std::ostringstream header;
  header.imbue(std::locale::classic());
  header.precision(17);
  const auto write = [&header](const glm::dvec3& v) { header << ' ' << v.x << ' ' << v.y << ' ' << v.z; };
  const glm::dvec3 first = plane.center_lps_mm - plane.u * (plane.pixel_mm * (plane.width_px - 1) / 2) -
                           plane.v * (plane.pixel_mm * (plane.height_px - 1) / 2);
  header << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = "
            "False\n"
         << "TransformMatrix =";
  write(plane.u);
  write(plane.v);
  write(glm::cross(plane.u, plane.v));
  header << "\nOffset =";
  write(first);
  header << "\nElementSpacing = " << plane.pixel_mm << ' ' << plane.pixel_mm << " 1\nDimSize = " << plane.width_px
         << ' ' << plane.height_px << " 1\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n";
  std::string file = header.str();
  file.append(reinterpret_cast<const char*>(picture.data()), picture.size() * sizeof(float));
  return file;
}

}  // namespace seldinger::app

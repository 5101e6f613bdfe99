#include "app/meta_image.h"

#include <glm/geometric.hpp>
#include <locale>
#include <sstream>

namespace seldinger::app {

std::string meta_image(const imaging::HuImage& picture, const imaging::MprView& view) {
  std::ostringstream header;
  header.imbue(std::locale::classic());
  header.precision(17);
  const auto write = [&header](const glm::dvec3& v) { header << ' ' << v.x << ' ' << v.y << ' ' << v.z; };
  const glm::dvec3 first = view.center_lps_mm - view.u * (view.pixel_mm * (view.width_px - 1) / 2) -
                           view.v * (view.pixel_mm * (view.height_px - 1) / 2);
  header << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = "
            "False\n"
         << "TransformMatrix =";
  write(view.u);
  write(view.v);
  write(glm::cross(view.u, view.v));
  header << "\nOffset =";
  write(first);
  header << "\nElementSpacing = " << view.pixel_mm << ' ' << view.pixel_mm << " 1\nDimSize = " << view.width_px
         << ' ' << view.height_px << " 1\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n";
  std::string file = header.str();
  file.append(reinterpret_cast<const char*>(picture.data()), picture.size() * sizeof(float));
  return file;
}

}  // namespace seldinger::app

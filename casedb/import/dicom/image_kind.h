// What kind of picture a CT file says it is: a slice of HU, something computed from several, or no slice at all.
#pragma once

#include <string>

namespace seldinger::casedb {

struct DicomFile;

// projection: also maps of flow and such. material: a map of one (iodine), of atomic number or electron density.
// virtual_hu: HU of another energy, or with a material taken out. described: only the series' description says so,
// which anybody may have typed.
enum class ImageKind { slice, projection, material, virtual_hu, described };

// By image and frame type, volume based calculation and the words of the series' description.
ImageKind image_kind_of(const DicomFile& header);

// A frame's own type stands above the file's.
std::string image_type_of(const DicomFile& header);

}  // namespace seldinger::casedb

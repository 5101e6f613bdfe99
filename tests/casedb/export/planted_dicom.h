// DICOM files full of identifiers, written from nothing but PS3.5 and PS3.10: every element of the
// de-identification table at the top and three sequences deep, private blocks, overlays and curves. Each identifier
// is another text, so that it can be searched for.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace seldinger::casedb {

struct PlantedElement {
  std::uint32_t tag = 0;
  std::string vr, value;                             // bytes, little endian
  std::vector<std::vector<PlantedElement>> items{};  // of SQ
};
using PlantedSet = std::vector<PlantedElement>;

enum class PlantedSyntax { implicit_le, explicit_le, explicit_be, deflated, rle, j2k };
constexpr std::array<PlantedSyntax, 6> kPlantedSyntaxes = {PlantedSyntax::implicit_le, PlantedSyntax::explicit_le,
                                                           PlantedSyntax::explicit_be, PlantedSyntax::deflated,
                                                           PlantedSyntax::rle,         PlantedSyntax::j2k};

struct Planted {
  PlantedSet elements;
  std::vector<std::string> identifiers;  // all different, none part of what a clean file holds
};

// Of one slice of a series: `slice` changes place, instance UID and pixels, all else is the same.
Planted planted_slice(int slice, PlantedSyntax syntax);

std::string planted_bytes(const PlantedSet& elements, PlantedSyntax syntax);
std::string pixels_of(const PlantedSet& elements);  // as they stand in the file (big endian: swapped)

// One value of a VR, with an identifier in it where the VR can hold one; `identifier` becomes what to search for.
std::string planted_value(const std::string& vr, int number, std::string& identifier);

// A three-slice series into a folder; file and folder names hold identifiers as well. Returns all of them.
std::vector<std::string> plant_series(const std::filesystem::path& folder, PlantedSyntax syntax);

// Which of the identifiers occur in the bytes, ASCII upper and lower case alike and as UTF-16.
std::vector<std::string> survivors(const std::string& bytes, const std::vector<std::string>& identifiers);

}  // namespace seldinger::casedb

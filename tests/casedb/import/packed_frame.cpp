#include "tests/casedb/import/packed_frame.h"

#include <gdcmImage.h>
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmSequenceOfFragments.h>
#include <gtest/gtest.h>

namespace seldinger::casedb {

std::string packed_frame(const std::string& syntax_uid, glm::ivec2 size, const std::vector<int>& stored) {
  std::string native;
  for (const int value : stored) {
    native.push_back(static_cast<char>(value & 0xFF));
    native.push_back(static_cast<char>(value >> 8 & 0xFF));
  }
  gdcm::SmartPointer<gdcm::Image> image = new gdcm::Image;
  image->SetNumberOfDimensions(2);
  image->SetDimension(0, static_cast<unsigned>(size.x));
  image->SetDimension(1, static_cast<unsigned>(size.y));
  image->SetPixelFormat(gdcm::PixelFormat(1, 16, 16, 15, 1));
  image->SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image->SetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
  pixels.SetByteValue(native.data(), gdcm::VL(static_cast<std::uint32_t>(native.size())));
  image->SetDataElement(pixels);
  gdcm::ImageChangeTransferSyntax change;
  change.SetTransferSyntax(gdcm::TransferSyntax(gdcm::TransferSyntax::GetTSType(syntax_uid.c_str())));
  change.SetInput(*image);
  if (!change.Change()) {
    ADD_FAILURE() << "cannot be packed as " << syntax_uid;
    return {};
  }
  const gdcm::DataElement& packed = change.GetOutput().GetDataElement();
  const gdcm::SequenceOfFragments* fragments = packed.GetSequenceOfFragments();
  if (fragments == nullptr) {
    ADD_FAILURE() << "no fragments";
    return {};
  }
  std::string all(fragments->ComputeByteLength(), '\0');
  fragments->GetBuffer(all.data(), all.size());
  if (all.size() % 2 != 0) all.push_back('\0');
  return all;
}

}  // namespace seldinger::casedb

// The bits of a pixel's cell that are not the pixel's (PS3.5 §8.1.1): scanners have kept overlays there, with text.
#pragma once

#include "casedb/export/dicom_tree.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

// Clears them in every picture of the data set, icons too; above a signed pixel its sign goes on, as one who reads
// the whole cell expects, and a cell that is the padding value, or lies in the range of padding that the file
// declares, stays: bits within such a range are handed on. What the pixels are does not change. How many pictures
// held such bits. Refused: `hidden_bits` (a packed picture that holds or may hold some: changing it would mean
// packing it anew).
base::Result<int> clear_hidden_bits(DicomDataSet& data_set, DicomFormat format);

}  // namespace seldinger::casedb

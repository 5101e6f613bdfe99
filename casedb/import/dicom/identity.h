// Whether the slices of a series are of one patient and one study. Names and numbers are compared and never told:
// what is kept of each is a hash, which does not leave the process that reads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "casedb/import/files/problems.h"

namespace seldinger::casedb {

struct DicomFile;
struct DicomSlice;

// Patient ID, name, birth date, sex and study, in the order of identity.cpp's table; 0 where the file says nothing.
struct SliceIdentity {
  std::array<std::uint64_t, 5> marks{};
};

// Of names, case, empty components at the end and runs of blanks do not count (PS3.5 §6.2.1).
SliceIdentity identity_of(const DicomFile& header);

// Refuses (`mixed_patients`, `mixed_studies`) slices that differ in one of them, also where only some say it:
// nobody knows whether those are the same person's. Texts tell what differs and where along the stack the slices
// lie.
void judge_identity(const std::vector<DicomSlice>& slices, Problems& problems);

}  // namespace seldinger::casedb

// Reads mutated files again and again: none may crash, talk, hang, throw, or hold more memory than
// twice what it announced and 64 MiB. What crashes does so in a jail, and is told.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace seldinger::casedb {

enum class FuzzedReader { dicom, nifti, nrrd, metaimage };
constexpr FuzzedReader kFuzzedReaders[] = {FuzzedReader::dicom, FuzzedReader::nifti, FuzzedReader::nrrd,
                                           FuzzedReader::metaimage};

// `folder` is written into. The same `seed` gives the same files. Fails the test where something is wrong, leaving
// the file that did it as "failed" in the folder.
void fuzz_import(const std::filesystem::path& folder, FuzzedReader reader, std::uint64_t seed, int rounds);

// Small DICOM files of every kind.
std::vector<std::string> dicom_seeds();

}  // namespace seldinger::casedb

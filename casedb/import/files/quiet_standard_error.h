// While it lives, what libraries print to standard error (libjpeg within GDCM, VNL within ITK) goes nowhere: the
// command line promises exactly one line there, and theirs may show what a file holds. Also other threads' lines
// are lost meanwhile; so it stands around single calls.
#pragma once

namespace seldinger::casedb {

class QuietStandardError {
 public:
  QuietStandardError();
  ~QuietStandardError();
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;

 private:
  int saved_ = -1;
};

}  // namespace seldinger::casedb

// A film, by the ffmpeg of the machine: frames go to it through a pipe, no shell is asked.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <span>

namespace seldinger::app {

class VideoFile {
 public:
  // An MP4 (H.264) of frames of this size, both even. Throws base::Failure("ffmpeg") when the machine has none, and
  // when it fails later; base::Failure("disk") when the file cannot take its name.
  VideoFile(const std::filesystem::path& file, int width_px, int height_px, double rate_hz);
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;
  ~VideoFile();  // nothing stays behind unless it was kept

  void add(std::span<const unsigned char> rgb);  // row-major, three bytes a pixel
  void keep();                                   // waits for ffmpeg and gives the file its name

 private:
  void wait_for_end();
  std::filesystem::path file_, unfinished_;
  pid_t child_ = -1;
  int pipe_ = -1;
  int status_ = -1;
};

}  // namespace seldinger::app

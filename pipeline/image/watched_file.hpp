// A file that remembers whether it ended before everything asked of it was there: GDCM goes on with zeros then.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <fstream>
#include <istream>

namespace palpate {

class WatchedFile : private std::filebuf {
 public:
  explicit WatchedFile(const std::filesystem::path& path) : stream_(this) { open(path, std::ios::in | std::ios::binary); }
  std::istream& stream() { return stream_; }
  bool ended_early() const { return ended_early_; }

 private:
  /// Reads of a few bytes at the end are a reader's way to find it (a tag and its length are 8 bytes).
  std::streamsize xsgetn(char* to, std::streamsize count) override {
    const std::streamsize got = std::filebuf::xsgetn(to, count);
    if (got < count && count > 8) ended_early_ = true;
    return got;
  }

  bool ended_early_ = false;
  std::istream stream_;
};

}  // namespace palpate

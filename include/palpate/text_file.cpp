// Text files, read and written whole.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/text_file.hpp>

#include <fstream>
#include <sstream>

#include <palpate/errors.hpp>

namespace palpate {

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw Failure(ExitCode::unreadable, "cannot read the file", path.string(), "check the name and the permissions");
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) throw Failure(ExitCode::unreadable, "cannot read the file", path.string(), "check the disk");
  return text.str();
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file)
    throw Failure(ExitCode::unreadable, "cannot write the file", path.string(), "check free space (df -h) and permissions");
}

}  // namespace palpate

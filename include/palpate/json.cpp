// JSON files, read and written whole.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/json.hpp>
#include <palpate/text_file.hpp>
#include <palpate/errors.hpp>

namespace palpate {

Json read_json(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw Failure(ExitCode::unreadable, std::string("not valid JSON: ") + error.what(), path.string());
  }
}

void write_json(const std::filesystem::path& path, const Json& value) {
  write_text(path, value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace palpate

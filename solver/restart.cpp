// Layout: a first line, the SHA-256 of all that follows, one line of JSON (whose run; hashes of the files beside), the bytes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/restart.hpp>

#include <algorithm>

#include <palpate/text_file.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

const std::string first_line = "palpate-restart/1\n";
constexpr std::size_t hash_size = 64;
constexpr int part_of_the_run = 20;

bool are_there(const fs::path& folder, const Json& files) {
  for (const auto& [name, hash] : files.items())
    if (!fs::is_regular_file(folder / name) || sha256(folder / name) != hash.get<std::string>()) return false;
  return true;
}

void make_empty(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
}

}  // namespace

Restart::Restart(Command& c, fs::path folder) : command_(c), folder_(std::move(folder)), path_(folder_ / "restart.bin"), identity_(c.identity().dump()) {}

std::optional<std::string> Restart::read() {
  const auto start_again = [&](const std::string& why) -> std::optional<std::string> {
    if (!why.empty()) command_.say(why + ": starts from the beginning");
    make_empty(folder_);
    return {};
  };
  if (!fs::exists(path_)) return start_again("");
  const std::string text = read_text(path_);
  const std::size_t json_at = first_line.size() + hash_size + 1, json_end = text.find('\n', std::min(json_at, text.size()));
  if (!text.starts_with(first_line) || json_end == std::string::npos ||
      sha256_of_bytes(std::string_view(text).substr(json_at)) != std::string_view(text).substr(first_line.size(), hash_size))
    return start_again("what a killed run left is damaged");
  const Json head = Json::parse(text.substr(json_at, json_end - json_at));
  if (head.at("run").dump() != identity_) return start_again("a killed run left its work, but of another case, mesh, option, program or number of threads");
  if (!are_there(folder_, head.at("files"))) return start_again("what a killed run left is damaged: its frames are not as they were");
  for (const auto& [name, hash] : head.at("files").items()) hashes_[name] = hash.get<std::string>();
  return text.substr(json_end + 1);
}

void Restart::write(const std::function<std::string()>& bytes, const std::vector<std::string>& files) {
  const auto start = std::chrono::steady_clock::now();
  const bool new_file = std::any_of(files.begin(), files.end(), [&](const std::string& name) { return !hashes_.contains(name); });
  if (!possible_ || (start < next_ && !new_file)) return;
  const fs::path temporary = folder_ / "restart.new";
  try {
    for (const auto& name : files)
      if (!hashes_.contains(name)) hashes_[name] = sha256(folder_ / name);
    const std::string head = Json({{"run", Json::parse(identity_)}, {"files", hashes_}}).dump() + "\n", kept = bytes();
    const std::size_t json_at = first_line.size() + hash_size + 1;
    std::string text;
    text.reserve(json_at + head.size() + kept.size());
    text.append(first_line).append(hash_size, ' ').append("\n").append(head).append(kept);
    text.replace(first_line.size(), hash_size, sha256_of_bytes(std::string_view(text).substr(json_at)));
    write_text(temporary, text);
    fs::rename(temporary, path_);
  } catch (const Failure& failure) {
    possible_ = false;
    fs::remove(temporary);
    remove();
    command_.say("no restart of this run, should it be killed: " + std::string(failure.what()));
  }
  next_ = std::chrono::steady_clock::now() + part_of_the_run * (std::chrono::steady_clock::now() - start);
}

void Restart::remove() { fs::remove(path_); }

}  // namespace palpate

// A number moved, and the case read once more.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/moved_case.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <palpate/errors.hpp>
#include <solver/implicit/assembly.hpp>

namespace palpate {
namespace {

/// Small against what bends the curves (a contact's deepest gap is a hundredth of an element), large against rounding: of a length in
/// mm, of any other number in parts of itself.
double small_change(const std::string& path, double value) {
  constexpr double part = 1e-7;
  const bool length = path.find("_mm") != std::string::npos;
  return length || value == 0 ? part : part * std::abs(value);
}

/// Where nothing moves, any friction sticks; the secant to this coefficient stands in for its derivative.
constexpr double finite_friction = 0.05;

/// Surfaces that rub: tools, and ways of looking between organs.
long rubbing(const implicit::Model& model) {
  return std::count_if(model.tools.begin(), model.tools.end(), [](const auto& tool) { return tool.holds_on(); }) +
         std::count_if(model.passes.begin(), model.passes.end(), [](const auto& pass) { return pass.friction > 0; });
}

bool needs_secant(const Case& still, const Case& moved) { return rubbing(moved.model) > rubbing(still.model); }

Case shifted_case(const Settings& settings, const std::filesystem::path& mesh, const std::string& path, double change) {
  Settings moved = Settings::read(settings.file());
  moved.shift(path, change);
  return read_case(moved, mesh);
}

bool is_refused(const Settings& settings, const std::filesystem::path& mesh, const std::string& path, double change) {
  try {
    shifted_case(settings, mesh, path, change);
  } catch (const Failure&) {
    return true;
  }
  return false;
}

}  // namespace

MovedCase moved_case(const Settings& settings, const std::filesystem::path& mesh, const std::string& path, const Case& still) {
  const double step = small_change(path, settings.number_at(path));
  for (double change : {step, -step}) {
    try {
      Case moved = shifted_case(settings, mesh, path, change);
      if (needs_secant(still, moved)) return {finite_friction, shifted_case(settings, mesh, path, finite_friction), true, true};
      const bool off = change > 0 && settings.number_at(path) == 0;  // an amplitude, most likely
      return {change, std::move(moved), change < 0 || (off && is_refused(settings, mesh, path, -step)), false};
    } catch (const Failure&) {
      if (change < 0) throw;
    }
  }
  throw std::logic_error("unreachable");
}

std::vector<std::string> number_paths(const std::string& list) {
  std::vector<std::string> paths;
  std::istringstream in(list);
  for (std::string path; std::getline(in, path, ',');) {
    std::erase(path, ' ');
    if (!path.empty()) paths.push_back(path);
  }
  return paths;
}

}  // namespace palpate

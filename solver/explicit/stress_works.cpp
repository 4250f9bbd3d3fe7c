// Stresses and strains of each moment, and their products.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/stress_works.hpp>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace palpate::explicit_shell {

using elements::layers;

void StressWorks::look(const Wall& wall, const WallState& state, double travel) {
  if (count_ == 0 || travel < (travel_.empty() ? 0 : travel_.back()) + 0.9 * farthest_ / count_) return;
  travel_.push_back(travel);
  auto& stress = stress_.emplace_back();
  auto& strain = strain_.emplace_back();
  std::visit([&](const auto& law) {
    for (int t = 0; t < static_cast<int>(wall.triangles.size()); ++t) {
      const auto rest = lane(wall.packs[t / 4].rest, t % 4);
      const auto s = elements::shell_strain(rest, now(wall, state, t));
      for (int i = 0; i < layers; ++i) {
        const auto C = elements::at_layer(s, 0.5 * elements::layer_place[i] * rest.thickness);
        const auto S = law(C).S;
        const double volume = 0.5 * elements::layer_weight[i] * rest.thickness * rest.area;
        for (double v : {S.xx * volume, S.yy * volume, 2 * S.xy * volume}) stress.push_back(static_cast<float>(v));
        for (double v : {C.xx, C.yy, C.xy}) strain.push_back(static_cast<float>(v));
      }
    }
  }, wall.law);
}

std::string StressWorks::csv() const {
  std::ostringstream out;
  out << std::setprecision(9) << "depth[mm]";
  for (int k = 0; k < moments(); ++k) out << ",F" << k << "[N]";
  out << "\n";
  for (int j = 0; j < moments(); ++j) {
    const int before = std::max(j - 1, 0), after = std::min(j + 1, moments() - 1);
    out << travel_[j];
    for (int k = 0; k < moments(); ++k) {
      double work = 0;
      for (std::size_t i = 0; i < stress_[k].size(); ++i) work += 0.5 * static_cast<double>(stress_[k][i]) * (static_cast<double>(strain_[after][i]) - strain_[before][i]);
      out << "," << (after > before ? work / (travel_[after] - travel_[before]) : 0);
    }
    out << "\n";
  }
  return out.str();
}

}  // namespace palpate::explicit_shell

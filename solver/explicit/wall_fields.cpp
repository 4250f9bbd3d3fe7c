// Principal Kirchhoff stresses are the eigenvalues of S C: τ1² − τ1 τ2 + τ2² = tr² − 3 det.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/wall_fields.hpp>

#include <algorithm>
#include <numeric>

namespace palpate::explicit_shell {

std::vector<TriangleState> triangle_states(const Wall& wall, const WallState& state, const TissueForces* tissue) {
  std::vector<TriangleState> all(wall.triangles.size());
  std::visit([&](const auto& law) {
    for (int t = 0; t < wall.triangles.size(); ++t) {
      const auto rest = lane(wall.packs[t / 4].rest, t % 4);
      const auto strain = elements::shell_strain(rest, now(wall, state, t));
      TriangleState& out = all[t];
      for (int i = 0; i < elements::layers; ++i) {
        const auto C = elements::at_layer(strain, 0.5 * elements::layer_place[i] * rest.thickness);
        auto p = law(C);
        if (tissue) {
          const auto more = tissue->correction(t, i, C);
          p.S = {p.S.xx + more.xx, p.S.yy + more.yy, p.S.xy + more.xy};
        }
        const double J = p.thickness * std::sqrt(C.xx * C.yy - C.xy * C.xy);
        const double trace = p.S.xx * C.xx + p.S.yy * C.yy + 2 * p.S.xy * C.xy;
        const double det = (p.S.xx * p.S.yy - p.S.xy * p.S.xy) * (C.xx * C.yy - C.xy * C.xy);
        out.von_mises = std::max(out.von_mises, std::sqrt(std::max(trace * trace - 3 * det, 0.0)) / J);
        const double m = (C.xx + C.yy) / 2, r = std::hypot((C.xx - C.yy) / 2, C.xy);
        out.strain = std::max(out.strain, 0.5 * std::log(m + r));
        out.thickness += 0.5 * elements::layer_weight[i] * rest.thickness * p.thickness;
      }
    }
  }, wall.law);
  return all;
}

double area_quantile(const Wall& wall, const std::vector<TriangleState>& states, double TriangleState::*value, double q) {
  std::vector<int> order(states.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return states[a].*value < states[b].*value; });
  const auto area = [&](int t) { return wall.packs[t / 4].rest.area[t % 4]; };
  double total = 0, below = 0;
  for (int t : order) total += area(t);
  for (int t : order)
    if ((below += area(t)) >= q * total) return states[t].*value;
  return states[order.back()].*value;
}

}  // namespace palpate::explicit_shell

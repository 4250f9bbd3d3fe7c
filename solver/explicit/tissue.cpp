// Corrections point by point, one after the other: slower than the law's own loop, and only where a case asks for it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/tissue.hpp>

#include <solver/elements/turgor.hpp>

namespace palpate::explicit_shell {
namespace {

using elements::layers;
using materials::InPlane;
using materials::Mat3;

/// The wall's law as an effect sees it: P = F S of three dimensions, S = S_plane − ⅓ (S_plane : C) C⁻¹ without the pressure, det F = 1, F
/// without shear through the thickness. No tangent: nobody asks for it here.
materials::Response lifted(const ShellLaw& law, const Mat3& F, double modulus) {
  const Mat3 C = F.transpose() * F;
  materials::Response r;
  std::visit([&](const auto& plane) {
    const auto p = plane(InPlane<double>{C(0, 0), C(1, 1), C(0, 1)});
    const double D = C(0, 0) * C(1, 1) - C(0, 1) * C(0, 1), third = (p.S.xx * C(0, 0) + p.S.yy * C(1, 1) + 2 * p.S.xy * C(0, 1)) / 3;
    Mat3 S = Mat3::Zero();
    S(0, 0) = p.S.xx - third * C(1, 1) / D, S(1, 1) = p.S.yy - third * C(0, 0) / D, S(2, 2) = -third * D;
    S(0, 1) = S(1, 0) = p.S.xy + third * C(0, 1) / D;
    r.W = modulus * p.W;
    r.P = modulus * (F * S);
  }, law);
  return r;
}

/// The law with its first `count` effects, at a point.
struct Chain {
  const ShellLaw& law;
  const elements::Material& material;
  const effects::Point& point;
  double* memory;
  int count;

  std::span<double> memory_of(int i) const { return {memory + material.effects[i].memory_at, static_cast<std::size_t>(material.effects[i].memory)}; }
  materials::Response operator()(const Mat3& F) const {
    if (count == 0) return lifted(law, F, point.modulus);
    const auto& last = material.effects[count - 1];
    const Chain within{law, material, point, memory, count - 1};
    effects::Point here = point;
    here.F = F;
    return last.effect.stress.respond(within.inner(), here, memory_of(count - 1), last.parameters);
  }
  effects::Inner inner() const {
    return {this, [](const void* chain, const Mat3& F) { return (*static_cast<const Chain*>(chain))(F); }};
  }
  /// From the outside in: an effect sees the inner ones with their old memory.
  void remember() const {
    for (int i = count - 1; i >= 0; --i) {
      const Chain within{law, material, point, memory, i};
      material.effects[i].effect.stress.remember(within.inner(), point, memory_of(i), material.effects[i].parameters);
    }
  }
};

double at_layer_mm(const elements::ShellRest<double>& rest, int i) { return 0.5 * elements::layer_place[i] * rest.thickness; }

}  // namespace

Mat3 upper_root(const InPlane<double>& C) {
  const double a = std::sqrt(C.xx), b = C.xy / a, c = std::sqrt(C.yy - b * b);
  Mat3 F;
  F << a, b, 0, 0, c, 0, 0, 0, 1 / (a * c);
  return F;
}

InPlane<double> plane_stress(const Mat3& F, const Mat3& P) {
  const Mat3 S = F.triangularView<Eigen::Upper>().solve(P);
  const double D = F(0, 0) * F(0, 0) * F(1, 1) * F(1, 1);  // det C = 1/C33
  const Eigen::Matrix2d C = (F.transpose() * F).topLeftCorner<2, 2>();
  const double pull = S(2, 2) / (D * D);  // S33 C33 C⁻¹ = S33 C33² adj C
  return {S(0, 0) - pull * C(1, 1), S(1, 1) - pull * C(0, 0), 0.5 * (S(0, 1) + S(1, 0)) + pull * C(0, 1)};
}

std::vector<double> stiffening(const Tissue& tissue, const Wall& wall) {
  std::vector<double> factor(wall.triangles.size(), 1);
  const double mu = tissue.material.shear_modulus();
  for (std::size_t t = 0; t < factor.size(); ++t) {
    if (!tissue.starts.empty()) factor[t] = std::max(1.0, tissue.starts[t].modulus + tissue.starts[t].turgor / mu);
    for (const auto& layer : tissue.layers) {
      if (!layer.on[t]) continue;
      Eigen::Matrix<double, 3, 2> flat = Eigen::Matrix<double, 3, 2>::Identity();
      const double most = layer.active.effect.layer.respond(flat, layer.active.parameters).A.operatorNorm();
      factor[t] += most / (4 * mu * wall.packs[t / 4].rest.thickness[t % 4]) * (1 + 2 * std::abs(layer.place));  // on a face it bends too: ζ² is three times t²/12
    }
  }
  return factor;
}

TissueForces::TissueForces(const Tissue& tissue, const Wall& wall) : tissue_(tissue), wall_(wall) {
  memory_.assign(wall.triangles.size() * layers * tissue.material.memory(), 0);
  before_.assign(wall.triangles.size(), {});
  work_.assign(wall.triangles.size(), 0);
  for (std::size_t t = 0; t < before_.size(); ++t) before_[t] = {0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0};
}

InPlane<double> TissueForces::changed(int t, const InPlane<double>& C, double* memory, double time, double dt, bool remember) const {
  const elements::Material& material = tissue_.material;
  const effects::Start start = tissue_.starts.empty() ? effects::Start{} : tissue_.starts[t];
  if (material.effects.empty() && tissue_.starts.empty()) return {0, 0, 0};
  const effects::Point point{upper_root(C), time, dt, material.law.kinematics, start.modulus};
  const Chain chain{wall_.law, material, point, memory, static_cast<int>(material.effects.size())};
  materials::Response with = chain(point.F);
  if (start.turgor != 0) elements::add_turgor(with, point.F, start.turgor, material.law.kinematics, point.asked);
  if (remember) chain.remember();
  return plane_stress(point.F, with.P - lifted(wall_.law, point.F, 1).P);
}

InPlane<double> TissueForces::correction(int t, int layer, const InPlane<double>& C) const {
  const std::size_t size = tissue_.material.memory();
  std::vector<double> memory(memory_.begin() + (t * layers + layer) * size, memory_.begin() + (t * layers + layer + 1) * size);
  return changed(t, C, memory.data(), time_, 0, false);
}

elements::ShellStress<double> TissueForces::through_thickness(int t, const elements::ShellStrain<double>& s, double time, double dt) {
  const auto rest = lane(wall_.packs[t / 4].rest, t % 4);
  elements::LayerSum<double> sums;
  if (!tissue_.material.effects.empty() || !tissue_.starts.empty())
    for (int i = 0; i < layers; ++i) {
      const double zeta = at_layer_mm(rest, i);
      const auto S = changed(t, elements::at_layer(s, zeta), memory_.data() + (static_cast<std::size_t>(t) * layers + i) * tissue_.material.memory(), time, dt, true);
      add_layer(s, zeta, 0.5 * elements::layer_weight[i] * rest.thickness, S, sums);
    }
  for (const auto& layer : tissue_.layers) {
    if (!layer.on[t]) continue;
    const double zeta = layer.place * rest.thickness / 2;
    const Mat3 F = upper_root(elements::at_layer(s, zeta));
    const Eigen::Matrix2d N = layer.active.effect.layer.respond(F.leftCols<2>(), layer.active.parameters).N.topRows<2>();
    const Eigen::Matrix2d flat = F.topLeftCorner<2, 2>(), S = flat.triangularView<Eigen::Upper>().solve(N);
    add_layer(s, zeta, tension_rise, {S(0, 0), S(1, 1), 0.5 * (S(0, 1) + S(1, 0))}, sums);
  }
  add_last_term(s, sums.H, sums.r, sums.stress);
  return sums.stress;
}

void TissueForces::add(const WallState& state, double time, double dt, int from, int to, Slots& slots) {
  const int last = std::min(4 * to, static_cast<int>(wall_.triangles.size()));
  for (int t = 4 * from; t < last; ++t) {
    const auto rest = lane(wall_.packs[t / 4].rest, t % 4);
    const auto shape = now(wall_, state, t);
    const auto s = elements::shell_strain(rest, shape);
    const auto stress = through_thickness(t, s, time, dt);
    const auto more = elements::shell_forces(rest, shape, s, stress);
    for (int k = 0; k < 3; ++k) {
      slots.force[3 * t + k] += Lanes{more.force[k].x, more.force[k].y, more.force[k].z, 0};
      slots.moment[3 * t + k] += more.moment[k];
    }
    // ½ N : δa + ½ M : δK by the trapezoidal rule: xx and yy once, xy twice
    const std::array<double, 12> is{stress.N.xx, stress.N.yy, 2 * stress.N.xy, stress.M.xx, stress.M.yy, 2 * stress.M.xy, s.a.xx, s.a.yy, s.a.xy, s.K.xx, s.K.yy, s.K.xy};
    auto& was = before_[t];
    for (int k = 0; k < 6; ++k) work_[t] += rest.area * 0.25 * (is[k] + was[k]) * (is[6 + k] - was[6 + k]);
    was = is;
    slots.energy[t] += work_[t];
  }
  if (from == 0) time_ = time;
}

}  // namespace palpate::explicit_shell

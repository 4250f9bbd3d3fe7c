// What lies on, holds or carries a surface: a capsule stretched and blown up, a bed of springs that is pressed and slid on, a tool that clings.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numeric>

#include <solver/implicit/steps.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

const double mu = 0.0067;

struct Row {
  double time;
  Vector3d force;  ///< on the organ at what is prescribed on `top`, or of the first tool
};

bool at_top(const implicit::Model& model, int node) {
  double top = -1e9;
  for (const auto& x : model.points) top = std::max(top, x.z());
  return model.points[node].z() > top - 1e-9;
}

std::vector<Row> rows(const implicit::Model& model, const std::vector<double>& times, implicit::State* end = nullptr) {
  implicit::Equilibrium equilibrium(model, 1);
  auto state = implicit::rest_state(model);
  std::vector<Row> list;
  const double reached = run_steps(equilibrium, state, {times}, [&](const implicit::Step& step) {
    if (step.index == 0) return;
    Row row{step.state.time, Vector3d::Zero()};
    if (!model.tools.empty()) row.force = step.equations.contact.tools[0].force;
    else
      for (std::size_t i = 0; i < model.points.size(); ++i)
        if (at_top(model, i)) row.force += step.equations.residual.segment<3>(4 * i);
    list.push_back(row);
  });
  if (reached < times.back()) throw std::runtime_error(std::to_string(reached) + " s: " + equilibrium.trouble().cause);
  if (end) *end = state;
  return list;
}

/// Faces whose nodes all lie where `where` says.
std::vector<int> faces_where(const implicit::Model& model, const std::function<bool(const Vector3d&)>& where) {
  std::vector<int> faces;
  for (int f = 0; f < int(model.faces.size()); ++f)
    if (std::all_of(model.faces[f].begin(), model.faces[f].end(), [&](int node) { return where(model.points[node]); })) faces.push_back(f);
  return faces;
}

std::vector<double> even_times(double from, double to, int steps) {
  std::vector<double> times;
  for (int i = 0; i <= steps; ++i) times.push_back(from + (to - from) * i / steps);
  return times;
}

/// A bed of springs under the bottom, z = 0, of a block.
void support(implicit::Model& model, std::vector<double> parameters) {
  implicit::RegionForce bed{{effect_named("support"), std::move(parameters)}, {}};
  std::map<int, double> areas;
  for (int f : faces_where(model, [](const Vector3d& x) { return x.z() < 1e-9; })) {
    const auto& [a, b, c] = model.faces[f];
    for (int node : model.faces[f]) areas[node] += (model.points[b] - model.points[a]).cross(model.points[c] - model.points[a]).norm() / 6;
  }
  for (const auto& [node, area] : areas) bed.points.push_back({node, area, -Vector3d::UnitZ()});
  model.region_forces = {bed};
}

}  // namespace

/// In its plane stretched by l both ways: E h/3 (l − l⁻⁵) + T l per width, besides the block's own μ (l − l⁻⁵).
TEST(Capsule, StretchedBothWays) {
  const double E_h = 0.02, T = 0.003;
  for (double l : {1.1, 1.4}) {  // pressed together it wrinkles
    auto model = brick(uniform(0, 1, 2), uniform(0, 1, 2), uniform(0, 1, 2));
    model.materials = {material("neo_hookean", {mu})};
    model.layers = {{{effect_named("capsule"), {E_h, T}}, faces_where(model, [](const Vector3d& x) { return x.z() > 1 - 1e-9; })}};
    for (int c = 0; c < 3; ++c) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
    for (int c : {0, 1}) hold(model, c, [c](const Vector3d& x) { return x(c) > 1 - 1e-9; }, l - 1);
    implicit::Equilibrium equilibrium(model, 1);
    auto state = implicit::rest_state(model);
    std::optional<implicit::Found> found;
    for (double t : {0.5, 1.0}) ASSERT_TRUE(found = equilibrium.find(state, t));
    double sum = 0;
    for (std::size_t i = 0; i < model.points.size(); ++i)
      if (model.points[i].x() > 1 - 1e-9) sum += found->equations.residual(4 * i);
    const double expected = (mu + E_h / 3) * (l - std::pow(l, -5)) + T * l;
    EXPECT_LE(std::abs(sum / expected - 1), 1e-8) << l << ": " << sum << " N of " << expected;
  }
}

/// An eighth of a thick sphere, 2 and 4 mm, with a capsule outside, blown up from inside: P = P_solid + 2/B [E h/3 (λ⁻¹ − λ⁻⁷) + T/λ], λ the stretch
/// outside (Laplace; solid: Green and Zerna 1968, §3.10).
double blown_up(double E_h, double T, double stretch, int n) {
  auto model = thick_sphere_octant(2, 4, n, n);
  model.materials = {material("neo_hookean", {mu})};
  for (int c : {0, 1, 2}) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
  model.layers = {{{effect_named("capsule"), {E_h, T}}, faces_where(model, [](const Vector3d& x) { return x.norm() > 4 - 1e-6; })}};
  const double a = stretch, b = std::cbrt(1 + (a * a * a - 1) / 8);
  const double pressure = 2 * mu * (1 / b + 1 / (4 * std::pow(b, 4)) - 1 / a - 1 / (4 * std::pow(a, 4))) +
                          2.0 / 4 * (E_h / 3 * (1 / b - std::pow(b, -7)) + T / b);
  model.amplitudes.push_back({{{0, 0}, {1, 1}}});
  model.pressures = {{faces_where(model, [](const Vector3d& x) { return x.norm() < 2 + 1e-6; }), pressure, 1}};
  implicit::State end;
  rows(model, even_times(-1, 1, 8), &end);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (model.points[i].norm() < 2 + 1e-6) {
      sum += (model.points[i] + end.displacement(i)).norm() / 2;
      ++count;
    }
  return sum / count;
}

TEST(Capsule, ASphereBlownUp) {
  for (const auto& [E_h, T] : {std::pair{0.05, 0.0}, {0.0, 0.006}}) {
    const double coarse = blown_up(E_h, T, 1.4, 6), fine = blown_up(E_h, T, 1.4, 12);
    std::printf("  E h %g, T %g N/mm: inner stretch %.4f, finer %.4f of 1.4\n", E_h, T, coarse, fine);
    EXPECT_LE(std::abs(fine / 1.4 - 1), 0.01);
    EXPECT_LE(std::abs(fine - 1.4), 0.4 * std::abs(coarse - 1.4));
  }
}

/// A cube of 4 mm, free at its sides, pressed from above by 1 mm: springs and tissue carry the same stress, k u = μ (λ⁻² − λ), u = 1 − 4 (1 − λ).
TEST(Support, ABlockOnSprings) {
  for (double k : {0.0005, 0.005, 1.0}) {
    auto model = brick(uniform(0, 4, 3), uniform(0, 4, 3), uniform(0, 4, 3));
    model.materials = {material("neo_hookean", {mu})};
    for (int c : {0, 1}) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
    hold(model, 2, [](const Vector3d& x) { return x.z() > 4 - 1e-9; }, -1);
    support(model, {k, 0, 1e6});
    double low = 0.7, high = 1;
    for (int i = 0; i < 100; ++i) {
      const double l = (low + high) / 2;
      (k * (1 - 4 * (1 - l)) < mu * (1 / (l * l) - l) ? low : high) = l;
    }
    const double force = rows(model, even_times(0, 1, 4)).back().force.z(), expected = -16 * k * (1 - 4 * (1 - low));
    std::printf("  k %g N/mm³: %.9f N of %.9f\n", k, force, expected);
    EXPECT_LE(std::abs(force / expected - 1), 1e-8);
  }
}

/// Pressed by 0.4 mm, pulled along x by 4 mm and back: at gross slip the pull is μ times the press, both ways, and the way costs energy; below, springs.
TEST(Support, ABlockSlidesOnItsBed) {
  const double friction = 0.3, k = 0.05;
  auto model = brick(uniform(-5, 5, 4), uniform(-5, 5, 4), uniform(0, 3, 2));
  model.materials = {material("neo_hookean", {50.0})};  // stiff: what the bed does is what is seen
  model.amplitudes.push_back({{{0, 0}, {1, 1}}});
  model.amplitudes.push_back({{{1, 0}, {5, 1}, {9, 0}}});
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (model.points[i].z() > 3 - 1e-9)
      for (int c = 0; c < 3; ++c) model.prescribed.push_back({int(i), c, c == 2 ? -0.4 : c == 0 ? 4.0 : 0.0, c == 2 ? 1 : 2});
  support(model, {k, 1, friction});
  EXPECT_FALSE(implicit::is_conservative(model));
  const auto list = rows(model, even_times(0, 9, 36));
  const auto at = [&](double t) { return *std::find_if(list.begin(), list.end(), [&](const Row& row) { return row.time > t - 1e-9; }); };
  std::printf("  pull %.6f and %.6f N, press %.6f N\n", at(5).force.x(), at(9).force.x(), -at(5).force.z());
  EXPECT_LE(std::abs(at(5).force.x() / -at(5).force.z() / friction - 1), 1e-3);
  EXPECT_LE(std::abs(at(9).force.x() / -at(9).force.z() / -friction - 1), 1e-3);
  double work = 0;  // of the pull, there and back
  for (std::size_t i = 1; i < list.size(); ++i)
    work += 0.5 * (list[i].force.x() + list[i - 1].force.x()) * (model.amplitudes[2].at(list[i].time) - model.amplitudes[2].at(list[i - 1].time)) * 4;
  const double slid = 8 - 2.5 * friction * 0.4;  // the springs give by μ p/k = μ 0.4 before it slides: half of that is stored, and twice that is lost on the turn
  EXPECT_LE(std::abs(work / (friction * -at(5).force.z() * slid) - 1), 0.02);
  support(model, {k, 1, 1e6});
  const auto bonded = rows(model, {0, 1, 1.5});
  EXPECT_LE(std::abs(bonded.back().force.x() / (k * 100 * 0.5) - 1), 0.02);  // the block's own shear
}

/// A plane drawn back from a cube of 4 mm: the work to part them is w times the area, the largest pull 2 w/r times the area.
TEST(Adhesion, WorkOfSeparation) {
  for (const auto& [work, range] : {std::pair{0.1, 0.5}, {0.4, 1.0}}) {
    auto model = brick(uniform(0, 4, 4), uniform(0, 4, 4), uniform(0, 4, 4));
    model.materials = {material("neo_hookean", {mu})};
    for (int c : {0, 1, 2}) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
    contact::Tool plane{tool_named("plane"), {}, -Vector3d::UnitZ(), {2, 2, 4}, 2, Amplitude{{{0, 0}, {1, -1}}}};
    plane.tractions = {{effect_named("adhesion"), {work, range}}};
    model.tools = {plane};
    const auto list = rows(model, even_times(0, 1, 80));
    double done = 0, peak = 0, before = 0, time = 0;
    for (const auto& row : list) {
      done += 0.5 * (row.force.z() + before) * 2 * (row.time - time);
      before = row.force.z();
      time = row.time;
      peak = std::max(peak, before);
    }
    std::printf("  %g J/m², %g mm: work %.5g of %.5g N mm, largest pull %.5g of %.5g N\n", work, range, done, 1e-3 * work * 16, peak, 2e-3 * work / range * 16);
    EXPECT_LE(std::abs(done / (1e-3 * work * 16) - 1), 0.01);
    EXPECT_LE(std::abs(peak / (2e-3 * work / range * 16) - 1), 0.01);
    EXPECT_LE(std::abs(list.back().force.z()), 1e-12);
  }
}

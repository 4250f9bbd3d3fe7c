// The block of bench/calculix and bench/getfem/patch_on_block.py, pushed down over its whole top: a quarter, on brick meshes that get finer
// towards the edges, where stress is singular. Force at 6 mm.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include <solver/implicit/steps.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

constexpr double side = 20, height = 20, depth = 6;

std::vector<double> towards(double end, int cells) {
  std::vector<double> places;
  for (int i = 0; i <= cells; ++i) places.push_back(end * (1 - std::pow(1 - double(i) / cells, 2)));
  return places;
}

std::vector<double> towards_both(double whole, int cells) {
  const auto half = towards(whole / 2, cells / 2);
  std::vector<double> places;
  for (int i = cells / 2; i >= 0; --i) places.push_back(whole / 2 - half[i]);
  for (int i = 1; i <= cells / 2; ++i) places.push_back(whole / 2 + half[i]);
  return places;
}

elements::Material law_of(const std::string& law) {
  auto m = law == "yeoh" ? material("yeoh", {0.0034, 0.0012, 0.0005})
           : law == "mooney_rivlin" ? material("mooney_rivlin", {0.083, 0.0565}) : material("neo_hookean", {0.0067});
  m.bulk_modulus = 100 * m.shear_modulus();
  return m;
}

}  // namespace

/// bench-patch-on-block LAW CELLS...: force in N and processor seconds for each number of cells along 20 mm, even.
int main(int argc, char** argv) {
  for (int k = 2; k < argc; ++k) {
    const int cells = std::atoi(argv[k]);
    auto model = brick(towards(side, cells), towards(side, cells), towards_both(height, cells));
    model.materials = {law_of(argv[1])};
    for (int i = 0; i < static_cast<int>(model.points.size()); ++i) {
      const auto& x = model.points[i];
      const bool bottom = x.z() < 1e-9, top = x.z() > height - 1e-9;
      for (int c = 0; c < 3; ++c)
        if (bottom || top || (c < 2 && x(c) < 1e-9)) model.prescribed.push_back({i, c, top && c == 2 ? -depth : 0.0, 0});
    }
    implicit::Equilibrium equilibrium(model, 1);
    implicit::State state = implicit::rest_state(model);
    double force = 0;
    const double reached = run_steps(equilibrium, state, {{0, 0.25, 0.5, 0.75, 1}}, [&](const implicit::Step& step) {
      if (step.index == 0) return;
      force = 0;
      for (std::size_t i = 0; i < model.points.size(); ++i)
        if (model.points[i].z() > height - 1e-9) force -= 4 * step.equations.residual(4 * i + 2);
    });
    std::printf("%s %d cells, %zu nodes: %.5f N at %.2f of the way, %.1f processor s\n", argv[1], cells, model.points.size(), force, reached,
                std::clock() / double(CLOCKS_PER_SEC));
    std::fflush(stdout);
  }
}

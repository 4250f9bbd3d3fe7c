// A ball pressed into a block on finer and finer bricks: bonded below, neo-Hookean, incompressible, frictionless. A quarter, graded towards the
// contact, every mesh of the same family, so that the force's limit can be told. Unless told otherwise the ball and block of bench/getfem: a ball of
// 4 mm radius pressed 2 mm into 16 x 16 x 8 mm.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include <solver/implicit/steps.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

struct Sizes {
  double side = 8, height = 8, radius = 4, depth = 2, mu = 0.0067;  ///< side: half of the block's; mm, MPa
};
constexpr int reports = 8;

/// From 0 to `end`: the first cells are `first` of the mean, the last the longest.
std::vector<double> growing(double end, int cells, double first) {
  std::vector<double> places;
  for (int i = 0; i <= cells; ++i) {
    const double g = double(i) / cells;
    places.push_back(end * (first * g + (1 - first) * std::pow(g, 3)));
  }
  return places;
}

implicit::Model quarter(const Sizes& sizes, int cells) {
  const auto& [side, height, radius, depth, mu] = sizes;
  const auto along = growing(side, cells, 0.5), down = growing(height, cells, 0.5);
  std::vector<double> up;
  for (auto d = down.rbegin(); d != down.rend(); ++d) up.push_back(height - *d);
  auto model = brick(along, along, up);
  model.materials = {material("neo_hookean", {mu})};
  for (int i = 0; i < static_cast<int>(model.points.size()); ++i)
    for (int c = 0; c < 3; ++c)
      if (model.points[i].z() < 1e-9 || (c < 2 && model.points[i](c) < 1e-9)) model.prescribed.push_back({i, c, 0.0, 0});
  const double top = height - 1e-9;
  std::erase_if(model.faces, [&](const auto& face) { return std::any_of(face.begin(), face.end(), [&](int node) { return model.points[node].z() < top; }); });
  model.tools = {contact::Tool{tool_named("ball"), {radius}, -Vector3d::UnitZ(), Vector3d(0, 0, height), depth, {}}};
  return model;
}

}  // namespace

/// bench-ball-on-block [SIDE HEIGHT RADIUS DEPTH MU --] CELLS...: force in N at every eighth of the depth for each number of cells along the block's
/// height and half its side; SIDE is that half; mm and MPa.
int main(int argc, char** argv) {
  Sizes sizes;
  int first = 1;
  if (argc > 6 && std::strcmp(argv[6], "--") == 0) {
    sizes = {std::atof(argv[1]), std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4]), std::atof(argv[5])};
    first = 7;
  }
  for (int k = first; k < argc; ++k) {
    const int cells = std::atoi(argv[k]);
    const auto model = quarter(sizes, cells);
    implicit::Equilibrium equilibrium(model, 1);
    implicit::State state = implicit::rest_state(model);
    std::vector<double> times;
    for (int i = 0; i <= reports; ++i) times.push_back(double(i) / reports);
    const std::clock_t start = std::clock();
    std::printf("%3d cells, %6zu nodes, edge %.3f mm:", cells, model.points.size(), sizes.side * 0.5 / cells);
    run_steps(equilibrium, state, {times}, [&](const implicit::Step& step) {
      if (step.index > 0) std::printf(" %.6f", -4 * step.equations.contact.tools[0].force.z());
      std::fflush(stdout);
    });
    std::printf("  %.1f processor s\n", double(std::clock() - start) / CLOCKS_PER_SEC);
  }
}

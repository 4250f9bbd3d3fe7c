// Time and memory of the implicit solver on one block of tissue pressed by a ball, at a given number of nodes: set-up, assembly,
// factorisation, and a whole step from first contact.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <solver/implicit/equilibrium.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;
using Clock = std::chrono::steady_clock;

namespace {

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double peak_memory_gb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1048576.0;
}

implicit::Model block(int nodes) {
  const int n = static_cast<int>(std::round(std::cbrt(nodes / 0.6)));
  auto model = brick(uniform(-30, 30, n - 1), uniform(-30, 30, n - 1), uniform(0, 36, static_cast<int>(0.6 * n) - 1));
  model.materials = {material("neo_hookean", {0.0067})};
  for (int c = 0; c < 3; ++c) hold(model, c, [](const Vector3d& x) { return x.z() < 1e-9; });
  model.tool = contact::Tool{tool_named("ball"), {10.0}, -Vector3d::UnitZ(), {0.1, 0.2, 36}, 2.0};
  return model;
}

}  // namespace

int main(int argc, char** argv) {
  const int nodes = argc > 1 ? std::atoi(argv[1]) : 5000, threads = argc > 2 ? std::atoi(argv[2]) : 2;
  const auto model = block(nodes);
  auto start = Clock::now();
  implicit::Equilibrium equilibrium(model, threads);
  const double analysis = seconds_since(start);
  implicit::State state = implicit::rest_state(model);
  implicit::BlockMatrix tangent(static_cast<int>(model.points.size()), model.tets);
  double assembly[2];
  for (int t : {1, 2}) {
    const implicit::Assembly assemble(model, t);
    start = Clock::now();
    for (int i = 0; i < 3; ++i) assemble(state, tangent);
    assembly[t - 1] = seconds_since(start) / 3;
  }
  start = Clock::now();
  const auto found = equilibrium.find(state, 0.1);
  if (!found) {
    std::fprintf(stderr, "no equilibrium: %s\n", equilibrium.trouble().cause.c_str());
    return 5;
  }
  const double step = seconds_since(start);
  std::printf("%8zu %9zu %9.2f %10.3f %10.3f %6.2f %6d %10.2f %12.2f %8.2f\n", model.points.size(), model.tets.size(), analysis, assembly[0],
              assembly[1], assembly[0] / assembly[1], found->iterations, step, step / found->iterations, peak_memory_gb());
}

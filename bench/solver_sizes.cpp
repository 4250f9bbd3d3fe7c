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

/// Mean seconds of assembling the equations at rest.
double assembly_seconds(const implicit::Model& model, implicit::State& state, implicit::BlockMatrix& tangent, int threads) {
  const implicit::Assembly assemble(model, threads);
  const auto start = Clock::now();
  for (int i = 0; i < 3; ++i) assemble(state, tangent);
  return seconds_since(start) / 3;
}

/// Analysis, factorisation and solution of the equations at rest.
void print_linear_algebra(const implicit::Model& model, const implicit::BlockMatrix& tangent, int threads) {
  std::vector<int> rows, columns;
  tangent.coordinates(rows, columns);
  auto start = Clock::now();
  implicit::SparseDirect solver(4 * tangent.nodes(), std::move(rows), std::move(columns), threads);
  std::printf(" %9.2f", seconds_since(start));
  std::vector<char> fixed(4 * model.points.size(), 0);
  for (const auto& p : model.prescribed) fixed[4 * p.node + p.component] = 1;
  std::vector<double> values;
  tangent.values(fixed, values);
  start = Clock::now();
  solver.factor(values);
  std::printf(" %9.2f", seconds_since(start));
  Eigen::VectorXd x = Eigen::VectorXd::Ones(4 * tangent.nodes());
  start = Clock::now();
  solver.solve(x);
  std::printf(" %9.2f %9.2f", seconds_since(start), peak_memory_gb());
}

}  // namespace

/// bench-solver-sizes NODES [THREADS] [step]: with "step", a whole step from first contact too.
int main(int argc, char** argv) {
  const int nodes = argc > 1 ? std::atoi(argv[1]) : 5000, threads = argc > 2 ? std::atoi(argv[2]) : 2;
  const auto model = block(nodes);
  implicit::State state = implicit::rest_state(model);
  implicit::BlockMatrix tangent(static_cast<int>(model.points.size()), model.tets);
  const double one = assembly_seconds(model, state, tangent, 1), two = assembly_seconds(model, state, tangent, 2);
  std::printf("%8zu %9zu %10.3f %10.3f %6.2f", model.points.size(), model.tets.size(), one, two, one / two);
  print_linear_algebra(model, tangent, threads);
  if (argc > 3) {
    implicit::Equilibrium equilibrium(model, threads);
    const auto start = Clock::now();
    const auto found = equilibrium.find(state, 0.1);
    if (!found) {
      std::fprintf(stderr, "no equilibrium: %s\n", equilibrium.trouble().cause.c_str());
      return 5;
    }
    std::printf(" %7d %9.2f", found->iterations, seconds_since(start));
  }
  std::printf("\n");
}

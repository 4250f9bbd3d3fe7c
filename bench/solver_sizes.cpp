// Time and memory of the implicit solver on one block of tissue pressed by a ball, at a given number of nodes: set-up, assembly,
// factorisation, and a whole step from first contact.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <stdexcept>
#include <string>
#include <vector>

#include <solver/implicit/steps.hpp>
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
  model.tools = {contact::Tool{tool_named("ball"), {10.0}, -Vector3d::UnitZ(), {0.1, 0.2, 36}, 2.0, {}}};
  return model;
}

/// A smooth motion of a twentieth, so that bubbles have something to solve.
implicit::State deformed(const implicit::Model& model) {
  auto state = implicit::rest_state(model);
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const auto& x = model.points[i];
    state.nodal.segment<3>(4 * i) << 0.02 * x.z() * std::sin(x.y() / 8), 0.02 * x.z() * std::cos(x.x() / 8), -5e-4 * x.z() * x.z();
  }
  return state;
}

double assembly_seconds(const implicit::Assembly& assemble, implicit::State state, implicit::BlockMatrix& tangent) {
  const auto start = Clock::now();
  if (assemble(state, tangent).fault != elements::ElementFault::none) throw std::logic_error("the motion turns an element over");
  return seconds_since(start);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Seconds of assembling the equations by one thread and by two, in turns, and their ratio: medians.
void print_assembly(const implicit::Model& model, implicit::BlockMatrix& tangent) {
  constexpr int turns = 9;
  const implicit::Assembly one(model, 1), two(model, 2);
  const auto state = deformed(model);
  std::vector<double> by_one, by_two, ratios;
  for (int i = 0; i < turns; ++i) {
    by_one.push_back(assembly_seconds(one, state, tangent));
    by_two.push_back(assembly_seconds(two, state, tangent));
    ratios.push_back(by_one.back() / by_two.back());
  }
  std::printf("%8zu %9zu %10.4f %10.4f %6.2f", model.points.size(), model.tets.size(), median(by_one), median(by_two), median(ratios));
}

/// Analysis, factorisation and solution of the equations at rest.
void print_linear_algebra(const implicit::Model& model, const implicit::BlockMatrix& tangent, int threads) {
  std::vector<int> rows, columns;
  tangent.coordinates(rows, columns);
  auto start = Clock::now();
  implicit::SparseDirect solver(4 * tangent.nodes(), std::move(rows), std::move(columns), true, threads);
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

/// What the steps of an indentation cost, and where the time goes.
int print_indentation(const implicit::Model& model, int threads, int steps, double depth, bool keep_factor) {
  implicit::State state = implicit::rest_state(model);
  const auto start = Clock::now();
  implicit::NewtonLimits limits;
  limits.keep_factor = keep_factor;
  implicit::Equilibrium equilibrium(model, threads, limits);
  implicit::StepPlan plan;
  for (int i = 0; i <= steps; ++i) plan.times.push_back(double(i) / steps);
  std::printf("%zu nodes, a factor is worth %d iterations\n", model.points.size(), equilibrium.worth());
  std::printf("step  depth  force  newton cuts drags | assemblies factors gmres | assembly factor solution [s] all [s] processors [s]\n");
  double force = 0;
  const auto report = [&](const implicit::Step& step) {
    if (step.index == 0) return;
    const auto work = equilibrium.work();
    force = step.equations.contact.tools[0].force.norm();
    std::printf("%3d %6.3f %10.7f %3d %3d %3d | %4d %3d %4d | %7.2f %7.2f %7.2f %7.2f %7.2f\n", step.index, depth * step.state.time, force,
                step.iterations, step.cuts, step.drags, work.assemblies, work.factors, work.iterations, work.assembly_s, work.factor_s,
                work.solution_s, seconds_since(start), std::clock() / double(CLOCKS_PER_SEC));
    std::fflush(stdout);
  };
  const double reached = run_steps(equilibrium, state, plan, report);
  std::printf("%s, %.10f N, %.2f GB\n", reached == 1 ? "done" : equilibrium.trouble().cause.c_str(), force, peak_memory_gb());
  return reached == 1 ? 0 : 5;
}

/// bench-solver-sizes NODES [THREADS] [step|assembly]: with "step", a whole step from first contact too; with "assembly", nothing else.
/// bench-solver-sizes NODES THREADS indentation [STEPS [DEPTH [always]]]: all steps; with "always" a factor in every iteration.
int main(int argc, char** argv) {
  const int nodes = argc > 1 ? std::atoi(argv[1]) : 5000, threads = argc > 2 ? std::atoi(argv[2]) : 2;
  const std::string what = argc > 3 ? argv[3] : "";
  const int steps = argc > 4 ? std::atoi(argv[4]) : 20;
  const double depth = argc > 5 ? std::atof(argv[5]) : 6;
  auto model = block(nodes);
  if (what == "indentation") {
    model.tools[0].depth = depth;
    return print_indentation(model, threads, steps, depth, argc < 7);
  }
  implicit::BlockMatrix tangent(static_cast<int>(model.points.size()), model.tets);
  print_assembly(model, tangent);
  if (what != "assembly") print_linear_algebra(model, tangent, threads);
  if (what == "step") {
    implicit::State state = implicit::rest_state(model);
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

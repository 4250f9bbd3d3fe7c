// Element-cycles per second of the explicit shells on a tube of 25 mm closed by the clamp: the wall alone, with contact, on one and two threads.
//   bench-shell-cycles [EDGE_MM [SECONDS]]      default 2 mm, 5 s each
// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>

#include <solver/explicit/closing.hpp>

using namespace palpate;
using namespace palpate::explicit_shell;
using Clock = std::chrono::steady_clock;

namespace {

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Of all threads together.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Rings of staggered nodes, 100 mm long, wall of 1.4 mm.
ShellMesh tube(double edge) {
  ShellMesh mesh;
  const double radius = 12.5 - 0.7, length = 100;
  const int around = static_cast<int>(std::round(2 * std::numbers::pi * radius / edge)), rings = static_cast<int>(std::round(length / (edge * std::sqrt(0.75))));
  for (int r = 0; r <= rings; ++r)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * (i + (r % 2) * 0.5) / around;
      mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle), length * r / rings});
      mesh.thickness_mm.push_back(1.4);
      mesh.end.push_back(r == 0 ? 1 : r == rings ? 2 : 0);
      mesh.end_direction.push_back(r == 0 ? Vec3{0, 0, -1} : r == rings ? Vec3{0, 0, 1} : Vec3{0, 0, 0});
    }
  for (int r = 0; r < rings; ++r)
    for (int i = 0; i < around; ++i) {
      const int a = r * around + i, b = r * around + (i + 1) % around, c = a + around, d = b + around;
      if (r % 2 == 0) mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
      else mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
    }
  mesh.triangle_region.assign(mesh.triangles.size(), 1);
  return mesh;
}

Case closing_of(double edge) {
  Case c;
  c.mesh = tube(edge);
  c.wall = make_wall(c.mesh, materials::MooneyRivlinShell{0.083, 0.0565}, 1.05e-9);
  c.holds = no_holds(c.wall);
  for (std::size_t i = 0; i < c.mesh.points.size(); ++i)
    if (c.mesh.end[i] > 0) c.holds.hold[i] = Hold::along, c.holds.direction[i] = lanes(c.mesh.end_direction[i]);
  c.clamp.centre = {0, 0, 50};
  c.clamp.axis = {0, -1, 0};
  c.clamp.along = {0, 0, 1};
  c.clamp.gap = 3;
  c.clamp.speed = 200;
  return c;
}

struct Watch {
  Clock::time_point start = Clock::now();
  double used = processor_seconds();
  void tell(const char* what, int threads, double cycles, const Case& c) const {
    const double seconds = seconds_since(start), work = cycles * c.wall.triangles.size() / 1e6;
    std::printf("%-34s%8d%10.0f%9.2f%9.2f%12.2f%14.2f\n", what, threads, cycles, seconds, processor_seconds() - used, work / seconds, work / (processor_seconds() - used));
  }
};

/// The wall alone, swinging freely.
void alone(double edge, int threads, double seconds) {
  Case c = closing_of(edge);
  Motion motion(c.wall, c.holds, threads);
  for (std::size_t i = 0; i < c.wall.rest.size(); ++i) motion.state.v[i] = Lanes{0, 50 * std::sin(c.wall.rest[i][0]), 0, 0};
  const double dt = 0.7 * motion.stable().first;
  long cycles = 0;
  const Watch watch;
  for (; seconds_since(watch.start) < seconds; cycles += 100)
    for (int i = 0; i < 100; ++i) motion.step(dt);
  watch.tell("wall alone", threads, cycles, c);
}

/// A closing to the end at 200 mm/s: jaws, self-contact, stable steps and rows of the history included.
void closing(double edge, int threads) {
  Case c = closing_of(edge);
  c.rows = 20, c.frames = 1;
  Closing run(c, threads);
  const Watch watch;
  run.run([](const Row&) {}, [](const Row&) {});
  watch.tell("closed by the clamp, with contact", threads, run.cycles, c);
}

}  // namespace

int main(int argc, char** argv) {
  const double edge = argc > 1 ? std::atof(argv[1]) : 2, seconds = argc > 2 ? std::atof(argv[2]) : 5;
  if (!(edge > 0.2 && edge < 10 && seconds > 0)) return 2;
  std::printf("Explicit shells: Mooney-Rivlin, five points, a tube of %zu triangles; millions of element-cycles per second, and per second of processor\n", tube(edge).triangles.size());
  std::printf("%-34s%8s%10s%9s%9s%12s%14s\n", "", "threads", "cycles", "s", "cpu s", "million/s", "million/cpu s");
  for (int threads : {1, 2}) alone(edge, threads, seconds);
  for (int threads : {1, 2}) closing(edge, threads);
}

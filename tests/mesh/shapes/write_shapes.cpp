// Writes the test surfaces, good and bad, into the folder named on the command line: for tests/stage/mesh.sh.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <tests/mesh/shapes.hpp>

using namespace palpate;

int main(int, char** argv) {
  const std::filesystem::path folder = argv[1];
  const Surface ball = shapes::ball({5, -3, 40}, 10, 3);
  write_surface(folder / "ball.vtp", ball);
  write_surface(folder / "bean.vtp", shapes::bean({30, 17, 12.5}, 8, 3));
  write_surface(folder / "torus.vtp", shapes::torus(20, 6, 60, 18));

  Surface two = ball;
  shapes::append(two, shapes::ball({30, -3, 40}, 8, 3));
  write_surface(folder / "two.vtp", two);

  Surface hollow = ball, inner = shapes::ball({6, -3, 40}, 5, 3);
  shapes::turn(inner);
  shapes::append(hollow, inner);
  write_surface(folder / "hollow.vtp", hollow);

  Surface stone = ball;
  shapes::append(stone, shapes::ball({6, -3, 40}, 5, 3, 2, "stone"));
  write_surface(folder / "stone.vtp", stone);

  Surface doubled = ball;
  shapes::append(doubled, shapes::ball({6, -3, 40}, 5, 3));
  write_surface(folder / "doubled.vtp", doubled);

  Surface crossing = ball;
  shapes::append(crossing, shapes::ball({13, -3, 40}, 5, 3, 2, "stone"));
  write_surface(folder / "crossing.vtp", crossing);

  Surface open = ball;
  open.triangles.pop_back();
  open.triangle_region.pop_back();
  write_surface(folder / "open.vtp", open);

  Surface inside_out = ball;
  shapes::turn(inside_out);
  write_surface(folder / "inside_out.vtp", inside_out);
}

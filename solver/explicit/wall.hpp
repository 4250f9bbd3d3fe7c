// A thin wall as the explicit scheme sees it: nodes with mass, edges with a director and its inertia, triangles in packs of four.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <variant>
#include <vector>

#include <palpate/mesh_files.hpp>
#include <solver/elements/shell_triangle.hpp>

namespace palpate::explicit_shell {

using elements::Lanes;  // also a vector in space: x, y, z, unused

using ShellLaw = std::variant<materials::NeoHookeanShell, materials::MooneyRivlinShell, materials::YeohShell, materials::FungDemirayShell,
                              materials::OgdenShell, materials::HookeShell>;

inline double dot3(const Lanes& a, const Lanes& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length3(const Lanes& a) { return __builtin_sqrt(dot3(a, a)); }
inline Lanes cross3(const Lanes& a, const Lanes& b) {
  return Lanes{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0};
}
inline Lanes lanes(const Vec3& v) { return Lanes{v[0], v[1], v[2], 0}; }
inline Vec3 vec3(const Lanes& v) { return {v[0], v[1], v[2]}; }

/// Four triangles: numbers of their nodes and edges, their shape at rest. Aligned as AVX wants it, whoever allocates it.
struct alignas(32) Pack {
  std::array<std::array<int, 4>, 3> node, edge;  ///< [corner][lane]
  elements::ShellRest<Lanes> rest;
};

/// Rows of numbers: of row r entries[start[r]] … entries[start[r + 1]] − 1.
struct Rows {
  std::vector<int> start, entries;
};

struct Wall {
  std::vector<Lanes> rest;                        ///< nodes at rest, mm
  std::vector<std::array<int, 3>> triangles, triangle_edges;  ///< edge k of a triangle lies opposite corner k
  std::vector<std::array<int, 2>> edges;          ///< nodes, ascending
  std::vector<Lanes> directors;                   ///< at rest
  std::vector<double> thickness, mass, inertia;   ///< mm of a node; tonne of a node; tonne mm² of an edge's director
  std::vector<Pack> packs;
  Rows node_slots, edge_slots;                    ///< 3 · triangle + corner of all triangles around
  ShellLaw law;
  double density = 1e-9;                          ///< tonne/mm³
  std::vector<double> mass_factor;                ///< of a triangle, by mass scaling
  double added_mass = 0;                          ///< tonne
  std::vector<double> stiffening;                 ///< of a triangle: how many times stiffer than its law effects may make it; empty: not at all
};

/// Directors at rest: the mean normal of the triangles at an edge. Throws Failure(unreadable) for a triangle without area, an edge
/// with more than two triangles, or neighbours that face opposite ways.
Wall make_wall(const ShellMesh& mesh, const ShellLaw& law, double density);

/// Where the wall is, and how fast.
struct WallState {
  std::vector<Lanes> x, v;            ///< mm, mm/s
  std::vector<Lanes> director;
  std::vector<double> spin;           ///< rad/s about the edge
};
WallState rest_state(const Wall& wall);

/// Of the triangles around each node a third, mm² at rest.
std::vector<double> node_areas(const Wall& wall);

elements::ShellRest<double> lane(const elements::ShellRest<Lanes>& rest, int lane);
elements::ShellNow<double> now(const Wall& wall, const WallState& state, int triangle);

/// Stable time step of one triangle (s): 2/√λ of its own stiffness and mass, membrane and bending apart, in its present shape.
/// (The largest eigenvalue of a mesh is at most that of its elements: Irons & Treharne 1971; Hughes 2000, §9.2.)
double stable_step(const Wall& wall, const WallState& state, int triangle);

}  // namespace palpate::explicit_shell

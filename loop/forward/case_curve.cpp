// A case's text with other materials and effects, its mesh refined under the tool, and what the solves say of both.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/case_curve.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

#include <palpate/errors.hpp>
#include <palpate/mesh_files.hpp>
#include <palpate/text_file.hpp>
#include <loop/forward/departures.hpp>
#include <loop/forward/memory_length.hpp>
#include <loop/forward/process.hpp>
#include <loop/methods/parallel.hpp>

namespace palpate::loop {
namespace {

namespace fs = std::filesystem;

constexpr double shares[] = {0.06, 0.2};  ///< of the force that departures change where they are solved, by the closed form: about the least and the most that is looked for

constexpr int base_steps = 14;  ///< changes are asked at every second of these depths, where the mesh's own roughness cancels

/// A solve of the case with something in it.
struct Variant {
  std::string text;
  SolvedCurve curve;
  std::string failure;
};

/// The start without any departure that the solver is asked about.
Tissue without_departures(Tissue tissue) {
  for (const Departure& d : departures())
    if (d.in(tissue)) d.remove(tissue);
  return tissue;
}

/// Sizes at which a departure is solved: about the null's own, or where it changes the closed form by the shares.
std::vector<double> sizes_of(const Departure& d, const Site& site, const Tissue& start, const Tissue& base, double deepest) {
  if (const double own = d.amplitude(start); own != 0) return {0.5 * own, 1.5 * own};
  std::vector<double> sizes;
  for (double share : shares) sizes.push_back(amplitude_of(d, site, base, deepest, share));
  return sizes;
}

/// All changes that are asked for, each curve with its size and nothing solved yet.
std::vector<SolvedChange> changes_of(const SiteJob& job, const Site& site, const Tissue& start, bool law_open, const std::vector<double>& inclusions_mm) {
  const Tissue base = without_departures(start);
  std::vector<SolvedChange> list;
  const auto add = [&](const std::string& of, double depth, const std::vector<double>& sizes) {
    SolvedChange change;
    change.of = of;
    change.depth_of_it_mm = depth;
    for (double size : sizes) change.curves.push_back({size, {}, {}});
    list.push_back(std::move(change));
  };
  for (const Departure& d : departures())
    if (!d.is_law || d.in(start) || (law_open && base.law->name == "neo_hookean")) add(d.name, 0, sizes_of(d, site, start, base, job.deepest_mm));
  for (double depth : inclusions_mm) add("inclusion", depth, {0.4, 1.1});
  return list;
}

std::string words_of(const SolvedChange& change, double size, const Tissue& base, const SiteJob& job, double surface) {
  if (change.of == "inclusion") return material_text(base) + inclusion_words(job.run->point_mm + (surface / norm(job.run->axis)) * job.run->axis, job.run->axis, change.depth_of_it_mm, std::expm1(size));
  Tissue tissue = base;
  departure_named(change.of).add(tissue, size);
  return material_text(tissue) + (change.of == "thickness" ? thickness_words(job.set->specimen.case_file, size) : "");
}

/// The mesh with edges half as long where the tool comes: within a contact radius of its axis, and half of one deep.
fs::path refined_mesh(const SiteJob& job, const fs::path& own, double contact) {
  const TetMesh mesh = read_mesh(own);
  const Vec3 axis = (1 / norm(job.run->axis)) * job.run->axis;
  const auto along = [&](const Vec3& p) { return dot(p - job.run->point_mm, axis); };
  const auto aside = [&](const Vec3& p) { return norm(p - job.run->point_mm - along(p) * axis); };
  const double first = surface_along(own, job.run->point_mm, axis, contact);
  std::vector<double> target(mesh.tets.size(), 0), lengths;
  std::vector<std::size_t> near;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Vec3 middle{0, 0, 0};
    double longest = 0;
    for (int a : mesh.tets[t]) {
      middle = middle + 0.25 * mesh.points[a];
      for (int b : mesh.tets[t]) longest = std::max(longest, norm(mesh.points[a] - mesh.points[b]));
    }
    if (aside(middle) > contact || along(middle) > first + 0.5 * contact) continue;
    near.push_back(t);
    lengths.push_back(longest);
  }
  if (near.empty()) throw Failure(ExitCode::refused, "the mesh has nothing under tool " + job.run->tool, own.string(), "point_mm and axis of the run");
  std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
  for (std::size_t t : near) target[t] = std::max(0.5 * lengths[lengths.size() / 2], contact / 6);
  const FolderLock lock(job.kept);
  const fs::path marked = job.kept / "marked.vtu", finer = job.kept / "finer.vtu", log = job.kept / "remesh.txt";
  write_mesh(marked, mesh, {}, {{"target_mm", 1, target}});
  if (run_logged(beside("palpate-remesh"), {marked.string(), finer.string(), "--quiet", "--force"}, log) != 0)
    throw Failure(ExitCode::not_converged, "the mesh cannot be made finer under tool " + job.run->tool + ": " + read_text(log), own.string(), "--forward closed");
  return finer;
}

/// What a mesh misses falls by a power of its edges, on graded meshes between the first and the second: after halving them at least a third of the change is still
/// missing (Richardson 1911), which is added, and at most all of it.
SolvedCurve extrapolated(SolvedCurve finer, const SolvedCurve& own, SiteCurve& curve) {
  std::vector<double>& ratio = curve.mesh_change;
  for (std::size_t i = 0; i < finer.depth_mm.size(); ++i) ratio.push_back(std::log(finer.force_N[i] / own.at(finer.depth_mm[i])));
  curve.mesh_depth_mm = finer.depth_mm;
  const double n = static_cast<double>(ratio.size());
  for (double r : ratio) curve.mesh_shift += r / n;
  double squares = 0;
  for (double r : ratio) squares += (r - curve.mesh_shift) * (r - curve.mesh_shift) / n;
  curve.mesh_apart = std::sqrt(squares);
  for (std::size_t i = 0; i < ratio.size(); ++i) finer.force_N[i] *= std::exp(ratio[i] / 3);
  return finer;
}

/// What the solves of a change say; those that failed are left out.
void tell(SolvedChange& change, const std::vector<const Variant*>& solves, const SolvedCurve& base) {
  std::vector<SolvedChange::Curve> done;
  for (std::size_t k = 0; k < solves.size(); ++k) {
    if (!solves[k]->failure.empty()) {
      change.failure = solves[k]->failure;
      continue;
    }
    SolvedChange::Curve curve = change.curves[k];
    curve.depth_mm = solves[k]->curve.depth_mm;
    for (std::size_t i = 0; i < curve.depth_mm.size(); ++i) curve.log_ratio.push_back(std::log(solves[k]->curve.force_N[i] / base.at(curve.depth_mm[i])));
    done.push_back(std::move(curve));
  }
  change.curves = std::move(done);
}

void refuse_another_organ(double force_ratio, const fs::path& searched) {
  if (!(std::abs(std::log(force_ratio)) < std::log(1.5)))
    throw Failure(ExitCode::refused, "on the search mesh the force is " + std::to_string(force_ratio) + " times that on the mesh of the case", searched.string(), "search_mesh: a coarser mesh of the same organ");
}

}  // namespace

Tissue base_of_case(const Set& set, const Tissue& start) { return has_one_material(set.specimen.case_file) ? without_departures(start) : start; }

SolvedCurve solve_case(const SiteJob& job, const Site& site, const Tissue& start, bool law_open, const std::vector<double>& inclusions_mm, int threads, SiteCurve& curve) {
  const fs::path& file = job.set->specimen.case_file;
  const fs::path own = mesh_of_case(file), searched = job.set->specimen.search_mesh.empty() ? own : job.set->specimen.search_mesh;
  fs::create_directories(job.kept);
  const double contact = std::min(std::sqrt(site.tool.radius_mm * job.deepest_mm), site.tool.radius_mm);
  const fs::path finer = refined_mesh(job, own, contact);
  curve.surface_mm = surface_along(own, job.run->point_mm, job.run->axis, contact);
  const bool one = has_one_material(file);
  const std::string rest = case_without(read_text(file), one ? std::vector<std::string>{"material", "tool", "steps"} : std::vector<std::string>{"tool", "steps"});
  const Tissue base = base_of_case(*job.set, start);
  const std::string plain = rest + (one ? material_text(base) : "");
  if (one) curve.changes = changes_of(job, site, start, law_open, inclusions_mm);
  std::vector<fs::path> meshes{finer, own};  // of the case without changes: that which takes longest first
  if (one && searched != own) meshes.push_back(searched);
  const std::size_t bases = meshes.size();
  std::vector<Variant> variants(bases, {plain, {}, {}});
  for (const SolvedChange& change : curve.changes)
    for (const auto& c : change.curves) variants.push_back({rest + words_of(change, c.amplitude, base, job, curve.surface_mm), {}, {}});
  SolvedMotion relaxed;  // left empty where it fails: springs stay as they are
  const SolvedCurve &of_own = variants[1].curve, &without = variants[bases - 1].curve;
  std::atomic<int> compared = 0;
  const int all = static_cast<int>(variants.size());
  for_each_index(one ? all + 1 : all, threads, [&](int i) {
    if (i < static_cast<int>(bases)) {
      variants[i].curve = solved(job, plain, meshes[i], base_steps);
      if (bases == 3 && i > 0 && ++compared == 2) refuse_another_organ(without.at(job.deepest_mm) / of_own.at(job.deepest_mm), searched);
      return;
    }
    try {
      if (i == all) relaxed = solved_motion(job, plain + relaxing_words(), relaxing_motion(job.deepest_mm), searched);
      else variants[i].curve = solved(job, variants[i].text, searched, base_steps / 2);
    } catch (const Failure& failure) {
      if (i < all) variants[i].failure = failure.what();
    }
  });
  std::size_t next = bases;
  for (SolvedChange& change : curve.changes) {
    std::vector<const Variant*> its;
    for (std::size_t k = 0; k < change.curves.size(); ++k) its.push_back(&variants[next++]);
    tell(change, its, without);
  }
  if (!relaxed.t_s.empty()) {
    const MemoryLength length = memory_length(relaxed, without, job.deepest_mm);
    curve.memory_mm = length.mm;
    curve.memory_missed = {length.before, length.after};
  }
  curve.solves = static_cast<int>(variants.size()) + (one ? 1 : 0);
  curve.nodes = static_cast<int>(read_mesh(finer).points.size());
  return extrapolated(variants[0].curve, of_own, curve);
}

}  // namespace palpate::loop

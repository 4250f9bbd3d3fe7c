// palpate-segment: a scan to labels of one organ, and a contact sheet of slices with its contour.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>

#include <cmath>
#include <cstdio>
#include <sstream>

#include <palpate/nifti.hpp>
#include <palpate/text_file.hpp>
#include <pipeline/image/cleaning.hpp>
#include <pipeline/image/contact_sheet.hpp>
#include <pipeline/image/dividing.hpp>
#include <pipeline/image/label_facts.hpp>
#include <pipeline/image/places.hpp>
#include <pipeline/image/segmentation.hpp>
#include <pipeline/image/smoothing.hpp>
#include <pipeline/image/threads.hpp>

namespace {

using namespace palpate;

template <class Entries>
std::vector<std::string> names_of(const Entries& entries, std::vector<std::string> names = {}) {
  for (const auto& entry : entries) names.push_back(entry.about.name);
  return names;
}

/// "[12.3, 45.6]" with open ends left out.
std::string interval_text(double lower, double upper) {
  char text[80];
  if (std::isinf(lower) && std::isinf(upper)) return "any";
  if (std::isinf(upper))
    std::snprintf(text, sizeof text, "%.4g and more", lower);
  else if (std::isinf(lower))
    std::snprintf(text, sizeof text, "%.4g and less", upper);
  else
    std::snprintf(text, sizeof text, "%.4g to %.4g", lower, upper);
  return text;
}

std::optional<double> optional_real(const Command& c, const std::string& option) {
  return c.has(option) ? std::optional(c.real(option)) : std::nullopt;
}

/// What the given options ask for, when no method is named.
std::string method_of(const Command& c) {
  if (c.text("method") != "auto") return c.text("method");
  if (!c.points("seeds").empty()) return "region_growing";
  return c.has("threshold-lower") || c.has("threshold-upper") ? "threshold" : "otsu";
}

segmentation::Task task_of(const Command& c, const Scan& scan, const Mask& domain) {
  segmentation::Task task{scan,
                          domain,
                          optional_real(c, "threshold-lower"),
                          optional_real(c, "threshold-upper"),
                          voxels_at(scan.grid, c.points("seeds")),
                          c.text("keep"),
                          0,
                          c.real("interval-sd")};
  task.neighbourhood_mm = optional_real(c, "neighbourhood-mm").value_or(3 * std::cbrt(scan.grid.voxel_mm3()));
  if (task.lower && task.upper && *task.lower > *task.upper)
    throw Failure(ExitCode::misuse, "the lower threshold is above the upper one", interval_text(*task.lower, *task.upper),
                  "exchange them");
  for (std::size_t s = 0; s < task.seeds.size(); ++s)
    if (!domain(task.seeds[s][0], task.seeds[s][1], task.seeds[s][2]))
      throw Failure(ExitCode::misuse, "seed " + std::to_string(s + 1) + " lies outside the box", "--seeds and --box",
                    "a larger box, or another seed");
  return task;
}

Cleaning cleaning_of(const Command& c, const Grid& grid, const std::vector<VoxelIndex>& seeds) {
  Cleaning cleaning{c.real("opening-mm"),
                    0,
                    Islands::largest,
                    c.real("minimum-mm3"),
                    c.text("holes") == "fill" ? Holes::fill : Holes::keep,
                    seeds};
  cleaning.closing_mm = optional_real(c, "closing-mm").value_or(std::cbrt(grid.voxel_mm3()));
  const std::string islands = c.text("islands");
  if (islands == "all") cleaning.islands = Islands::all;
  if (islands == "seeded" || (islands == "auto" && !seeds.empty())) cleaning.islands = Islands::seeded;
  if (islands == "seeded" && seeds.empty())
    throw Failure(ExitCode::misuse, "no seed says which island to keep", "--islands seeded", "--seeds x,y,z in mm");
  return cleaning;
}

void expect_something(const Scan& smooth, const segmentation::Choice& choice, const std::vector<CleaningStep>& steps) {
  const Statistics range = statistics_of(smooth.voxels);
  char intensities[100];
  std::snprintf(intensities, sizeof intensities, "intensities (smoothed) run from %.4g to %.4g", range.min, range.max);
  if (steps.front().voxels == 0)
    throw Failure(ExitCode::check_failed,
                  "nothing found: no voxel has an intensity of " + interval_text(choice.lower, choice.upper), intensities,
                  "other thresholds or another box");
  for (const auto& step : steps)
    if (step.voxels == 0)
      throw Failure(ExitCode::check_failed,
                    "nothing left once " + step.name + ", of " + std::to_string(steps.front().voxels) + " voxels found",
                    intensities, "a smaller --opening-mm or --minimum-mm3, or a seed further inside the organ");
}

Json statistics_json(const Statistics& s) { return {{"mean", s.mean}, {"sd", s.sd}, {"min", s.min}, {"max", s.max}}; }

/// "uterus,tube,ovary" in pieces, one for each of --part-seeds.
std::vector<std::string> part_names(const Command& c) {
  std::vector<std::string> names;
  std::istringstream list(c.has("part-names") ? c.text("part-names") : "");
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  if (names.size() != c.points("part-seeds").size())
    throw Failure(ExitCode::misuse, std::to_string(c.points("part-seeds").size()) + " parts have a seed, " + std::to_string(names.size()) + " a name",
                  "--part-seeds and --part-names", "--part-seeds x,y,z x,y,z --part-names uterus,tube");
  return names;
}

/// The organ's voxels with the label value; or, with parts, the first part with it and the others with those that follow.
Labels labelled(Command& c, const Scan& smooth, const Mask& mask) {
  const auto first = static_cast<std::uint16_t>(c.integer("label"));
  const auto names = part_names(c);
  Labels labels{smooth.grid, {mask.voxels.begin(), mask.voxels.end()}};
  Json label_names = {{std::to_string(first), c.text("label-name")}};
  if (!names.empty()) {
    const double reach_mm = optional_real(c, "neighbourhood-mm").value_or(3 * std::cbrt(smooth.grid.voxel_mm3()));
    labels = divided(smooth, mask, voxels_at(smooth.grid, c.points("part-seeds")), reach_mm);
    std::vector<std::size_t> counts(names.size() + 1, 0);
    for (auto voxel : labels.voxels) ++counts[voxel];
    label_names = Json::object();
    Json volumes = Json::object();
    std::size_t divided_voxels = 0;
    for (std::size_t p = 0; p < names.size(); ++p) {
      label_names[std::to_string(first + p)] = names[p];
      volumes[names[p]] = counts[p + 1] * smooth.grid.voxel_mm3();
      divided_voxels += counts[p + 1];
    }
    c.note("part_volumes_mm3", volumes);
    c.check(check_equal("voxels that no part reaches", static_cast<double>(count_inside(mask) - divided_voxels), 0));
  }
  for (auto& voxel : labels.voxels)
    if (voxel) voxel = static_cast<std::uint16_t>(voxel + first - 1);
  c.note("label_names", label_names);
  return labels;
}

void record(Command& c, const LabelFacts& facts, const Grid& grid) {
  c.note("voxels", facts.voxels);
  c.note("voxel_spacing_mm", grid.spacing());
  c.note("volume_mm3", facts.volume_mm3);
  c.note("box_mm", facts.box_mm);
  c.note("centre_mm", facts.centre_mm);
  c.note("pieces", facts.pieces);
  c.note("intensity", {{"inside", statistics_json(facts.inside)}, {"outside", statistics_json(facts.outside)}});
  c.check(check_at_least("label voxels", static_cast<double>(facts.voxels), 1));
  c.check(check_at_most("part of the scan that is label", facts.fraction_of_scan, 0.9));
  if (c.text("islands") != "all") {
    const std::size_t most = std::max<std::size_t>(1, c.points("seeds").size());
    c.check(check_at_most("pieces", static_cast<double>(facts.pieces), static_cast<double>(most)));
  }
  for (int axis : facts.touched_axes)
    c.warn(std::string("the label reaches the scan's border along voxel axis ") + "ijk"[axis] +
           ": the organ may be cut off, or more than the organ was taken");
}

SheetText sheet_text(const Command& c, const LabelFacts& facts, const std::string& how, const Grid& grid) {
  char volume[120], size[120], voxel[120];
  std::snprintf(volume, sizeof volume, "%.*f mm^3 = %.4g mL, %zu voxels, %zu piece%s", facts.volume_mm3 < 1000 ? 1 : 0,
                facts.volume_mm3, facts.volume_mm3 / 1000, facts.voxels, facts.pieces, facts.pieces == 1 ? "" : "s");
  const Vec3 extent = facts.box_mm[1] - facts.box_mm[0], h = grid.spacing();
  std::snprintf(size, sizeof size, "%.3g x %.3g x %.3g mm (x, y, z)", extent[0], extent[1], extent[2]);
  std::snprintf(voxel, sizeof voxel, "voxels %.3g x %.3g x %.3g mm", h[0], h[1], h[2]);
  return {c.text("label-name") + " (" + std::to_string(c.integer("label")) + ")", {volume, size, voxel, how}};
}

}  // namespace

void usage(Usage& u) {
  u.name = "segment";
  u.sentence = "Finds the voxels of one organ in a scan and draws a contact sheet that shows whether they are right.";
  u.details =
      "The scan is smoothed, a method chooses voxels within the box, opening cuts thin bridges, islands are kept or dropped, "
      "closing and filling mend "
      "gaps and holes; what is found may be divided into parts by their intensities. Without options: a calm Gaussian, Otsu's threshold, the largest piece. Look at the sheet before going on.";
  u.input("scan", "scan.nii.gz", "the scan");
  u.output("labels", "labels.nii.gz", "labels on the scan's voxels: the organ has the label value, all else 0");
  u.side_output("sheet", "labels", ".sheet.png", "slices with the label's contour");
  u.choice("method", "auto", names_of(segmentation::all(), {"auto"}),
           "how voxels are chosen; auto: region_growing when there are seeds, threshold when there is a threshold, else otsu");
  u.real("threshold-lower", {}, "1", {}, "lowest intensity of the organ (after smoothing)");
  u.real("threshold-upper", {}, "1", {}, "highest intensity of the organ (after smoothing)");
  u.choice("keep", "bright", {"bright", "dark"}, "the side of otsu's threshold that is the organ");
  u.points("seeds", "a point in the organ, patient LPS");
  u.real("neighbourhood-mm", {}, "mm", {0, 1000},
         "radius around a seed whose intensities say what to grow into; three voxels when not given");
  u.real("interval-sd", 2.5, "1", {0, 100}, "half width of that interval, in standard deviations");
  u.points("box", "two opposite corners of a box the organ lies in, patient LPS; nothing outside is chosen");
  u.choice("smoothing", "gaussian", names_of(smoothing::all()), "the filter that calms the scan first");
  u.real("smoothing-mm", {}, "mm", {0, 1000}, "reach of the filter; 0.7 voxels when not given");
  u.real("smoothing-intensity", {}, "1", {0, 1e9},
         "bilateral only: intensity steps above it are edges; three times the noise when not given");
  u.real("opening-mm", 0, "mm", {0, 1000}, "radius of the ball that cuts bridges and spikes thinner than itself");
  u.choice("islands", "auto", {"auto", "largest", "seeded", "all"},
           "pieces to keep; auto: those with a seed, the largest when there are no seeds");
  u.real("minimum-mm3", 0, "mm3", {0, 1e12}, "pieces smaller than this are dropped");
  u.real("closing-mm", {}, "mm", {0, 1000}, "radius of the ball that closes gaps narrower than itself; one voxel when not given");
  u.choice("holes", "fill", {"fill", "keep"}, "what happens to holes the organ encloses");
  u.integer("label", 1, {1, 65535}, "value of the organ's voxels");
  u.text("label-name", "organ", "name of the organ");
  u.points("part-seeds", "a point in each part of the organ whose intensity tells it from the others, patient LPS; the parts get labels of their own");
  u.text("part-names", std::nullopt, "names of these parts, as in uterus,tube,ovary");
  u.catalogue = [] {
    std::vector<CatalogueEntry> entries;
    for (const auto& method : segmentation::all()) entries.push_back(method.about);
    for (const auto& filter : smoothing::all()) entries.push_back(filter.about);
    return entries;
  };
}

void run(Command& c) {
  use_image_threads(c.threads());
  const Scan scan = read_scan(c.input("scan"));
  const Mask domain = box_mask(scan.grid, c.points("box"));
  const auto filter = smoothing::by_name(c.text("smoothing"));
  const double width_mm = optional_real(c, "smoothing-mm").value_or(smoothing::default_width_mm(scan.grid));
  const Scan smooth = filter.apply(scan, {width_mm, optional_real(c, "smoothing-intensity")});

  const auto task = task_of(c, smooth, domain);
  const auto method = segmentation::by_name(method_of(c));
  const auto choice = method.choose(task);
  std::vector<CleaningStep> steps;
  const Mask mask = cleaned(choice.mask, cleaning_of(c, scan.grid, task.seeds), steps);
  expect_something(smooth, choice, steps);

  write_labels(c.output("labels"), labelled(c, smooth, mask));

  const LabelFacts facts = label_facts(scan, mask);
  const std::string how = method.about.name + ", intensity " + interval_text(choice.lower, choice.upper);
  write_text(c.output("sheet"), contact_sheet_png(scan, mask, sheet_text(c, facts, how, scan.grid)));
  c.note("method",
         {{"name", method.about.name}, {"lower", finite_or_null(choice.lower)}, {"upper", finite_or_null(choice.upper)}});
  c.note("smoothing_mm", width_mm);
  Json cleaning = Json::object();
  for (const auto& step : steps) cleaning[step.name] = step.voxels;
  c.note("voxels_after", cleaning);
  record(c, facts, scan.grid);
  c.say(c.text("label-name") + ": " + std::to_string(facts.voxels) + " voxels, " + std::to_string(std::lround(facts.volume_mm3)) +
        " mm3");
}

// Card notes of palpate-surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/notes.hpp>

#include <cmath>
#include <sstream>

#include <pipeline/surface/measure.hpp>

namespace palpate {
namespace {

double rounded(double x) { return std::round(x * 1e4) / 1e4 + 0.0; }  // no "-0.0"

Json pieces_json(const std::vector<Piece>& pieces) {
  Json list = Json::array();
  for (const Piece& piece : pieces) {
    if (list.size() == 20) break;  // the largest tell enough
    const Vec3& x = piece.centre_mm;
    list.push_back(
        {{"mm3", rounded(piece.mm3)}, {"voxels", piece.voxels}, {"centre_mm", {rounded(x[0]), rounded(x[1]), rounded(x[2])}}});
  }
  return list;
}

double total_mm3(const std::vector<Piece>& pieces) {
  double sum = 0;
  for (const Piece& piece : pieces) sum += piece.mm3;
  return sum;
}

std::string amount(const std::vector<Piece>& pieces, double of_mm3) {
  std::ostringstream text;
  text.precision(2);
  text << pieces.size() << " (" << total_mm3(pieces) << " mm3, " << 100 * total_mm3(pieces) / of_mm3
       << " % of the organ; the largest at " << place_text(pieces[0].centre_mm) << ")";
  return text.str();
}

Json repair_json(const RepairLedger& repair) {
  Json holes = Json::array();
  for (const Hole& hole : repair.holes)
    holes.push_back({{"edges", hole.edges}, {"across_mm", rounded(hole.across_mm)}, {"at", place_text(hole.centre_mm)}});
  return {{"points_read", repair.points_in},
          {"triangles_read", repair.triangles_in},
          {"points_mended", repair.points_mended},
          {"triangles_mended", repair.triangles_mended},
          {"holes_closed", holes}};
}

void note_shape(Command& command, const Surface& written, const SurfaceLedger& ledger) {
  Json components = Json::array();
  for (const Shell& shell : shells(written))
    components.push_back({{"mm3", rounded(shell.volume_mm3)},
                          {"mm2", rounded(shell.area_mm2)},
                          {"genus", shell.genus},
                          {"triangles", shell.triangles.size()}});
  command.note("components", components);
  Json regions = Json::object();
  for (const auto& [region, name] : written.region_names) regions[std::to_string(region)] = name;
  command.note("region_names", regions);
  const Angles found = angles(written);
  command.note("triangles", written.triangles.size());
  command.note("points", written.points.size());
  command.note("area_mm2", rounded(area_mm2(written)));
  command.note("edge_mm", rounded(ledger.edge_mm));
  command.note("smooth_mm", {rounded(ledger.sigma_mm[0]), rounded(ledger.sigma_mm[1]), rounded(ledger.sigma_mm[2])});
  command.note("lattice_mm", rounded(ledger.step_mm));
  command.note("volume_restoring_offset_mm", rounded(ledger.offset_mm));
  command.note("angles_deg", {{"smallest", rounded(found.min_deg)},
                              {"largest", rounded(found.max_deg)},
                              {"sharpest_fold", rounded(found.min_fold_deg)},
                              {"sharpest_fold_at", place_of_triangle(written, found.fold_triangle)}});
}

}  // namespace

std::set<int> label_list(const std::string& text) {
  std::set<int> labels;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    if (part.empty() || part.size() > 5 || part.find_first_not_of("0123456789") != std::string::npos || std::stoi(part) < 1 ||
        std::stoi(part) > 65535)
      throw Failure(ExitCode::misuse, "not a label: " + part, "--labels", "whole numbers from 1 to 65535, as in 1,2");
    labels.insert(std::stoi(part));
  }
  if (labels.empty()) throw Failure(ExitCode::misuse, "no label given", "--labels", "whole numbers from 1 to 65535, as in 1,2");
  return labels;
}

RegionNames region_names(Command& command, const Surface& surface) {
  RegionNames names = surface.region_names;
  for (int region : surface.triangle_region) names.try_emplace(region, "label_" + std::to_string(region));
  const auto card = card_path(command.input("shape"));
  if (!std::filesystem::is_regular_file(card)) return names;
  const Json notes = read_json(card).value("notes", Json::object());
  if (!notes.contains("label_names") || !notes["label_names"].is_object()) return names;
  command.add_input("names of the labels", card);
  for (auto& [region, name] : names) name = notes["label_names"].value(std::to_string(region), name);
  return names;
}

void note_surface(Command& command, const Surface& written, const SurfaceLedger& ledger) {
  const double final_mm3 = volume_mm3(written);
  const bool from_labels = ledger.voxels_mm3 > 0;
  Json volumes = {{"raw_surface_mm3", rounded(ledger.raw_mm3)},
                  {"final_surface_mm3", rounded(final_mm3)},
                  {"final_against_raw", rounded(final_mm3 / ledger.raw_mm3 - 1)}};
  if (from_labels)
    volumes.update({{"voxels_mm3", rounded(ledger.voxels_mm3)},
                    {"raw_against_voxels", rounded(ledger.raw_mm3 / ledger.voxels_mm3 - 1)},
                    {"final_against_voxels", rounded(final_mm3 / ledger.voxels_mm3 - 1)},
                    {"dropped_pieces_mm3", rounded(total_mm3(ledger.mask.dropped))},
                    {"filled_cavities_mm3", rounded(total_mm3(ledger.mask.filled))},
                    {"dropped_crumbs_mm3", rounded(ledger.crumbs_mm3)}});
  command.note("volume_ledger", volumes);
  if (from_labels)
    command.note("pieces", {{"kept", pieces_json(ledger.mask.kept)},
                            {"dropped", pieces_json(ledger.mask.dropped)},
                            {"filled", pieces_json(ledger.mask.filled)}});
  else
    command.note("repair", repair_json(ledger.repair));
  note_shape(command, written, ledger);
}

std::vector<std::string> warnings(const SurfaceLedger& ledger) {
  std::vector<std::string> all;
  if (!ledger.mask.dropped.empty()) all.push_back("small pieces dropped: " + amount(ledger.mask.dropped, ledger.voxels_mm3));
  if (!ledger.mask.filled.empty()) all.push_back("cavities filled: " + amount(ledger.mask.filled, ledger.voxels_mm3));
  for (const std::string& attempt : ledger.attempts) all.push_back("tried again with more smoothing: " + attempt);
  for (const Hole& hole : ledger.repair.holes)
    all.push_back("hole closed: " + std::to_string(hole.edges) + " edges around " + place_text(hole.centre_mm));
  if (ledger.cut) all.push_back("the labels reach the edge of the volume: the organ is cut there, and the surface closed");
  return all;
}

}  // namespace palpate

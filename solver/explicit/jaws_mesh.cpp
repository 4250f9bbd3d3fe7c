// Blocks cut evenly along their three edges; nodes in VTK's order of a hexahedron.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/jaws_mesh.hpp>

#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace palpate::explicit_shell {
namespace {

using Eigen::Vector3d;

struct Text {
  std::ostringstream points, connectivity, offsets, types, region, mass;
  int nodes = 0, cells = 0;
};

void add_block(Text& text, const Vector3d* corner, int number, double edge, double mass) {
  const std::array<Vector3d, 3> side = {corner[1] - corner[0], corner[2] - corner[0], corner[4] - corner[0]};
  std::array<int, 3> n;
  for (int a : {0, 1, 2}) n[a] = std::max(1, static_cast<int>(std::ceil(side[a].norm() / edge - 1e-9)));
  const auto node = [&](int i, int j, int k) { return text.nodes + (k * (n[1] + 1) + j) * (n[0] + 1) + i; };
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        for (int top : {k, k + 1}) text.connectivity << node(i, j, top) << ' ' << node(i + 1, j, top) << ' ' << node(i + 1, j + 1, top) << ' ' << node(i, j + 1, top) << ' ';
        text.offsets << 8 * ++text.cells << ' ';
        text.types << "12 ";
        text.region << number << ' ';
        text.mass << mass / (n[0] * n[1] * n[2]) << ' ';
      }
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i, ++text.nodes) {
        const Vector3d x = corner[0] + side[0] * i / n[0] + side[1] * j / n[1] + side[2] * k / n[2];
        text.points << x[0] << ' ' << x[1] << ' ' << x[2] << ' ';
      }
}

/// VTK writes text as the numbers of its letters, each text ended by 0.
std::string letters(const char* name, const std::vector<std::string>& texts) {
  std::ostringstream out;
  out << "      <Array type=\"String\" Name=\"" << name << "\" NumberOfTuples=\"" << texts.size() << "\" format=\"ascii\">";
  for (const std::string& text : texts) {
    for (unsigned char c : text) out << static_cast<int>(c) << ' ';
    out << "0 ";
  }
  out << "</Array>\n";
  return out.str();
}

}  // namespace

std::string blocks_as_vtu(const std::vector<Vector3d>& corners, double edge, double mass) {
  Text text;
  text.points << std::setprecision(12);
  text.mass << std::setprecision(12);
  for (std::size_t b = 0; b + 8 <= corners.size(); b += 8) {
    const bool left_handed = (corners[b + 1] - corners[b]).cross(corners[b + 2] - corners[b]).dot(corners[b + 4] - corners[b]) < 0;
    std::array<Vector3d, 8> own;
    for (int k = 0; k < 8; ++k) own[k] = corners[b + (left_handed ? k ^ 1 : k)];  // a hexahedron has a positive volume
    add_block(text, own.data(), static_cast<int>(b / 8) + 1, edge, mass);
  }
  const auto array = [](const char* type, const char* name, const char* more, const std::ostringstream& values) {
    return std::string("        <DataArray type=\"") + type + "\" Name=\"" + name + "\"" + more + " format=\"ascii\">" + values.str() + "</DataArray>\n";
  };
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <UnstructuredGrid>\n    <FieldData>\n" + letters("SPACE", {"LPS"}) +
         letters("UNITS", {"mm"}) + letters("REGION_NAMES", {"1=upper_jaw", "2=lower_jaw"}) + "    </FieldData>\n    <Piece NumberOfPoints=\"" + std::to_string(text.nodes) +
         "\" NumberOfCells=\"" + std::to_string(text.cells) + "\">\n      <Points>\n" + array("Float64", "points", " NumberOfComponents=\"3\"", text.points) + "      </Points>\n      <Cells>\n" +
         array("Int32", "connectivity", "", text.connectivity) + array("Int32", "offsets", "", text.offsets) + array("UInt8", "types", "", text.types) + "      </Cells>\n      <CellData>\n" +
         array("Int32", "region", "", text.region) + array("Float64", "mass", "", text.mass) + "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace palpate::explicit_shell

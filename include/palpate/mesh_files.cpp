// .vtp and .vtu by VTK's readers and writers.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/mesh_files.hpp>

#include <vtkCellData.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

[[noreturn]] void unreadable(const std::filesystem::path& path, const std::string& what, const std::string& next = "") {
  throw Failure(ExitCode::unreadable, what, path.string(), next);
}

vtkSmartPointer<vtkPoints> to_vtk(const std::vector<Vec3>& points) {
  auto vtk_points = vtkSmartPointer<vtkPoints>::New();
  vtk_points->SetDataTypeToDouble();
  vtk_points->SetNumberOfPoints(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) vtk_points->SetPoint(i, points[i].data());
  return vtk_points;
}

void add_text(vtkDataObject& data, const char* name, const std::vector<std::string>& values) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const auto& value : values) array->InsertNextValue(value);
  data.GetFieldData()->AddArray(array);
}

void add_conventions(vtkDataObject& data, const RegionNames& names) {
  add_text(data, "SPACE", {"LPS"});
  add_text(data, "UNITS", {"mm"});
  std::vector<std::string> lines;
  for (const auto& [region, name] : names) lines.push_back(std::to_string(region) + "=" + name);
  if (!lines.empty()) add_text(data, "REGION_NAMES", lines);
}

RegionNames region_names_of(vtkDataObject& data) {
  RegionNames names;
  auto* lines = vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray("REGION_NAMES"));
  for (vtkIdType i = 0; lines && i < lines->GetNumberOfValues(); ++i) {
    const std::string line = lines->GetValue(i);
    const auto equals = line.find('=');
    if (equals != std::string::npos) names[std::atoi(line.c_str())] = line.substr(equals + 1);
  }
  return names;
}

/// A file brought from elsewhere may say that it is not ours: RAS would be a mirrored organ.
void expect_conventions(vtkDataObject& data, const std::filesystem::path& path) {
  for (const auto& [name, ours] : {std::pair{"SPACE", "LPS"}, std::pair{"UNITS", "mm"}}) {
    auto* text = vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray(name));
    if (text && text->GetNumberOfValues() > 0 && text->GetValue(0) != ours)
      unreadable(path, std::string(name) + " is " + text->GetValue(0) + ", not " + ours, "convert it to patient LPS in mm");
  }
}

std::vector<Vec3> points_of(vtkPointSet& data, const std::filesystem::path& path) {
  std::vector<Vec3> points(data.GetNumberOfPoints());
  for (std::size_t i = 0; i < points.size(); ++i) {
    data.GetPoint(i, points[i].data());
    if (!std::isfinite(dot(points[i], points[i]))) unreadable(path, "point " + std::to_string(i) + " is not finite");
  }
  return points;
}

template <std::size_t N>
std::array<int, N> corners(const vtkIdType* ids, std::size_t points, vtkIdType cell, const std::filesystem::path& path) {
  std::array<int, N> corner{};
  for (std::size_t i = 0; i < N; ++i) {
    if (ids[i] < 0 || std::size_t(ids[i]) >= points)
      unreadable(path, "cell " + std::to_string(cell) + " names a point that is not there");
    corner[i] = static_cast<int>(ids[i]);
  }
  return corner;
}

vtkSmartPointer<vtkIntArray> region_array(const std::vector<int>& first, const std::vector<int>& second, std::size_t cells) {
  auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName("region");
  array->SetNumberOfValues(cells);
  array->FillValue(0);
  vtkIdType cell = 0;
  for (const auto* list : {&first, &second})
    for (int region : *list) array->SetValue(cell++, region);
  return array;
}

std::vector<int> cell_regions(vtkDataSet& data) {
  std::vector<int> regions(data.GetNumberOfCells(), 0);
  if (auto* array = data.GetCellData()->GetArray("region"))
    for (std::size_t i = 0; i < regions.size(); ++i) regions[i] = static_cast<int>(array->GetTuple1(i));
  return regions;
}

vtkSmartPointer<vtkDoubleArray> to_vtk(const Field& field, std::size_t tuples) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(field.name.c_str());
  array->SetNumberOfComponents(field.components);
  array->SetNumberOfTuples(tuples);
  array->FillValue(0);
  for (std::size_t i = 0; i < field.values.size(); ++i) array->SetValue(i, field.values[i]);
  return array;
}

Field from_vtk(vtkDataArray& array, std::size_t tuples) {
  Field field{array.GetName() ? array.GetName() : "", array.GetNumberOfComponents(), {}};
  for (std::size_t i = 0; i < tuples; ++i)
    for (int c = 0; c < field.components; ++c) field.values.push_back(array.GetComponent(i, c));
  return field;
}

/// VTK reads what there is of a truncated file and says nothing: look for the end.
void expect_whole(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg(), tail = std::min<std::streamoff>(size, 64);
  std::string end(std::max<std::streamoff>(tail, 0), ' ');
  file.seekg(-tail, std::ios::end);
  file.read(end.data(), tail);
  if (!file || end.find("</VTKFile>") == std::string::npos)
    unreadable(path, "truncated: the end of the file is missing", "copy it again");
}

/// Hears what VTK's readers complain about: of a damaged array they set no error code, they leave it out.
class Complaints : public vtkOutputWindow {
 public:
  static Complaints* New();
  vtkTypeMacro(Complaints, vtkOutputWindow);
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char*) override { ++errors; }
  int errors = 0;
};
vtkStandardNewMacro(Complaints);

/// Reads as VTK does; true when it did so without a complaint.
bool read_quietly(vtkXMLReader& reader) {
  vtkNew<Complaints> complaints;
  const vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkOutputWindow::SetInstance(complaints);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkObject::GlobalWarningDisplayOn();
  reader.Update();
  vtkObject::GlobalWarningDisplayOff();
  vtkOutputWindow::SetInstance(before);
  return complaints->errors == 0 && reader.GetErrorCode() == 0;
}

template <class Reader>
vtkSmartPointer<Reader> open_reader(const std::filesystem::path& path, const char* format) {
  if (!std::filesystem::is_regular_file(path)) unreadable(path, "no such file");
  auto reader = vtkSmartPointer<Reader>::New();
  vtkObject::GlobalWarningDisplayOff();
  if (!reader->CanReadFile(path.c_str())) unreadable(path, std::string("not a ") + format + " file");
  expect_whole(path);
  reader->SetFileName(path.c_str());
  if (!read_quietly(*reader)) unreadable(path, "damaged");
  return reader;
}

template <class Writer, class Data>
void write_vtk(const std::filesystem::path& path, Data& data) {
  vtkNew<Writer> writer;
  vtkObject::GlobalWarningDisplayOff();
  writer->SetFileName(path.c_str());
  writer->SetInputData(&data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  if (writer->Write() != 1 || writer->GetErrorCode() != 0)
    throw Failure(ExitCode::unreadable, "cannot write the file", path.string(), "check free space (df -h) and permissions");
}

}  // namespace

Surface read_surface(const std::filesystem::path& path) {
  const auto reader = open_reader<vtkXMLPolyDataReader>(path, ".vtp");
  vtkPolyData& data = *reader->GetOutput();
  expect_conventions(data, path);
  Surface surface;
  surface.points = points_of(data, path);
  for (vtkIdType cell = 0; cell < data.GetNumberOfCells(); ++cell) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    data.GetCellPoints(cell, count, ids);
    if (data.GetCellType(cell) != VTK_TRIANGLE)
      unreadable(path, "cell " + std::to_string(cell) + " is not a triangle", "triangulate the surface");
    surface.triangles.push_back(corners<3>(ids, surface.points.size(), cell, path));
  }
  if (surface.triangles.empty()) unreadable(path, "no triangles");
  surface.triangle_region = cell_regions(data);
  surface.region_names = region_names_of(data);
  return surface;
}

void write_surface(const std::filesystem::path& path, const Surface& surface, const std::vector<Field>& point_fields) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(to_vtk(surface.points));
  vtkNew<vtkCellArray> cells;
  for (const auto& t : surface.triangles) {
    const vtkIdType ids[3] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, ids);
  }
  data->SetPolys(cells);
  data->GetCellData()->AddArray(region_array(surface.triangle_region, {}, surface.triangles.size()));
  for (const auto& field : point_fields) data->GetPointData()->AddArray(to_vtk(field, surface.points.size()));
  add_conventions(*data, surface.region_names);
  write_vtk<vtkXMLPolyDataWriter>(path, *data);
}

TetMesh read_mesh(const std::filesystem::path& path) {
  const auto reader = open_reader<vtkXMLUnstructuredGridReader>(path, ".vtu");
  vtkUnstructuredGrid& data = *reader->GetOutput();
  expect_conventions(data, path);
  TetMesh mesh;
  mesh.points = points_of(data, path);
  const auto regions = cell_regions(data);
  for (vtkIdType cell = 0; cell < data.GetNumberOfCells(); ++cell) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    data.GetCellPoints(cell, count, ids);
    if (data.GetCellType(cell) == VTK_TETRA) {
      mesh.tets.push_back(corners<4>(ids, mesh.points.size(), cell, path));
      mesh.tet_region.push_back(regions[cell]);
    } else if (data.GetCellType(cell) == VTK_TRIANGLE) {
      mesh.faces.push_back(corners<3>(ids, mesh.points.size(), cell, path));
      mesh.face_region.push_back(regions[cell]);
    } else {
      unreadable(path, "cell " + std::to_string(cell) + " is neither a tetrahedron nor a triangle",
                 "palpate-mesh writes what is read here");
    }
  }
  if (mesh.tets.empty()) unreadable(path, "no tetrahedra");
  mesh.region_names = region_names_of(data);
  return mesh;
}

void write_mesh(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<Field>& point_fields,
                const std::vector<Field>& tet_fields) {
  vtkNew<vtkUnstructuredGrid> data;
  data->SetPoints(to_vtk(mesh.points));
  data->Allocate(mesh.tets.size() + mesh.faces.size());
  for (const auto& t : mesh.tets) {
    const vtkIdType ids[4] = {t[0], t[1], t[2], t[3]};
    data->InsertNextCell(VTK_TETRA, 4, ids);
  }
  for (const auto& f : mesh.faces) {
    const vtkIdType ids[3] = {f[0], f[1], f[2]};
    data->InsertNextCell(VTK_TRIANGLE, 3, ids);
  }
  const std::size_t cells = mesh.tets.size() + mesh.faces.size();
  data->GetCellData()->AddArray(region_array(mesh.tet_region, mesh.face_region, cells));
  for (const auto& field : point_fields) data->GetPointData()->AddArray(to_vtk(field, mesh.points.size()));
  for (const auto& field : tet_fields) data->GetCellData()->AddArray(to_vtk(field, cells));
  add_conventions(*data, mesh.region_names);
  write_vtk<vtkXMLUnstructuredGridWriter>(path, *data);
}

ShellMesh read_shells(const std::filesystem::path& path) {
  const auto reader = open_reader<vtkXMLUnstructuredGridReader>(path, ".vtu");
  vtkUnstructuredGrid& data = *reader->GetOutput();
  expect_conventions(data, path);
  ShellMesh mesh;
  mesh.points = points_of(data, path);
  mesh.triangle_region = cell_regions(data);
  for (vtkIdType cell = 0; cell < data.GetNumberOfCells(); ++cell) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    data.GetCellPoints(cell, count, ids);
    if (data.GetCellType(cell) != VTK_TRIANGLE)
      unreadable(path, "cell " + std::to_string(cell) + " is not a triangle", "palpate-mesh --kind shell writes thin walls");
    mesh.triangles.push_back(corners<3>(ids, mesh.points.size(), cell, path));
  }
  if (mesh.triangles.empty()) unreadable(path, "no triangles");
  auto* thickness = data.GetPointData()->GetArray("thickness");
  if (!thickness) unreadable(path, "the points have no thickness", "palpate-mesh --kind shell writes thin walls");
  auto* end = data.GetPointData()->GetArray("end");
  auto* direction = data.GetPointData()->GetArray("end_direction");
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    mesh.thickness_mm.push_back(thickness->GetTuple1(i));
    mesh.end.push_back(end ? static_cast<int>(end->GetTuple1(i)) : 0);
    mesh.end_direction.push_back(direction ? Vec3{direction->GetComponent(i, 0), direction->GetComponent(i, 1), direction->GetComponent(i, 2)} : Vec3{});
    if (!(mesh.thickness_mm.back() > 0)) unreadable(path, "point " + std::to_string(i) + " has no positive thickness");
  }
  mesh.region_names = region_names_of(data);
  return mesh;
}

void write_shells(const std::filesystem::path& path, const ShellMesh& mesh, const std::vector<Field>& point_fields,
                  const std::vector<Field>& triangle_fields) {
  TetMesh plain{mesh.points, {}, {}, mesh.triangles, mesh.triangle_region, mesh.region_names};
  std::vector<Field> on_points{{"thickness", 1, mesh.thickness_mm}, {"end", 1, {mesh.end.begin(), mesh.end.end()}}, {"end_direction", 3, {}}};
  for (const Vec3& d : mesh.end_direction) on_points.back().values.insert(on_points.back().values.end(), d.begin(), d.end());
  on_points.insert(on_points.end(), point_fields.begin(), point_fields.end());
  write_mesh(path, plain, on_points, triangle_fields);
}

MeshFields read_mesh_fields(const std::filesystem::path& path) {
  const auto reader = open_reader<vtkXMLUnstructuredGridReader>(path, ".vtu");
  vtkUnstructuredGrid& data = *reader->GetOutput();
  std::size_t tets = 0;
  while (tets < std::size_t(data.GetNumberOfCells()) && data.GetCellType(tets) == VTK_TETRA) ++tets;
  MeshFields fields;
  for (int i = 0; i < data.GetPointData()->GetNumberOfArrays(); ++i)
    if (auto* array = data.GetPointData()->GetArray(i)) fields.on_points.push_back(from_vtk(*array, data.GetNumberOfPoints()));
  for (int i = 0; i < data.GetCellData()->GetNumberOfArrays(); ++i)
    if (auto* array = data.GetCellData()->GetArray(i)) {
      Field all = from_vtk(*array, data.GetNumberOfCells());
      const auto first_of_faces = all.values.begin() + all.components * tets;
      fields.on_faces.push_back({all.name, all.components, {first_of_faces, all.values.end()}});
      all.values.erase(first_of_faces, all.values.end());
      fields.on_tets.push_back(std::move(all));
    }
  return fields;
}

}  // namespace palpate

// Copies into VTK's own containers.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/vtk_shapes.hpp>

#include <vtkCellArray.h>
#include <vtkCutter.h>
#include <vtkNew.h>
#include <vtkPlane.h>

namespace palpate {

vtkSmartPointer<vtkPoints> vtk_points(const std::vector<Vec3>& points) {
  auto list = vtkSmartPointer<vtkPoints>::New();
  list->SetDataTypeToDouble();
  list->SetNumberOfPoints(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) list->SetPoint(i, points[i].data());
  return list;
}

vtkSmartPointer<vtkPolyData> shape_of(const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& triangles) {
  auto shape = vtkSmartPointer<vtkPolyData>::New();
  shape->SetPoints(vtk_points(points));
  vtkNew<vtkCellArray> cells;
  for (const auto& t : triangles) {
    const vtkIdType ids[3] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, ids);
  }
  shape->SetPolys(cells);
  return shape;
}

vtkSmartPointer<vtkPolyData> lines_of(const std::vector<Vec3>& points, const std::vector<std::array<int, 2>>& pairs) {
  auto shape = vtkSmartPointer<vtkPolyData>::New();
  shape->SetPoints(vtk_points(points));
  vtkNew<vtkCellArray> cells;
  for (const auto& pair : pairs) {
    const vtkIdType ids[2] = {pair[0], pair[1]};
    cells->InsertNextCell(2, ids);
  }
  shape->SetLines(cells);
  return shape;
}

vtkSmartPointer<vtkDoubleArray> array_of(const char* name, const std::vector<double>& values) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  for (double value : values) array->InsertNextValue(value);
  return array;
}

vtkSmartPointer<vtkPolyData> cut(vtkDataSet& shape, const Vec3& origin, const Vec3& normal) {
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(origin.data());
  plane->SetNormal(normal.data());
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(&shape);
  cutter->SetCutFunction(plane);
  cutter->GenerateTrianglesOff();
  cutter->Update();
  return cutter->GetOutput();
}

}  // namespace palpate

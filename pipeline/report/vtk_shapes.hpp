// Shapes of this room's scenes as VTK has them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <palpate/vec3.hpp>

namespace palpate {

vtkSmartPointer<vtkPoints> vtk_points(const std::vector<Vec3>& points);
vtkSmartPointer<vtkPolyData> shape_of(const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& triangles);
/// Lines between pairs of points.
vtkSmartPointer<vtkPolyData> lines_of(const std::vector<Vec3>& points, const std::vector<std::array<int, 2>>& pairs);
vtkSmartPointer<vtkDoubleArray> array_of(const char* name, const std::vector<double>& values);
/// Polygons of a grid, lines of a surface; values come along.
vtkSmartPointer<vtkPolyData> cut(vtkDataSet& shape, const Vec3& origin, const Vec3& normal);

}  // namespace palpate

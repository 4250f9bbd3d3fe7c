# VTK: readers and writers of include/palpate (mesh_files.cpp), pictures of pipeline/report.
# Only these components: asking for all of VTK needs Qt.
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: vtk[A-Za-z0-9]*\.h
# Homes: include/palpate pipeline/report
set(VTK_RENDERING_COMPONENTS CommonColor CommonCore CommonDataModel CommonExecutionModel FiltersCore FiltersHybrid IOImage RenderingCore RenderingOpenGL2)
find_package(VTK REQUIRED COMPONENTS IOXML ${VTK_RENDERING_COMPONENTS} QUIET)
list(TRANSFORM VTK_RENDERING_COMPONENTS PREPEND VTK:: OUTPUT_VARIABLE VTK_RENDERING)

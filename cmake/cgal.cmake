# CGAL: predicates, halfedge mesh, polygon mesh processing.
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: CGAL/.*
# Homes: pipeline/surface
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL REQUIRED QUIET)

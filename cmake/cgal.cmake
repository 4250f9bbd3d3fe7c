# CGAL (kernel, surface mesh, polygon mesh processing). Home: pipeline/surface.
# SPDX-License-Identifier: GPL-3.0-or-later
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL REQUIRED QUIET)

# gmsh's C++ interface (Debian's 4.8.4: Delaunay and HXT, without Netgen and MMG).
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: gmsh\.h
# Homes: pipeline/mesh
find_path(GMSH_INCLUDE gmsh.h REQUIRED)
find_library(GMSH_LIBRARY gmsh REQUIRED)
add_library(palpate::gmsh INTERFACE IMPORTED)
target_include_directories(palpate::gmsh SYSTEM INTERFACE ${GMSH_INCLUDE})
target_link_libraries(palpate::gmsh INTERFACE ${GMSH_LIBRARY})

# Sparse symmetric indefinite factorisation over a threaded BLAS.
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: [ds]mumps_c\.h|cblas\.h
# Homes: solver/implicit
find_package(Threads REQUIRED)
find_path(MUMPS_INCLUDE dmumps_c.h REQUIRED)
find_library(MUMPS_LIBRARY dmumps_seq REQUIRED)
find_library(MUMPS_SINGLE_LIBRARY smumps_seq REQUIRED)
find_library(OPENBLAS_LIBRARY openblas REQUIRED)
find_path(CBLAS_INCLUDE openblas/cblas.h cblas.h HINTS /usr/include/${CMAKE_LIBRARY_ARCHITECTURE} REQUIRED)
add_library(palpate::mumps INTERFACE IMPORTED)
target_include_directories(palpate::mumps SYSTEM INTERFACE ${MUMPS_INCLUDE} ${CBLAS_INCLUDE})
target_link_libraries(palpate::mumps INTERFACE ${MUMPS_LIBRARY} ${MUMPS_SINGLE_LIBRARY} ${OPENBLAS_LIBRARY})

# NIfTI-1 reference library, and zlib under it (nifti.cpp).
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: nifti1_io\.h|zlib\.h
# Homes: include/palpate
find_path(NIFTI_INCLUDE nifti1_io.h PATH_SUFFIXES nifti REQUIRED)
find_library(NIFTI_LIBRARY niftiio REQUIRED)
find_library(ZNZ_LIBRARY znz REQUIRED)
find_package(ZLIB REQUIRED)
add_library(palpate::nifti INTERFACE IMPORTED)
target_include_directories(palpate::nifti SYSTEM INTERFACE ${NIFTI_INCLUDE})
target_link_libraries(palpate::nifti INTERFACE ${NIFTI_LIBRARY} ${ZNZ_LIBRARY} ZLIB::ZLIB)
target_compile_definitions(palpate::nifti INTERFACE HAVE_ZLIB)

# DICOM. Debian's GDCMConfig.cmake asks for VTK's bindings too, so the libraries are looked up by name.
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: gdcm[A-Za-z0-9]*\.h
# Homes: pipeline/image
find_path(GDCM_INCLUDE gdcmReader.h PATH_SUFFIXES gdcm-3.0 REQUIRED)
add_library(palpate::gdcm INTERFACE IMPORTED)
target_include_directories(palpate::gdcm SYSTEM INTERFACE ${GDCM_INCLUDE})
foreach(part MSFF DSED DICT IOD Common)
  find_library(GDCM_${part}_LIBRARY gdcm${part} REQUIRED)
  target_link_libraries(palpate::gdcm INTERFACE ${GDCM_${part}_LIBRARY})
endforeach()

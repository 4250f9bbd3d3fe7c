# OpenCV: smoothing, drawing, PNG.
# Found by hand: Debian's OpenCVConfig.cmake comes with libopencv-dev only, which pulls in VTK, Qt and a compiler or two.
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: opencv2/[a-z0-9_/]+\.hpp
# Homes: pipeline/image
find_path(OPENCV_INCLUDE opencv2/imgproc.hpp PATH_SUFFIXES opencv4 REQUIRED)
add_library(palpate::opencv INTERFACE IMPORTED)
target_include_directories(palpate::opencv SYSTEM INTERFACE ${OPENCV_INCLUDE})
foreach(part core imgproc imgcodecs)
  find_library(OPENCV_${part} opencv_${part} REQUIRED)
  target_link_libraries(palpate::opencv INTERFACE ${OPENCV_${part}})
endforeach()

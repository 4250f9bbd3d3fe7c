# Ordering of sparse equations by nested dissection.
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: metis\.h
# Homes: solver/implicit
find_path(METIS_INCLUDE metis.h REQUIRED)
find_library(METIS_LIBRARY metis REQUIRED)
add_library(palpate::metis INTERFACE IMPORTED)
target_include_directories(palpate::metis SYSTEM INTERFACE ${METIS_INCLUDE})
target_link_libraries(palpate::metis INTERFACE ${METIS_LIBRARY})

# Dense linear algebra.
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: Eigen/.*
# Homes: solver loop
find_package(Eigen3 REQUIRED)

# Dense linear algebra. Homes: solver, loop.
# SPDX-License-Identifier: GPL-3.0-or-later
find_package(Eigen3 REQUIRED)

# The libraries of include/palpate.
# SPDX-License-Identifier: GPL-3.0-or-later
include(cli11)
include(tomlplusplus)
include(nlohmann_json)
include(openssl)
include(nifti)
include(vtk)

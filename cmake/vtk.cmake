# VTK. Homes: include/palpate (mesh_files.cpp: readers and writers), pipeline/report (pictures).
# Only these components: asking for all of VTK needs Qt.
# SPDX-License-Identifier: GPL-3.0-or-later
find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel IOXML QUIET)

# JSON (json.hpp is its one door).
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: nlohmann/.*
# Homes: include/palpate
find_package(nlohmann_json REQUIRED)

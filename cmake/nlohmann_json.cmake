# JSON. Home: include/palpate (json.hpp is its one door).
# SPDX-License-Identifier: GPL-3.0-or-later
find_package(nlohmann_json REQUIRED)

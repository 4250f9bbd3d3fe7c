# SHA-256. Home: include/palpate (card.cpp).
# SPDX-License-Identifier: GPL-3.0-or-later
find_package(OpenSSL REQUIRED COMPONENTS Crypto)

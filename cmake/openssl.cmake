# SHA-256 (card.cpp).
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: openssl/.*
# Homes: include/palpate
find_package(OpenSSL REQUIRED COMPONENTS Crypto)

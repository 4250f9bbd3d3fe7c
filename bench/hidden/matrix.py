#!/usr/bin/env python3
# Adds up counts of calibrate.py (--json) and writes them as tables: rates with their targets, and the confusion matrix, hidden against named.
# SPDX-License-Identifier: GPL-3.0-or-later
#   matrix.py COUNTS.json ... > tables.md
import json
import math
import sys

ASKED = {"false alarms on nulls": "≤ 2 % of 400", "detected": "≥ 90 %", "first named is right, of the detected": "≥ 95 %", "truth in the reported set, of the detected": "≥ 99 %",
         "single right verdict, of all": "≥ 70 %", "single wrong verdict, of all": "≤ 2 %", "pairs: both named": "≥ 80 % of 100", "pairs: no wrong name": "≥ 95 %",
         "outside the catalogue, called unexplained": "≥ 90 %", "95 % intervals that hold the truth": "90–98 %"}


def wilson(k, n):
    z, p = 1.96, k / n
    middle, half = p + z * z / (2 * n), z * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return f"{100 * max(middle - half, 0) / (1 + z * z / n):.1f}–{100 * min(middle + half, 1 + z * z / n) / (1 + z * z / n):.1f} %"


def added(files):
    counts, verdicts = {}, {}
    for file in files:
        for name, (k, n) in file["counts"].items():
            old = counts.get(name, (0, 0))
            counts[name] = (old[0] + k, old[1] + n)
        for hidden, said in file["verdicts"].items():
            row = verdicts.setdefault(hidden.split(",")[0], {})
            for verdict, times in said.items():
                row[verdict] = row.get(verdict, 0) + times
    return counts, verdicts


def named(verdict):
    """The first set of a verdict, or its kind; an asterisk where others are left."""
    kind, _, sets = verdict.partition(": ")
    first = sets.split(" or ")[0]
    return (first + ("*" if " or " in sets else "")) if sets else kind


def main():
    counts, verdicts = added([json.load(open(path)) for path in sys.argv[1:]])
    print("| what | measured | asked |\n|---|---|---|")
    for name, (k, n) in counts.items():
        if n:
            print(f"| {name} | {k} of {n} ({wilson(k, n)}) | {ASKED.get(name, '')} |")
    table = {hidden: {} for hidden in verdicts}
    for hidden, said in verdicts.items():
        for verdict, times in said.items():
            table[hidden][named(verdict)] = table[hidden].get(named(verdict), 0) + times
    single = {h: row for h, row in table.items() if " + " not in h}
    columns = sorted({c for row in single.values() for c in row})
    print("\nHidden (rows) against named first (columns); * in a set of several.\n\n| | " + " | ".join(columns) + " |\n|---" + "|---" * len(columns) + "|")
    for hidden, row in single.items():
        print(f"| {hidden} | " + " | ".join(str(row.get(c, "·")) for c in columns) + " |")
    print("\n| pair hidden | named |\n|---|---|")
    for hidden, row in table.items():
        if " + " in hidden:
            print(f"| {hidden} | {'; '.join(f'{n} × {what}' for what, n in row.items())} |")


main()

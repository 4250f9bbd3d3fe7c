#!/usr/bin/env python3
# Runs the loop on sets with hidden effects (make.py) and counts: false alarms, detection, right names, size of the reported set, errors.
# Answers are written and hashed before the loop sees a set. Every rate comes with its number of sets and a binomial interval.
# SPDX-License-Identifier: GPL-3.0-or-later
#   calibrate.py LOOP FOLDER --nulls N --effects a,b,c --sizes 5 --each N [--protocol short] [--repeatability 1] [--null-sets 1000]
import argparse
import hashlib
import json
import math
import pathlib
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent


def interval(k, n):
    """Wilson 1927, 95 %."""
    if n == 0:
        return "–"
    z, p = 1.96, k / n
    middle, half = p + z * z / (2 * n), z * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return f"{100 * p:.1f} % of {n} ({100 * (middle - half) / (1 + z * z / n):.1f}–{100 * (middle + half) / (1 + z * z / n):.1f})"


def make(folder, answers, **options):
    words = [f"--{k}={v}" for k, v in options.items()]
    subprocess.run([sys.executable, here / "make.py", folder, f"--answers={answers}", *words], check=True)


def plan(a):
    for i in range(a.nulls):
        yield f"n{i:04d}", {"effect": "none", "seed": 100000 + a.seed + i}
    for size in a.sizes.split(","):
        for effect in filter(None, a.effects.split(",")):
            for i in range(a.each):
                yield f"{effect.replace('+', '-')}_{size}_{i}", {"effect": effect, "size": size, "seed": 200000 + a.seed + 1000 * i + sum(map(ord, effect))}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("loop")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--nulls", type=int, default=0)
    parser.add_argument("--effects", default="")
    parser.add_argument("--sizes", default="5")
    parser.add_argument("--each", type=int, default=1)
    parser.add_argument("--protocol", default="short")
    parser.add_argument("--repeatability", default="1")
    parser.add_argument("--null-sets", default="1000")
    parser.add_argument("--seed", type=int, default=0)
    a = parser.parse_args()
    a.folder.mkdir(parents=True)
    answers = a.folder / "answers.jsonl"
    for name, options in plan(a):
        make(a.folder / name, answers, protocol=a.protocol, repeatability=a.repeatability, **options)
    truths = [json.loads(line) for line in answers.read_text().splitlines()]
    sealed = hashlib.sha256(answers.read_bytes()).hexdigest()
    (a.folder / "sealed.sha256").write_text(sealed + "\n")
    rows = []
    for number, truth in enumerate(truths):
        folder = a.folder / truth["set"]
        done = subprocess.run([a.loop, "run", folder / "set.toml", folder / "loop", "--quiet", "--forward=closed", f"--null-sets={a.null_sets}"], capture_output=True, text=True)
        if done.returncode:
            print(truth["set"], done.stderr, file=sys.stderr)
            continue
        report = json.loads((folder / "loop" / "report.json").read_text())
        rows.append((truth, report))
        print(number + 1, len(truths), truth["set"], report["verdict"]["kind"], report["verdict"]["alternatives"], f"{report['seconds']:.1f} s", flush=True)
    summary(rows, sealed, a)


def summary(rows, sealed, a):
    claims = lambda r: r["verdict"]["kind"] in ("claimed", "confounded")
    nulls = [r for t, r in rows if not t["effects"]]
    hidden = [(t, r) for t, r in rows if t["effects"]]
    known = [(t, r) for t, r in hidden if not {"hum", "stick_slip", "puncture"} & set(t["effects"])]
    outside = [(t, r) for t, r in hidden if {"hum", "stick_slip", "puncture"} & set(t["effects"])]
    print(f"\nanswers sealed as {sealed}; protocol {a.protocol}, repeatability {a.repeatability} %, sizes {a.sizes} %")
    print("false alarms on nulls (a claim):", interval(sum(map(claims, nulls)), len(nulls)))
    print("nulls called unexplained:", interval(sum(r["verdict"]["kind"] == "unexplained" for r in nulls), len(nulls)))
    found = [(t, r) for t, r in known if claims(r)]
    in_set = lambda t, r: sorted(t["effects"]) in [sorted(s) for s in r["verdict"]["alternatives"]]
    first = lambda t, r: sorted(t["effects"]) == sorted(r["verdict"]["alternatives"][0])
    single = lambda r: len(r["verdict"]["alternatives"]) == 1
    print("detected:", interval(len(found), len(known)))
    print("first named is right, of the detected:", interval(sum(first(t, r) for t, r in found), len(found)))
    print("truth in the reported set, of the detected:", interval(sum(in_set(t, r) for t, r in found), len(found)))
    print("single right verdict, of all:", interval(sum(single(r) and first(t, r) for t, r in found), len(known)))
    print("single wrong verdict, of all:", interval(sum(single(r) and not first(t, r) for t, r in found), len(known)))
    print("mean size of the set:", round(sum(len(r["verdict"]["alternatives"]) for _, r in found) / max(len(found), 1), 2))
    print("outside the catalogue, called unexplained:", interval(sum(r["verdict"]["kind"] == "unexplained" for _, r in outside), len(outside)))
    ratios = sorted(r["error"]["after"]["holdout"]["times_noise_floor"] for t, r in found if in_set(t, r))
    if ratios:
        print("sealed error after over noise floor, median and 90 %:", round(ratios[len(ratios) // 2], 2), round(ratios[int(0.9 * len(ratios))], 2))
    seconds = sorted(r["seconds"] for _, r in rows)
    print("seconds, median and largest:", round(seconds[len(seconds) // 2], 1), round(seconds[-1], 1))
    print("\n| hidden | size % | verdicts |\n|---|---|---|")
    table = {}
    for t, r in rows:
        what = " + ".join(t["effects"]) or "nothing"
        said = r["verdict"]["kind"] + (": " + " or ".join("+".join(s) for s in r["verdict"]["alternatives"]) if claims(r) else "")
        table.setdefault((what, t["size"] if t["effects"] else 0), []).append(said)
    for (what, size), said in sorted(table.items()):
        counted = {s: said.count(s) for s in said}
        print(f"| {what} | {size:g} | {'; '.join(f'{n} × {s}' for s, n in sorted(counted.items(), key=lambda x: -x[1]))} |")


main()

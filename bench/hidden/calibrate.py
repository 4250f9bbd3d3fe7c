#!/usr/bin/env python3
# Runs the loop on sets with hidden effects (make.py) and counts: false alarms, detection, right names, size of the reported set, errors.
# Answers are written and hashed before the loop sees a set. Every rate comes with its number of sets and a binomial interval.
# With a folder of an earlier count that was cut short, it goes on there: same sets, and what was run by the same program is not run again.
# SPDX-License-Identifier: GPL-3.0-or-later
#   calibrate.py LOOP FOLDER --nulls N --effects a,b,c --sizes 5 --each N [--protocol short] [--repeatability 1] [--null-sets 1000]
import argparse
import concurrent.futures
import hashlib
import json
import math
import pathlib
import random
import shutil
import subprocess
import sys
import time

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
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--json", type=pathlib.Path, help="where to write the counts")
    parser.add_argument("--until", default="", help="HH:MM of today, after which no further set is run")
    a = parser.parse_args()
    a.folder.mkdir(parents=True, exist_ok=True)
    answers = a.folder / "answers.jsonl"
    pool = concurrent.futures.ThreadPoolExecutor(a.jobs)
    seal = a.folder / "sealed.sha256"
    if not seal.exists():
        list(pool.map(lambda p: make(a.folder / p[0], answers, protocol=a.protocol, repeatability=a.repeatability, **p[1]), plan(a)))
        seal.write_text(hashlib.sha256(answers.read_bytes()).hexdigest() + "\n")
    truths = [json.loads(line) for line in answers.read_text().splitlines()]
    sealed = hashlib.sha256(answers.read_bytes()).hexdigest()
    if sealed != seal.read_text().strip() or sorted(t["set"] for t in truths) != sorted(name for name, _ in plan(a)):
        sys.exit(f"{a.folder}: not the sets that these options make")
    program = hashlib.sha256(pathlib.Path(a.loop).read_bytes()).hexdigest()
    random.Random(a.seed).shuffle(truths)  # so that a count cut short is a fair sample

    def run(truth):
        if a.until and time.strftime("%H:%M") >= a.until:
            return None
        folder = a.folder / truth["set"]
        by = folder / "by.sha256"  # the program that made the report beside it
        if by.exists() and by.read_text().strip() == program:
            return truth, json.loads((folder / "loop" / "report.json").read_text())
        shutil.rmtree(folder / "loop", ignore_errors=True)
        done = subprocess.run([a.loop, "run", folder / "set.toml", folder / "loop", "--quiet", "--threads=1", f"--null-sets={a.null_sets}"],
                              capture_output=True, text=True)
        if done.returncode:
            print(truth["set"], done.stderr, file=sys.stderr)
            return None
        report = json.loads((folder / "loop" / "report.json").read_text())
        by.write_text(program + "\n")
        print(truth["set"], report["verdict"]["kind"], report["verdict"]["alternatives"], f"{report['seconds']:.1f} s", flush=True)
        return truth, report

    rows = [row for row in pool.map(run, truths) if row]
    summary(rows, sealed, a)


OUTSIDE = {"hum", "stick_slip", "puncture", "breathing"}
AMPLITUDES = {"contact_offset": "delta0", "rig_compliance": "c", "drift": "d", "tare": "F0", "lag": "tau", "friction": "mu", "prony": "g", "rate": "m",
              "mullins": "inverse_r", "permanent_set": "fraction", "compressibility": "half_minus_nu", "thickness": "excess", "tool_pose": "tilt", "adhesion": "work", "capsule": "Eh", "saturation": "limit"}


def errors_of_parameters(rows):
    """Relative errors, and how many intervals hold the truth, where both sides mean the same number."""
    errors, inside = [], []
    for t, r in rows:
        for effect in t["effects"]:
            for p in r["parameters"]:
                if effect in AMPLITUDES and p["name"] == f"{effect}.{AMPLITUDES[effect]}":
                    truth = t["knobs"][effect]
                    errors.append(abs(p["value"] / truth - 1))
                    inside.append(p["interval"][0] <= truth <= p["interval"][1])
    return sorted(errors), inside


def summary(rows, sealed, a):
    claims = lambda r: r["verdict"]["kind"] in ("claimed", "confounded")
    kind = lambda r, k: r["verdict"]["kind"] == k
    sets = lambda r: [sorted(s) for s in r["verdict"]["alternatives"]]
    nulls = [r for t, r in rows if not t["effects"]]
    known = [(t, r) for t, r in rows if t["effects"] and not OUTSIDE & set(t["effects"])]
    outside = [(t, r) for t, r in rows if OUTSIDE & set(t["effects"])]
    found = [(t, r) for t, r in known if claims(r)]
    in_set = lambda t, r: sorted(t["effects"]) in sets(r)
    right = lambda t, r: sorted(t["effects"]) == sets(r)[0]
    single = lambda r: len(sets(r)) == 1
    pairs = [(t, r) for t, r in known if len(t["effects"]) == 2]
    named = lambda t, r: set(t["effects"]) <= {e for s in sets(r) for e in s}
    count = lambda rows, true: [sum(1 for x in rows if true(*x)), len(rows)]
    counts = {
        "false alarms on nulls": [sum(map(claims, nulls)), len(nulls)],
        "nulls called unexplained": [sum(kind(r, "unexplained") for r in nulls), len(nulls)],
        "detected": [len(found), len(known)],
        "first named is right, of the detected": count(found, right),
        "truth in the reported set, of the detected": count(found, in_set),
        "single right verdict, of all": [sum(single(r) and right(t, r) for t, r in found), len(known)],
        "single wrong verdict, of all": [sum(single(r) and not right(t, r) for t, r in found), len(known)],
        "pairs: both named": [sum(claims(r) and named(t, r) for t, r in pairs), len(pairs)],
        "pairs: no wrong name": [sum(not claims(r) or any(set(s) <= set(t["effects"]) for s in sets(r)) for t, r in pairs), len(pairs)],
        "outside the catalogue, called unexplained": count(outside, lambda t, r: kind(r, "unexplained")),
        "outside the catalogue, claimed": count(outside, lambda t, r: claims(r)),
    }
    errors, inside = errors_of_parameters([(t, r) for t, r in found if right(t, r)])
    counts["95 % intervals that hold the truth"] = [sum(inside), len(inside)]
    middle = lambda x, share: round(sorted(x)[int(share * (len(x) - 1))], 3) if x else None
    ratios = [r["error"]["after"]["holdout"]["times_noise_floor"] for t, r in found if in_set(t, r)]
    numbers = {"mean size of the set": round(sum(len(sets(r)) for _, r in found) / max(len(found), 1), 2),
               "sealed error after over noise floor, median and 90 %": [middle(ratios, 0.5), middle(ratios, 0.9)],
               "parameter error, median and 90 %": [middle(errors, 0.5), middle(errors, 0.9)],
               "seconds, median and largest": [middle([r["seconds"] for _, r in rows], 0.5), middle([r["seconds"] for _, r in rows], 1.0)]}
    print(f"\nanswers sealed as {sealed}; protocol {a.protocol}, repeatability {a.repeatability} %, sizes {a.sizes} %, seed {a.seed}")
    for name, (k, n) in counts.items():
        print(f"{name}: {interval(k, n)}")
    for name, value in numbers.items():
        print(f"{name}: {value}")
    print("\n| hidden | size % | verdicts |\n|---|---|---|")
    table = {}
    for t, r in rows:
        what = " + ".join(t["effects"]) or "nothing"
        said = r["verdict"]["kind"] + (": " + " or ".join("+".join(s) for s in r["verdict"]["alternatives"]) if claims(r) else "")
        table.setdefault((what, t["size"] if t["effects"] else 0), []).append(said)
    matrix = {f"{what}, {size:g} %": {s: said.count(s) for s in said} for (what, size), said in sorted(table.items())}
    for name, counted in matrix.items():
        print(f"| {name} | {'; '.join(f'{n} × {s}' for s, n in sorted(counted.items(), key=lambda x: -x[1]))} |")
    if a.json:
        a.json.write_text(json.dumps({"sealed": sealed, "protocol": a.protocol, "repeatability_percent": a.repeatability, "sizes_percent": a.sizes, "seed": a.seed,
                                      "counts": counts, "numbers": numbers, "verdicts": matrix}, indent=1, ensure_ascii=False) + "\n")


main()

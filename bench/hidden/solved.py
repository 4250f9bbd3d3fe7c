#!/usr/bin/env python3
# Makes sets of a pressed organ with something hidden in it: palpate-solve presses a finer mesh than the loop's, with the effect in the solver; noise and rig go on top,
# and the answers to a file of their own.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sets of a pressed organ by the whole solver.

    solved.py BIN CASE MESH SOLVES FOLDER [--effects none,prony,prony+drift] [--each N] [--seed N] [--repeatability PERCENT] [--amplitude X] [--memory-mesh MESH] [--also X,Y,Z/AX,AY,AZ]

BIN: the executables. CASE: case.toml of the loop, beside its mesh; its law is the truth's too. MESH: the truth's mesh. SOLVES: curves are kept there. FOLDER gets one set per
effect and number, and answers.jsonl. Protocol: two rods, at the place of CASE and at those of --also; ramp, hold, unload, rest, twice, at three rates, with repeats; a rigid block; one sealed run to four fifths of the depth.
"""
import argparse
import bisect
import csv
import hashlib
import json
import math
import pathlib
import random
import re
import subprocess

from physics import SENSOR, cubic, noise, read_off

# Of palpate-solve: text of the effect, amplitude. Memory: every motion is solved; what has no time in it: each programme of depth; the others one curve per rod.
IN_SOLVER = {"prony": ('[[effect]]\nname = "prony"\ng = {}\ntau_s = 4.0\n', 0.2), "rate": ('[[effect]]\nname = "rate"\nm = {}\nrate_0 = 0.01\n', 0.05),
             "mullins": ('[[effect]]\nname = "mullins"\ninverse_r = {}\nm = 0.0003\n', 0.3), "permanent_set": ('[[effect]]\nname = "permanent_set"\nfraction = {}\nyield = 0.05\n', 0.1),
             "friction": ('[[effect]]\nname = "friction"\nmu = {}\n', 0.15), "adhesion": ('[[effect]]\nname = "adhesion"\nwork = {}\nrange_mm = 0.3\n', 0.3),
             "capsule": ('[[effect]]\nname = "capsule"\nE_h = {}\n', 0.02), "prestress": ('[[effect]]\nname = "prestress"\np_kPa = {}\n', 1.0),
             "support": ('[[effect]]\nname = "support"\nstiffness = {}\n', 0.002), "compressibility": ("", 0.06), "stiffening": ("", 0.6), "thickness": ("", -0.12)}
MEMORY, PATH = {"prony", "rate"}, {"friction", "adhesion", "mullins", "permanent_set"}
# Of the rig, on top: read_off's and ours. Forces in shares of the largest.
ON_TOP = {"contact_offset": 0.12, "rig_compliance": 0.25, "drift": 4e-4, "lag": 0.3, "saturation": 0.75, "tare": 0.03, "gain": 0.05}
DEPTH = 4.0  # mm


def runs_of(a):
    """id, rod (radius, where), rate, depth, replicate, role."""
    small, large = (2.5, a.places[0]), (5.0, a.places[0])
    runs = [(f"r0{i}", small, 1.0, DEPTH, "g1", "fit") for i in (1, 2, 3)] + [(f"r0{i}", small, 0.1, DEPTH, "g2", "fit") for i in (4, 5)]
    runs += [(f"r0{i}", small, 10.0, DEPTH, "g3", "fit") for i in (6, 7)] + [(f"r0{i}", large, 1.0, DEPTH, "g4", "fit") for i in (8, 9)]
    for number, place in enumerate(a.places[1:], 2):
        runs += [(f"p{number}{letter}{i}", (radius, place), 1.0, DEPTH, f"g{number}{letter}", "fit") for letter, radius in (("a", 2.5), ("b", 5.0)) for i in (1, 2)]
    return runs + [("h01", small, 1.0, 0.8 * DEPTH, "", "holdout")]


def programme(rate, depth):
    """Corners of the motion, (t, u), and the times that are solved."""
    corners, times = [(0.0, 0.0)], []
    for _ in range(2):
        t, ramp = corners[-1][0], depth / rate
        corners += [(t + ramp, depth), (t + ramp + 10, depth), (t + 2 * ramp + 10, 0.0), (t + 2 * ramp + 20, 0.0)]
        times += [t + ramp * k / 8 for k in range(1, 9)] + [t + ramp + 10 * 2.0 ** (k - 3) for k in range(4)]
        times += [t + ramp + 10 + ramp * k / 6 for k in range(1, 7)] + [t + 2 * ramp + 20]
    return corners, times


def case_text(a, rod, effect, amplitude, motion):
    text = re.sub(r"(?ms)^\[(tool|steps)\].*?(?=^\[|\Z)", "", a.case.read_text())
    mu = float(re.search(r"(?m)^mu\s*=\s*([\d.e-]+)", text)[1])
    if effect == "compressibility":
        nu = 0.5 - amplitude
        text = re.sub(r"(?m)^(mu\s*=.*)$", rf"\1\nkappa = {2 * mu * (1 + nu) / (3 * (1 - 2 * nu))}", text)
    elif effect == "stiffening":
        text = re.sub(r"(?ms)^\[material\].*?(?=^\[|\Z)", f'[material]\nlaw = "fung_demiray"\nmu = {mu}\nb = {amplitude}\n', text)
    elif effect == "thickness":
        n, x0 = (json.loads(re.search(rf"{key}\s*=\s*(\[.*?\])", text)[1]) for key in ("normal", "point_mm"))
        text += '[[effect]]\nname = "thickness"\nexcess = {}\n'.format(amplitude) + "".join(f"axis_{c} = {x}\n{c}_mm = {y}\n" for c, x, y in zip("xyz", n, x0))
    elif effect:
        text += IN_SOLVER[effect][0].format(amplitude)
    if effect == "support":
        text = re.sub(r"(?ms)^\[base\].*?(?=^\[|\Z)", "", text) + re.search(r"(?m)^plane.*$", a.case.read_text())[0] + "\n"
    return text + f'[tool]\nkind = "rod"\nradius_mm = {rod[0]}\naim_mm = {rod[1][0]}\naxis = {rod[1][1]}\n' + motion


def solved(a, mesh, rod, effect, amplitude, motion):
    """(t, depth, force) of each step."""
    text = case_text(a, rod, effect, amplitude, motion)
    folder = a.solves / f"{effect or 'none'}-{hashlib.sha256(text.encode() + mesh.read_bytes()).hexdigest()[:12]}"
    if not (folder / "history.csv").exists():
        a.solves.mkdir(parents=True, exist_ok=True)
        folder.with_suffix(".toml").write_text(text)
        subprocess.run([a.bin / "palpate-solve", folder.with_suffix(".toml"), folder, "--mesh", mesh, "--quiet", "--threads=1"], check=True, stdout=subprocess.DEVNULL)
    with open(folder / "history.csv") as file:
        return [(float(r["t[s]"]), float(r["depth[mm]"]), float(r["F[N]"])) for r in csv.DictReader(file)]


def elastic(a, rod, effect="", amplitude=0.0, mesh=None):
    """Force over depth, a function."""
    rows = [r for r in solved(a, mesh or a.mesh, rod, effect, amplitude, f"depth_mm = {1.08 * DEPTH}\n[steps]\ncount = 22\nframes = 1\n") if r[1] > 0 and r[2] > 0]
    points = [(math.sqrt(u), f / u**1.5) for _, u, f in rows]
    return lambda u: 0.0 if u <= 0 else u**1.5 * (points[0][1] if math.sqrt(u) < points[0][0] else cubic(points, math.sqrt(u)))


def moved(a, rod, rate, depth, effect, amplitude, base):
    """Force over time of a motion: the ratio to the elastic force of the same mesh, a cubic between the solved times of each stretch, times the truth's elastic force."""
    corners, times = programme(rate, depth)
    path = ", ".join(f"[{t:.6f}, {u:.6f}]" for t, u in corners)
    rows = solved(a, a.memory_mesh, rod, effect, amplitude, f"path = [{path}]\n[steps]\ntimes_s = [{', '.join(f'{t:.6f}' for t in times)}]\nmost_cuts = 8\nframes = 1\n")
    own = elastic(a, rod, mesh=a.memory_mesh)
    floor, own_floor = 0.02 * base(depth), 0.02 * own(depth)
    phases = []  # knots of each stretch of the motion
    for (start, _), (end, _) in zip(corners, corners[1:]):
        phases.append([(t, f / max(own(u), own_floor)) for t, u, f in rows if start - 1e-6 <= t <= end + 1e-6])
    ends = [t for t, _ in corners[1:]]

    def force(t, u):
        knots = phases[min(bisect.bisect_left(ends, t - 1e-9), len(phases) - 1)]
        return cubic(knots, t) * max(base(u), floor)
    return force


def samples_of(rate, depth):
    corners, _ = programme(rate, depth)
    end, out, i = corners[-1][0], [], 0
    step = min(end / 240, depth / rate / 8)
    for k in range(int(end / step) + 1):
        t = k * step
        while i + 2 < len(corners) and t > corners[i + 1][0]:
            i += 1
        (t0, u0), (t1, u1) = corners[i], corners[i + 1]
        out.append((t, u0 + (u1 - u0) * min((t - t0) / (t1 - t0), 1)))
    return out


def tissue_of(a, effects, knobs, rod, rate, depth):
    """Force as a function of time and depth: one effect of the solver at most."""
    inside = [e for e in effects if e in IN_SOLVER]
    base = elastic(a, rod)
    if not inside:
        return lambda t, u: base(u)
    effect = inside[0]
    if effect in MEMORY:
        return moved(a, rod, rate, depth, effect, knobs[effect], base)
    if effect in PATH:  # no time in it: one programme, stretched
        at_one = moved(a, rod, 1.0, depth, effect, knobs[effect], base)
        ramp, one = depth / rate, depth
        return lambda t, u: at_one(stretched(t, ramp, one), u)
    with_it = elastic(a, rod, effect, knobs[effect])
    return lambda t, u: with_it(u)


def stretched(t, ramp, one):
    """Time of the programme at 1 mm/s that is at the same place in its course."""
    corners, like = [0.0], [0.0]
    for _ in range(2):
        for mine, its in ((ramp, one), (10, 10), (ramp, one), (10, 10)):
            corners.append(corners[-1] + mine)
            like.append(like[-1] + its)
    i = min(max(bisect.bisect(corners, t), 1), len(corners) - 1)
    return like[i - 1] + (like[i] - like[i - 1]) * (t - corners[i - 1]) / (corners[i] - corners[i - 1])


def read_run(a, effects, knobs, run, order):
    """(t, u, F) without noise."""
    _, rod, rate, depth, _, _ = run
    tissue = tissue_of(a, effects, knobs, rod, rate, depth)
    times, read = zip(*samples_of(rate, depth))
    inner = [u + knobs.get("contact_offset", 0) for u in read]
    force, c = [tissue(t, u) for t, u in zip(times, inner)], knobs.get("rig_compliance", 0)
    for _ in range(12 if c else 0):
        force = [tissue(t, u - c * f) for t, u, f in zip(times, inner, force)]
    return times, read, read_off(times, force, {"order": order}, {k: v for k, v in knobs.items() if k in ON_TOP})


def given_way(a, stiffness):
    """Compliance, mm/N, by which a support of this stiffness per area lets the organ go down under the small rod: least squares over depth."""
    held, carried = elastic(a, (2.5, a.places[0])), elastic(a, (2.5, a.places[0]), "support", stiffness)
    over = under = 0.0
    for k in range(4, 21):
        u = DEPTH * k / 20
        low, high = 0.0, u
        for _ in range(40):
            low, high = ((low + high) / 2, high) if held((low + high) / 2) < carried(u) else (low, (low + high) / 2)
        over, under = over + (u - low) * carried(u), under + carried(u) ** 2
    return over / under


def write_set(a, name, effects, seed):
    rng = random.Random(seed)
    top = elastic(a, (2.5, a.places[0]))(DEPTH)
    knobs = {e: IN_SOLVER[e][1] if e in IN_SOLVER else ON_TOP[e] * (top if e in ("drift", "saturation", "tare") else 1) for e in effects}
    for e in effects:
        if e in ON_TOP and e != "saturation":
            knobs[e] *= rng.uniform(0.8, 1.25)
    if a.amplitude and effects:
        knobs[effects[0]] = a.amplitude
    folder = a.folder / name
    folder.mkdir(parents=True)
    case = pathlib.Path("..") / ".." / a.case if not a.case.is_absolute() else a.case
    text = f'schema = "palpate-set/1"\n\n[specimen]\nid = "{name}"\ncase = "{case}"\n' + (f'law = "{a.law}"\n' if a.law else "") + '\n[rig]\ncompliance_mm_per_N = "unknown"\n'
    for radius in (2.5, 5.0):
        text += f'\n[tool.t{radius:g}]\nkind = "rod"\nradius_mm = {radius}\n'.replace("t2.5", "t2").replace("t5]", "t5]")
    squares = count = 0
    for order, run in enumerate(runs_of(a), 1):
        identity, (radius, (aim, axis)), rate, depth, group, role = run
        times, read, force = read_run(a, effects, knobs, run, order)
        plain = read_run(a, [], {}, run, order)[2]
        if role == "fit":
            squares, count = squares + sum((x - y) ** 2 for x, y in zip(force, plain)), count + len(force)
        shown = noise(rng, times, force, a.repeatability / 100, math.inf)
        with open(folder / f"{identity}.csv", "w", newline="") as file:
            csv.writer(file).writerows([("t[s]", "u[mm]", "F[N]")] + [(f"{t:.4f}", f"{u:.6f}", f"{f:.7f}") for t, u, f in zip(times, read, shown)])
        text += (f'\n[[run]]\nid = "{identity}"\nfile = "{identity}.csv"\ntool = "t{"2" if radius == 2.5 else "5"}"\npoint_mm = {aim}\naxis = {axis}\nzero = "geometry"\norder = {order}\nrest_before_s = 60\n'
                 f'rate_mm_s = {rate}\nrole = "{role}"\n' + (f'replicate = "{group}"\n' if group else ""))
    c = knobs.get("rig_compliance", 0)
    with open(folder / "block.csv", "w", newline="") as file:
        rows = [(0.1 * i, c * 0.02 * min(i, 80 - i) + rng.gauss(0, 1e-5), 0.02 * min(i, 80 - i) + rng.gauss(0, SENSOR), "block") for i in range(81)]
        csv.writer(file).writerows([("t[s]", "u[mm]", "F[N]", "phase")] + [(f"{t:.2f}", f"{u:.6f}", f"{f:.7f}", p) for t, u, f, p in rows])
    text += f'\n[[run]]\nid = "b01"\nfile = "block.csv"\ntool = "t2"\npoint_mm = {a.places[0][0]}\naxis = {a.places[0][1]}\nzero = "geometry"\norder = {len(runs_of(a)) + 1}\nrest_before_s = 60\nrole = "calibration"\n'
    (folder / "set.toml").write_text(text)
    if "support" in knobs:
        knobs["support_mm_per_N"] = given_way(a, knobs["support"])
    with open(a.folder / "answers.jsonl", "a") as file:
        file.write(json.dumps({"set": name, "effects": effects, "size": round(100 * math.sqrt(squares / count) / top, 2), "knobs": knobs, "seed": seed}) + "\n")


def main():
    parser = argparse.ArgumentParser()
    for name in ("bin", "case", "mesh", "solves", "folder"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--effects", default="none")
    parser.add_argument("--each", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--repeatability", type=float, default=1.0)
    parser.add_argument("--amplitude", type=float, default=0.0, help="of the first effect, instead of the usual one")
    parser.add_argument("--memory-mesh", type=pathlib.Path, help="a coarser one for effects that remember, or hold on to the tool: of their force over the elastic one, instead of MESH")
    parser.add_argument("--law", default="", help='of the set, instead of the case\'s: "unknown"')
    parser.add_argument("--also", action="append", default=[], metavar="X,Y,Z/AX,AY,AZ", help="a further place, pressed by both rods: point and axis")
    a = parser.parse_args()
    tool = re.search(r"(?ms)^\[tool\].*?(?=^\[|\Z)", a.case.read_text())[0]
    a.places = [tuple(re.search(rf"(?m)^{key}\s*=\s*(\[.*?\])", tool)[1] for key in ("aim_mm", "axis"))] + [tuple(f"[{v}]" for v in place.split("/")) for place in a.also]
    a.case, a.memory_mesh = a.case.resolve(), a.memory_mesh or a.mesh
    for word in a.effects.split(","):
        for i in range(a.each):
            write_set(a, f"{word.replace('+', '-')}_{i}", [] if word == "none" else word.split("+"), 1000 * a.seed + 100 * i + sum(map(ord, word)))


if __name__ == "__main__":
    main()

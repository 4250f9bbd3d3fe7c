#!/usr/bin/env python3
# Makes measured sets with a known effect in them, by another route than the loop's (physics.py).
# SPDX-License-Identifier: GPL-3.0-or-later
#   make.py [--protocol ramp|short|middle|battery] [--effect NAME|A+B|none] [--size PERCENT] [--repeatability PERCENT] [--seed N] FOLDER
# The answer is written only with --answers FILE; the set itself tells nothing.
import argparse
import csv
import json
import math
import pathlib
import random

from physics import HEIGHT, SENSOR, force_of, noise, path

SCALE = HEIGHT / 3 * 0.6  # mm, the deepest point

# Unit amplitude of each effect, before it is scaled to the asked change of the force.
UNITS = {"contact_offset": 0.1, "rig_compliance": 0.2, "backlash": 0.1, "gain": 0.05, "tare": 0.02, "drift": 2e-4, "lag": 0.1, "friction": 0.1,
         "adhesion": 0.5, "prony": 0.1, "rate": 0.01, "mullins": 0.1, "permanent_set": 0.05, "stiffening": 0.5, "prestress": 1e-3, "compressibility": 0.03,
         "thickness": 0.1, "capsule": 0.01, "support": 1.0, "inclusion": 0.5, "tool_pose": 0.05, "hum": 0.02, "stick_slip": 0.05, "puncture": 0.1, "breathing": 0.05}


def runs_of(protocol):
    """Runs by name: one ramp; three runs of one kind; "middle": those, slow ones and a smaller ball, all at one site; the battery."""
    def run(identity, kind="short", radius=5.0, rate=1.0, depth=SCALE, point=(0, 0), group="", turn=0, role="fit"):
        return {"id": identity, "kind": kind, "radius": radius, "rate": rate, "depth": depth, "point": point, "group": group, "turn": turn, "role": role}
    first = "long" if protocol == "battery" else "short"
    runs = [run(f"r{i:02d}", first, group="g1") for i in ((1,) if protocol == "ramp" else (1, 2, 3))]
    if protocol == "middle":
        runs += [run("r04", rate=0.1, group="g2"), run("r05", rate=0.1, group="g2"), run("r06", radius=2.5, depth=0.6 * SCALE, group="g3"),
                 run("r07", radius=2.5, depth=0.6 * SCALE, group="g3")]
    if protocol == "battery":
        runs += [run("r04", rate=0.1, group="g2"), run("r05", rate=0.1, group="g2"), run("r06", rate=10.0, group="g3"), run("r07", rate=10.0, group="g3"),
                 run("r08", radius=2.5, depth=0.6 * SCALE, group="g4"), run("r09", radius=2.5, depth=0.6 * SCALE, group="g4"), run("r10", point=(25, 0)),
                 run("r11", point=(0, -20)), run("r12", "growing"), run("r13", turn=180), run("r14", "retract"), run("r15", "air", role="calibration"),
                 run("r16", "block", role="calibration"), run("r17", first)]
    runs.append(run("h01", depth=0.8 * SCALE, role="holdout"))
    for order, r in enumerate(runs):
        r["order"], r["fresh"] = order + 1, order == 0
    return runs


def step_of(run):
    """Seconds between samples: 240 samples or so, ramps of a fast run with 20 samples each at least."""
    duration = path(run, 1.0)[0][-1]
    return min(max(duration / 240, 0.02), run["depth"] / run["rate"] / 8 if run["rate"] < 5 else 0.05)


def block(knobs):
    """A rigid block: the rig alone gives way."""
    c, force = knobs.get("rig_compliance", 0), [0.02 * min(i, 80 - i) for i in range(81)]
    return [0.1 * i for i in range(81)], [c * f for f in force], force


def samples(run, knobs, steps=1):
    """Times, depths, forces read; `steps` of time behind each sample."""
    if run["kind"] == "block":
        return block(knobs)
    times, read = path(run, step_of(run) / steps)
    return times[::steps], read[::steps], force_of(times, read, run, knobs)[::steps]


def rms_change(runs, knobs, bases):
    """Over the battery, % of the peak; of the lateral force for a tilted tool."""
    if "tool_pose" in knobs:
        return 100 * math.tan(knobs["tool_pose"])
    square, count, top = 0.0, 0, 0.0
    for run, base in zip(runs, bases):
        changed = samples(run, knobs)[2]
        square += sum((x - y) ** 2 for x, y in zip(changed, base))
        count += len(base)
        top = max(top, max(base))
    return 100 * math.sqrt(square / count) / top


def knobs_for(protocol, effects, size, specimen_radius):
    runs = [r for r in runs_of(protocol) if r["role"] == "fit"]
    base = {"scale": SCALE} | ({"narrow": specimen_radius} if specimen_radius < 80 else {})
    knobs = dict(base)
    bases = [samples(run, base)[2] for run in runs] if effects else []
    for name in effects:
        if name == "saturation":
            top = max(max(b) for b in bases)
            low, high = 0.2, 1.0  # share of the largest force
            for _ in range(20):
                middle = 0.5 * (low + high)
                square = sum(sum(max(f - middle * top, 0) ** 2 for f in b) for b in bases)
                low, high = (middle, high) if 100 * math.sqrt(square / sum(map(len, bases))) / top > size else (low, middle)
            knobs[name] = low * top
            continue
        amplitude = UNITS[name] * (-1 if name == "thickness" else 1)
        share = 1
        if name == "inclusion":  # of the runs at its site alone
            chosen = [i for i, r in enumerate(runs) if r["point"] == (25, 0)] or [0]
        else:
            chosen = range(len(runs))
        for _ in range(3 if name != "tool_pose" else 2):  # nearly linear
            change = rms_change([runs[i] for i in chosen], {**base, name: amplitude}, [bases[i] for i in chosen])
            amplitude *= size / max(share * change, 1e-9)
        knobs[name] = amplitude
    return knobs


def write_run(folder, run, knobs, rng, repeatability):
    times, read, force = samples(run, knobs, 8)
    if run["kind"] == "block":
        rows = [(t, u + rng.gauss(0, 1e-5), f + rng.gauss(0, SENSOR)) for t, u, f in zip(times, read, force)]
    else:
        rows = list(zip(times, read, noise(rng, times, force, repeatability, knobs.get("saturation", math.inf))))
    header = ["t[s]", "u[mm]", "F[N]"] + (["phase"] if run["kind"] in ("air", "block") else ["Fx[N]", "Fy[N]"])
    angle, aside = math.radians(run["turn"] + 35), [rng.gauss(0, 0.003) for _ in range(2)]  # the tool's tilt turns with it; each run sits a little askew
    with open(folder / f"{run['id']}.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        for t, u, f in rows:
            lateral = [f * (math.tan(knobs.get("tool_pose", 0)) * w + a) + rng.gauss(0, SENSOR) for w, a in zip((math.cos(angle), math.sin(angle)), aside)]
            writer.writerow([f"{t:.4f}", f"{u:.6f}", f"{f:.7f}"] + ([run["kind"]] if run["kind"] in ("air", "block") else [f"{x:.7f}" for x in lateral]))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--protocol", default="short", choices=["ramp", "short", "middle", "battery"])
    parser.add_argument("--radius", type=float, default=80.0, help="of the specimen, mm: 80, or 30 or 20 with a protocol of one site")
    parser.add_argument("--effect", default="none")
    parser.add_argument("--size", type=float, default=5.0)
    parser.add_argument("--repeatability", type=float, default=1.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--answers", type=pathlib.Path)
    a = parser.parse_args()
    rng = random.Random(a.seed)
    effects = [] if a.effect == "none" else a.effect.split("+")
    knobs = knobs_for(a.protocol, effects, a.size, a.radius)
    a.folder.mkdir(parents=True)
    text = (f'schema = "palpate-set/1"\n\n[specimen]\nid = "S{a.seed}"\nshape = "cylinder"\nradius_mm = {a.radius}\nheight_mm = {HEIGHT}\nbase = "bonded"\n'
            'law = "neo_hookean"\n\n[rig]\ncompliance_mm_per_N = "unknown"\n\n[tool.t5]\nkind = "ball"\nradius_mm = 5.0\n\n[tool.t2]\nkind = "ball"\nradius_mm = 2.5\n')
    for run in runs_of(a.protocol):
        write_run(a.folder, run, knobs, rng, a.repeatability / 100)
        text += (f'\n[[run]]\nid = "{run["id"]}"\nfile = "{run["id"]}.csv"\ntool = "{"t5" if run["radius"] == 5 else "t2"}"\n'
                 f'point_mm = [{run["point"][0]}.0, {run["point"][1]}.0, {HEIGHT}]\naxis = [0, 0, -1]\nzero = "geometry"\norder = {run["order"]}\n'
                 f'rest_before_s = 60\nrole = "{run["role"]}"\n')
        text += f'rate_mm_s = {run["rate"]}\n' if run["kind"] not in ("air", "block") else ""
        text += f'turn_deg = {run["turn"]}\n' if run["turn"] else ""
        text += f'replicate = "{run["group"]}"\n' if run["group"] else ""
    (a.folder / "set.toml").write_text(text)
    if a.answers:
        with open(a.answers, "a") as file:
            file.write(json.dumps({"set": a.folder.name, "effects": effects, "size": a.size, "repeatability": a.repeatability, "protocol": a.protocol,
                                   "seed": a.seed, "knobs": {k: v for k, v in knobs.items() if k not in ("scale", "narrow")}}) + "\n")


main()

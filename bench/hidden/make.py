#!/usr/bin/env python3
# Makes measured sets with a known effect in them, by another route than the loop's: Hertz with Garcia and Garcia's 2018 layer series and
# viscoelasticity by Ting's integral or by a sum of increments, Ogden-Roxburgh on the whole force, tables instead of springs.
# SPDX-License-Identifier: GPL-3.0-or-later
#   make.py [--protocol short|battery] [--effect NAME|none|...] [--size PERCENT] [--repeatability PERCENT] [--seed N] FOLDER
# The answer is written to FOLDER/../answers.jsonl only with --answers FILE; the set itself tells nothing.
import argparse
import csv
import json
import math
import pathlib
import random

MU, HEIGHT = 0.01, 20.0  # MPa, mm


def layer(radius, depth, height):
    """Garcia and Garcia 2018, Biophys. J. 114:2923, eq. 12: ball, bonded, incompressible layer."""
    chi = math.sqrt(radius * depth) / height
    return 1 + 1.133 * chi + 1.497 * chi**2 + 1.469 * chi**3 + 0.755 * chi**4


def large_strain(x):
    """Lin, Dimitriadis and Horkay 2009: neo-Hookean over Hertz; x = a/R."""
    return (x * x / 75 - x / 5 + 1) / (x * x / 25 - 2 * x / 5 + 1)


def elastic(depth, radius, knobs):
    if depth <= 0:
        return 0.0
    a = math.sqrt(radius * depth)
    x = a / radius
    force = 16 / 3 * MU * a * depth * layer(radius, depth, HEIGHT * (1 + knobs.get("thickness", 0))) * large_strain(x)
    force *= math.exp(knobs.get("stiffening", 0) * (x**3 - 15 * x * x) / (25 * x - 125))
    force *= 1 + knobs.get("outside_site", 0)
    force += knobs.get("prestress", 0) * 2 * 1.5 * depth + knobs.get("capsule", 0) * depth**2 / radius
    return force


def path(kind, rate, depth, step):
    """Times and depths: ramp, hold 10 s, unload, rest 10 s; twice."""
    points = [(0.0, 0.0)]
    for _ in range(2 if kind == "short" else 3):
        t = points[-1][0]
        ramp = depth / rate
        points += [(t + ramp, depth), (t + ramp + 10, depth), (t + 2 * ramp + 10, 0.0), (t + 2 * ramp + 20, 0.0)]
    if kind == "growing":
        points = [(0.0, 0.0)]
        for share in (0.4, 0.7, 1.0):
            t, ramp = points[-1][0], share * depth / rate
            points += [(t + ramp, share * depth), (t + ramp + 5, share * depth), (t + 2 * ramp + 5, 0.0), (t + 2 * ramp + 25, 0.0)]
    if kind == "retract":
        t = points[-1][0]
        points = points[:-1] + [(points[-2][0] + 1.5 / rate, -1.5)]
    times, depths, i = [], [], 0
    for k in range(int(points[-1][0] / step) + 1):
        t = k * step
        while i + 2 < len(points) and t > points[i + 1][0]:
            i += 1
        (t0, d0), (t1, d1) = points[i], points[i + 1]
        times.append(t)
        depths.append(d0 + (d1 - d0) * min(max((t - t0) / (t1 - t0), 0), 1))
    return times, depths


def relaxed(times, depths, radius, knobs):
    """Elastic, then with memory. Prony: every increment of an annulus relaxes for itself, on annuli of equal width in a (not in depth)."""
    g, tau = knobs.get("prony", 0), knobs.get("tau", 5.0)
    inverse_r, m = knobs.get("mullins", 0), knobs.get("mullins_m", 0.35)
    if not g and not inverse_r and not knobs.get("permanent_set"):
        return [elastic(d, radius, knobs) for d in depths]
    deepest = max(depths) * 1.01
    count = 90
    edges = [deepest * (i / count) ** 2 for i in range(count + 1)]  # equal steps of contact radius
    forces = [elastic(e, radius, knobs) for e in edges]
    slopes = [(forces[i + 1] - forces[i]) / (edges[i + 1] - edges[i]) for i in range(count)]
    weights = [slopes[0]] + [slopes[i] - slopes[i - 1] for i in range(1, count)]
    scale = knobs["scale"]
    stretch, dash, top = [0.0] * count, [0.0] * count, [0.0] * count
    out, before = [], times[0]
    for t, depth in zip(times, depths):
        dt, total = t - before, 0.0
        kept = 1 / (1 + dt / tau)  # backward Euler, where the loop is exponential
        for i in range(count):
            e = depth - edges[i]
            moved = kept * (dash[i] + e - stretch[i])
            f = (1 - g) * e + g * moved
            p = knobs.get("permanent_set", 0) * max(top[i], e, 0)
            loss = inverse_r * math.erf((max(top[i], e) ** 2 - e * e) / (2 * (m * scale) ** 2)) if inverse_r and e > 0 else 0
            f = f * (1 - loss) - p
            if f <= 0:
                e = (p + g * kept * (stretch[i] - dash[i])) / (1 - g + g * kept)
                dash[i] = kept * (dash[i] + e - stretch[i])
                stretch[i] = e
                continue
            dash[i], stretch[i], top[i] = moved, e, max(top[i], e)
            total += weights[i] * f
        out.append(total)
        before = t
    return out


def force_of(times, read, radius, knobs):
    """Depth read → force read."""
    depths = [d + knobs.get("contact_offset", 0) for d in read]
    if knobs.get("backlash"):
        at = 0.0
        for i, d in enumerate(depths):
            at = min(max(at, d), d + knobs["backlash"])
            depths[i] = at
    c = knobs.get("rig_compliance", 0)
    if c:  # fixed point on the elastic curve
        shifted = []
        for d in depths:
            x = d
            for _ in range(60):
                x = 0.5 * (x + d - c * elastic(x, radius, knobs))
            shifted.append(x)
        depths = shifted
    force = relaxed(times, depths, radius, knobs)
    step = times[1] - times[0]
    if knobs.get("friction"):
        s, before = 0.0, 0.0
        for i, d in enumerate(depths):
            s = max(-1.0, min(1.0, s + (d - before) / (0.04 * max(d, before, 1e-9)))) if d > 0 else 0.0
            before = d
            force[i] *= 1 + 0.59 * knobs["friction"] * math.sqrt(max(d, 0) / radius) * math.tanh(1.5 * s) / math.tanh(1.5)
    if knobs.get("rate"):
        for i in range(len(force)):
            v = (depths[i] - depths[i - 1]) / step / knobs["scale"] if i else 0
            force[i] *= 1 + knobs["rate"] * math.copysign(math.log1p(abs(v) / 0.01), v)
    if knobs.get("adhesion"):
        for i in range(1, len(force)):
            if depths[i] < depths[i - 1] and max(depths[:i]) > 0.5 and -0.3 < depths[i] < 0.3:
                force[i] -= knobs["adhesion"] * (1 - abs(depths[i]) / 0.3)
    if knobs.get("hum"):
        force = [f + knobs["hum"] * math.sin(2 * math.pi * 0.37 * t) for f, t in zip(force, times)]
    if knobs.get("stick_slip"):
        force = [f * (1 + knobs["stick_slip"] * ((d / 0.7) % 1 - 0.5)) for f, d in zip(force, depths)]
    if knobs.get("puncture"):
        done = False
        for i, d in enumerate(depths):
            done = done or d > 0.8 * knobs["scale"]
            force[i] *= 1 - knobs["puncture"] if done else 1
    force = [f * (1 + knobs.get("gain", 0)) + knobs.get("tare", 0) + knobs.get("drift", 0) * (t - times[0]) for f, t in zip(force, times)]
    if knobs.get("lag"):
        y = force[0]
        for i in range(1, len(force)):  # ten sub-steps of Euler, where the loop is exact
            f0, f1 = force[i - 1] if i == 1 else last, force[i]
            last = force[i]
            for k in range(10):
                y += step / 10 / max(knobs["lag"], step / 10) * (f0 + (f1 - f0) * (k + 1) / 10 - y)
            force[i] = y
    if knobs.get("saturation"):
        force = [min(f, knobs["saturation"]) for f in force]
    return force


# Unit amplitude of each effect, before it is scaled to the asked change of the force.
UNITS = {"contact_offset": 0.1, "rig_compliance": 0.2, "backlash": 0.1, "gain": 0.05, "tare": 0.02, "drift": 2e-4, "lag": 0.1, "friction": 0.1,
         "adhesion": 0.02, "prony": 0.1, "rate": 0.01, "mullins": 0.1, "permanent_set": 0.05, "stiffening": 0.5, "prestress": 1e-3,
         "thickness": 0.1, "capsule": 0.01, "saturation": 0.9, "hum": 0.02, "stick_slip": 0.05, "puncture": 0.1}


def runs_of(protocol):
    """(id, tool radius, kind of path, rate, depth, point, replicate)"""
    deep = HEIGHT / 3 * 0.6
    if protocol == "ramp":
        return [(f"r{i:02d}", 5.0, "short", 1.0, deep, (0, 0), "g1") for i in (1,)]
    short = [(f"r{i:02d}", 5.0, "short", 1.0, deep, (0, 0), "g1") for i in (1, 2, 3)]
    if protocol == "short":
        return short
    more = [("r04", 5.0, "short", 0.1, deep, (0, 0), "g2"), ("r05", 5.0, "short", 0.1, deep, (0, 0), "g2"), ("r06", 5.0, "short", 10.0, deep, (0, 0), "g3"),
            ("r07", 5.0, "short", 10.0, deep, (0, 0), "g3"), ("r08", 2.5, "short", 1.0, deep, (0, 0), "g4"), ("r09", 2.5, "short", 1.0, deep, (0, 0), "g4"),
            ("r10", 5.0, "short", 1.0, deep, (25, 0), ""), ("r11", 5.0, "growing", 1.0, deep, (0, 0), ""), ("r12", 5.0, "retract", 1.0, deep, (0, 0), "")]
    return short + more


def samples(run, knobs, rng=None, repeatability=0.0, sensor=0.0):
    identity, radius, kind, rate, depth, point, _ = run
    duration = path(kind, rate, depth, 1.0)[0][-1]
    times, read = path(kind, rate, depth, max(duration / 240, 0.02))
    if kind == "short" and rate >= 10:
        times, read = path(kind, rate, depth, 0.1)
    force = force_of(times, read, radius, knobs)
    if not rng:
        return times, read, force
    gain = rng.gauss(0, repeatability)  # run to run
    top = max(map(abs, force))
    walk, wander = 0.0, []
    for _ in times:  # slow drift: a random walk that ends about 0.2 of the repeatability away
        walk += rng.gauss(0, 0.2 * repeatability * top / math.sqrt(len(times)))
        wander.append(walk)
    return times, read, [f * (1 + gain) + w + rng.gauss(0, sensor) for f, w in zip(force, wander)]


def rms_change(protocol, knobs, base):
    square, count, top = 0.0, 0, 0.0
    for run in runs_of(protocol):
        a, b = samples(run, knobs)[2], samples(run, base)[2]
        square += sum((x - y) ** 2 for x, y in zip(a, b))
        count += len(a)
        top = max(top, max(b))
    return 100 * math.sqrt(square / count) / top


def knobs_for(protocol, effects, size, scale):
    base = {"scale": scale}
    knobs = dict(base)
    for name in effects:
        if name == "saturation":
            top = max(max(samples(run, base)[2]) for run in runs_of(protocol))
            low, high = 0.2, 1.0  # share of the largest force
            for _ in range(20):
                middle = 0.5 * (low + high)
                if rms_change(protocol, {**base, name: middle * top}, base) > size:
                    low = middle
                else:
                    high = middle
            knobs[name] = low * top
            continue
        amplitude = UNITS[name]
        for _ in range(3):  # nearly linear
            amplitude *= size / max(rms_change(protocol, {**base, name: amplitude}, base), 1e-9)
        knobs[name] = amplitude
    return knobs


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--protocol", default="short", choices=["ramp", "short", "battery"])
    parser.add_argument("--effect", default="none")
    parser.add_argument("--size", type=float, default=5.0)
    parser.add_argument("--repeatability", type=float, default=1.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--answers", type=pathlib.Path)
    a = parser.parse_args()
    rng = random.Random(a.seed)
    effects = [] if a.effect == "none" else a.effect.split("+")
    knobs = knobs_for(a.protocol, effects, a.size, HEIGHT / 3 * 0.6)
    a.folder.mkdir(parents=True)
    text = (f'schema = "palpate-set/1"\n\n[specimen]\nid = "S{a.seed}"\nshape = "cylinder"\nradius_mm = 80.0\nheight_mm = {HEIGHT}\nbase = "bonded"\n'
            'law = "neo_hookean"\n\n[rig]\ncompliance_mm_per_N = "unknown"\n\n[tool.t5]\nkind = "ball"\nradius_mm = 5.0\n\n[tool.t2]\nkind = "ball"\nradius_mm = 2.5\n')
    plan = [(r, "fit") for r in runs_of(a.protocol)]
    plan.append((("h01", 5.0, "short", 1.0, HEIGHT / 3 * 0.5, (0, 0), ""), "holdout"))
    for order, (run, role) in enumerate(plan, 1):
        identity, radius, kind, rate, depth, point, group = run
        times, read, force = samples(run, knobs, rng, a.repeatability / 100, 0.0005)
        with open(a.folder / f"{identity}.csv", "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["t[s]", "u[mm]", "F[N]"])
            writer.writerows([f"{t:.4f}", f"{d:.6f}", f"{f:.7f}"] for t, d, f in zip(times, read, force))
        text += (f'\n[[run]]\nid = "{identity}"\nfile = "{identity}.csv"\ntool = "{"t5" if radius == 5 else "t2"}"\npoint_mm = [{point[0]}.0, {point[1]}.0, {HEIGHT}]\n'
                 f'axis = [0, 0, -1]\nzero = "geometry"\norder = {order}\nrate_mm_s = {rate}\nrole = "{role}"\n' + (f'replicate = "{group}"\n' if group and role == "fit" else ""))
    (a.folder / "set.toml").write_text(text)
    if a.answers:
        with open(a.answers, "a") as file:
            file.write(json.dumps({"set": a.folder.name, "effects": effects, "size": a.size, "repeatability": a.repeatability, "protocol": a.protocol,
                                   "seed": a.seed, "knobs": {k: v for k, v in knobs.items() if k != "scale"}}) + "\n")


main()

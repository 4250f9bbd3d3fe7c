#!/usr/bin/env python3
# Makes sets of a clamped tube with something hidden in it: palpate-solve closes and opens finer, slower walls than the loop solves, noise is added,
# and the answers go to a file of their own.
# SPDX-License-Identifier: GPL-3.0-or-later
#   clamp.py BIN SOLVES FOLDER [--effects none,zone,viscosity,friction,jaw_angle] [--seed N] [--nulls N] [--repeatability PERCENT] [--coarse] [--sites MM,MM] [--ends fixed]
# BIN: the executables. SOLVES: curves are kept there. FOLDER gets one set per effect, and answers.jsonl. --coarse: one place and a coarse
# mesh, for tests. Time: the solver's, times SCALE; a quasi-static wall knows no other time than its relaxation.
import argparse
import csv
import json
import math
import pathlib
import random
import subprocess

DIAMETER, MU, SCALE = 25.0, 0.25, 100.0  # mm, MPa (of the solves; each set has its own), s per s
SENSOR = 0.002  # N


class Rig:
    """Where the jaws close, on which mesh, how far."""
    def __init__(self, coarse, sites):
        self.length, self.sites, self.wall = (40.0, [20.0], 2.4) if coarse else (80.0, [24.0, 40.0, 56.0], 1.2)
        self.sites = sites or self.sites
        self.edges = (3.6, 4.4) if coarse else (2.0, 3.2)  # at the jaws, elsewhere
        self.edges_slow = (4.5, 4.5) if coarse else (3.3, 4.4)  # of runs with relaxation, which take ten times as long
        self.set_edge = 4.8 if coarse else 3.0
        self.gap, self.gap_sealed, self.speed, self.hold_s = (7.0, 9.0, 180.0, 0.06) if coarse else (3.8, 6.0, 180.0, 0.1)


def call(*words):
    subprocess.run([str(w) for w in words], check=True, stdout=subprocess.DEVNULL)


def along(card, low, high):
    """Places along z as palpate-mesh counts them, along its centre line, which may begin at either end."""
    points = json.loads(card.read_text())["notes"]["centre_line"]["points_mm"]
    start, way = points[0][2], 1 if points[-1][2] > points[0][2] else -1
    return sorted(way * (z - start) for z in (low, high))


def mesh(a, rig, knobs, site):
    """A wall fine at `site`, with its zone."""
    tube, edges = a.solves / f"tube-{rig.length:g}.vtp", rig.edges_slow if "g" in knobs else rig.edges
    if not tube.exists():
        call(a.bin / "palpate-idealize", tube, "--diameter", DIAMETER, "--length", rig.length, "--edge", 1.3, "--quiet")
    words, name = [], f"wall-{rig.length:g}-{site:g}-{edges[0]}"
    if "excess" in knobs:
        plain = mesh(a, rig, {key: value for key, value in knobs.items() if key == "g"}, site)
        low, high = along(plain.with_suffix(".vtu.card.json"), knobs["place"] - knobs["half"], knobs["place"] + knobs["half"])
        words, name = [f"--zone={low},{high},{1 + knobs['excess']}", "--zone-edge", 1], f"{name}-{low:.3f}-{high:.3f}-{knobs['excess']:.4f}"
    file = a.solves / f"{name}.vtu"
    if not file.exists():
        call(a.bin / "palpate-mesh", tube, file, "--kind", "shell", "--thickness", rig.wall, "--offset", -rig.wall / 2, "--edge", edges[1], f"--focus=0,0,{site}",
             "--focus-edge", edges[0], "--focus-radius", 11, "--jaws-axis=0,-1,0", "--quiet", *words)
    return file


def closed(a, name, wall, text, speed):
    """Slower where the wall swings too much."""
    for slower in (1, 2, 4):
        (a.solves / f"{name}.toml").write_text(text.replace("SPEED", f"{speed / slower}"))
        try:
            return call(a.bin / "palpate-solve", a.solves / f"{name}.toml", a.solves / name, "--mesh", wall, "--quiet", "--threads", 1)
        except subprocess.CalledProcessError:
            if slower == 4 or "prony" in text:  # which would make time another one
                raise


def curve(a, rig, knobs, site, gap, slower=1):
    """Rows (t, u, F) of a closing and opening: u = declared diameter less the gap between the jaws."""
    wall = mesh(a, rig, knobs, site)
    name = f"{wall.stem}-{gap:g}" + ("" if a.ends == "section" else f"-{a.ends}") + "".join(f"-{k}{knobs[k]:.4f}" for k in ("mu_jaws", "angle_deg", "g", "tau_s") if k in knobs) + (f"-x{slower}" if "g" in knobs else "")
    folder = a.solves / name
    if not (folder / "history.csv").exists():
        text = (f'schema = "palpate-case/1"\nscheme = "explicit"\nends = "{a.ends}"\n[material]\nlaw = "neo_hookean"\nmu = {MU}\n[clamp]\ncentre_mm = [0, 0, {site}]\nopen_mm = {DIAMETER + 1.5}\n'
                f'speed_mm_s = SPEED\ngap_mm = {gap}\nhold_s = {rig.hold_s}\nopens = true\nangle_deg = {knobs.get("angle_deg", 0)}\n')
        if "mu_jaws" in knobs:
            text += f'friction = {knobs["mu_jaws"]}\nself_friction = {knobs["mu_jaws"]}\n'
        text += "[steps]\nframes = 1\nrows = 240\nkinetic_part = 0.045\n"
        if "g" in knobs:
            text += f'[[effect]]\nname = "prony"\ng = {knobs["g"]}\ntau_s = {knobs["tau_s"] / SCALE / slower}\n'
        closed(a, name, wall, text, rig.speed)
    with open(folder / "history.csv") as file:
        rows = [(SCALE * slower * float(r["t[s]"]), DIAMETER - float(r["gap[mm]"]), float(r["F[N]"])) for r in csv.DictReader(file)]
    # a row's force is the mean since the row before
    rows = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2, b[2]) for a, b in zip(rows, rows[1:])]
    return sampled(still(rows, 0.1 * knobs["tau_s"] if "g" in knobs else 1e9))


def still(rows, rest_s):
    """Without the vibrations of the explicit scheme, which no clamp shows: means over 0.4 mm of closure on either side in motion, over `rest_s` at rest."""
    top, out = max(u for _, u, _ in rows), []
    phase = [0 if u < top - 1e-6 and t < rows[len(rows) // 2][0] else 2 if u < top - 1e-6 else 1 for t, u, _ in rows]
    for i, (t, u, f) in enumerate(rows):
        near = [j for j in range(len(rows)) if phase[j] == phase[i] and (abs(rows[j][0] - t) <= rest_s if phase[i] == 1 else abs(rows[j][1] - u) <= 0.4)]
        reach = min(near[-1] - i, i - near[0]) if phase[i] != 1 else len(rows)  # even on both sides, so that a slope stays
        near = [j for j in near if abs(j - i) <= reach]
        out.append((t, u, sum(rows[j][2] for j in near) / len(near)))
    return out


def sampled(rows):
    """At even times, from where the wall may be touched until it is let go."""
    top = max(range(len(rows)), key=lambda i: rows[i][1])
    rows = [r for i, r in enumerate(rows) if r[1] > (-0.5 if i < top else 0.5)]
    out, k, count = [], 0, 240
    for i in range(count):
        t = rows[0][0] + (rows[-1][0] - rows[0][0]) * i / (count - 1)
        while k + 2 < len(rows) and rows[k + 1][0] < t:
            k += 1
        (a, ua, fa), (b, ub, fb) = rows[k], rows[k + 1]
        x = min(max((t - a) / max(b - a, 1e-12), 0), 1)
        out.append((t - rows[0][0], ua + x * (ub - ua), fa + x * (fb - fa)))
    return out


def hidden(effect, rng):
    """What is in a set."""
    if effect == "zone":
        return {"place": rng.uniform(34, 46), "half": rng.uniform(8, 12), "excess": rng.uniform(0.25, 0.4)}
    if effect == "viscosity":
        return {"g": rng.uniform(0.15, 0.35), "tau_s": rng.uniform(2, 6)}
    return {"none": {}, "friction": {"mu_jaws": rng.uniform(0.25, 0.5)}, "jaw_angle": {"angle_deg": rng.uniform(2, 4)}}[effect]


def noisy(rng, rows, repeatability):
    """Gain from run to run, a line or a bend in time, a sensor with heavy tails."""
    top, gain, slope, bend = max(f for _, _, f in rows), rng.gauss(0, repeatability), rng.gauss(0, 0.2 * repeatability), rng.choice((0, 1))
    out = []
    for i, (t, u, f) in enumerate(rows):
        x = i / len(rows)
        out.append((t, u, f * (1 + gain) + top * slope * (math.sin(math.pi * x) if bend else x) + SENSOR * rng.gauss(0, 1) / math.sqrt(rng.gammavariate(4, 0.25))))
    return out


def runs_of(rig, knobs):
    """(name, site, gap, slower, replicate, role) of each run."""
    middle = rig.sites[len(rig.sites) // 2]
    sites = [middle] if "g" in knobs else rig.sites  # relaxation is dear to solve, and the same everywhere
    runs = [(f"{'abc'[i]}{k}", z, rig.gap, 1, f"g{i}", "fit") for i, z in enumerate(sites) for k in (1, 2, 3)]
    return runs + [(f"s{k}", middle, rig.gap, 10, "slow", "fit") for k in (1, 2)] + [("h1", middle, rig.gap_sealed, 3, "", "holdout")]


def write_set(a, rig, name, effect, seed):
    rng = random.Random(seed)
    knobs, mu = hidden(effect, rng), rng.uniform(0.1, 0.4)
    if effect == "zone" and len(rig.sites) == 1:
        knobs["place"] += rig.sites[0] - 40  # beside the middle, under the jaws
    folder = a.folder / name
    folder.mkdir(parents=True)
    text = (f'schema = "palpate-set/1"\n\n[specimen]\nid = "{name}"\nshape = "tube"\ndiameter_mm = {DIAMETER}\nlength_mm = {rig.length}\nwall_mm = {rig.wall}\nedge_mm = {rig.set_edge}\nends = "{a.ends}"\n'
            'law = "neo_hookean"\n\n[rig]\ncompliance_mm_per_N = 0.0\n\n[tool.jaws]\nkind = "jaws"\nwidth_mm = 40.0\nlength_mm = 10.0\n')
    for order, (run, site, gap, slower, group, role) in enumerate(runs_of(rig, knobs)):
        rows = noisy(rng, [(t, u, f * mu / MU) for t, u, f in curve(a, rig, knobs, site, gap, slower)], a.repeatability / 100)
        with open(folder / f"{run}.csv", "w", newline="") as file:
            csv.writer(file).writerows([("t[s]", "u[mm]", "F[N]")] + [(f"{t:.4f}", f"{u:.5f}", f"{f:.6f}") for t, u, f in rows])
        text += (f'\n[[run]]\nid = "{run}"\nfile = "{run}.csv"\ntest = "clamp"\ntool = "jaws"\npoint_mm = [0.0, 0.0, {site}]\norder = {order + 1}\nrest_before_s = 600\nrole = "{role}"\n'
                 + (f'replicate = "{group}"\n' if group else ""))
    (folder / "set.toml").write_text(text)
    with open(a.folder / "answers.jsonl", "a") as file:
        file.write(json.dumps({"set": name, "effect": effect, "mu": mu, "knobs": knobs}) + "\n")


def main():
    parser = argparse.ArgumentParser()
    for name in ("bin", "solves", "folder"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--effects", default="none,zone,viscosity,friction,jaw_angle")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--nulls", type=int, default=1, help="sets without effect")
    parser.add_argument("--repeatability", type=float, default=1.0)
    parser.add_argument("--coarse", action="store_true")
    parser.add_argument("--sites", type=lambda text: [float(z) for z in text.split(",")], help="where the jaws close, mm along the tube; the middle one of the list is also closed slowly, and sealed")
    parser.add_argument("--ends", default="section", choices=("section", "fixed"), help="of the tube: free to slide along its centre line, or held")
    a = parser.parse_args()
    a.solves.mkdir(parents=True, exist_ok=True)
    rig, number = Rig(a.coarse, a.sites), 0
    for effect in a.effects.split(","):
        for _ in range(a.nulls if effect == "none" else 1):
            number += 1
            write_set(a, rig, f"set{number:02d}", effect, 1000 * a.seed + number)


main()

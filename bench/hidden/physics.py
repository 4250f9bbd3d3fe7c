# Forces of a pressed layer with an effect in it, by another route than the loop's: elastic curves solved by GetFEM (curves.py), annuli of equal
# width in contact radius, backward Euler, Ogden-Roxburgh per annulus, tables instead of springs.
# SPDX-License-Identifier: GPL-3.0-or-later
import csv
import math
import pathlib

HEIGHT = 20.0  # mm
SENSOR = 0.0005  # N


def read_curves():
    """(effect, amplitude, radius) -> (roots of depth, force over depth^1.5)."""
    curves = {}
    with open(pathlib.Path(__file__).with_name("curves.csv")) as file:
        for row in csv.DictReader(file):
            depth, force = float(row["depth[mm]"]), float(row["force[N]"])
            points = curves.setdefault((row["effect"], float(row["amplitude"]), float(row["radius[mm]"])), [])
            points.append((math.sqrt(depth), force / depth**1.5))
    return curves


def read_radii():
    """Radius of the ball -> (root of depth, contact radius over that root)."""
    radii = {}
    with open(pathlib.Path(__file__).with_name("contact_radii.csv")) as file:
        for row in csv.DictReader(file):
            root = math.sqrt(float(row["depth[mm]"]))
            radii.setdefault(float(row["radius[mm]"]), []).append((root, float(row["contact_radius[mm]"]) / root))
    return radii


CURVES, RADII = read_curves(), read_radii()


def cubic(points, x):
    """Through the four points nearest to x, or fewer where there are no more."""
    i = next((k for k in range(1, len(points)) if points[k][0] >= x), len(points) - 1)
    near = points[max(0, min(i - 2, len(points) - 4)) :][:4]
    total = 0.0
    for a, (xa, ya) in enumerate(near):
        for b, (xb, _) in enumerate(near):
            if a != b:
                ya *= (x - xb) / (xa - xb)
        total += ya
    return total


def solved(depth, key):
    """Force by GetFEM: cubic in the root of depth; below the first point as at it."""
    points, x = CURVES[key], math.sqrt(depth)
    return (points[0][1] if x <= points[0][0] else cubic(points, x)) * depth**1.5


def changed_by(effect, amplitude, radius, depth):
    """Solved force with the effect over that without, linear in between solved amplitudes (and beyond the last one)."""
    solved_ones = sorted((a for e, a, r in CURVES if e == effect and r == radius), key=abs)
    before = 0.0
    for at in solved_ones:
        if abs(at) >= abs(amplitude) or at == solved_ones[-1]:
            break
        before = at
    none = solved(depth, ("none", 0.0, radius))
    low = solved(depth, (effect, before, radius)) / none if before else 1.0
    high = solved(depth, (effect, at, radius)) / none
    return low + (high - low) * (amplitude - before) / (at - before)


def elastic(depth, run, knobs):
    """GetFEM's curve, times what each effect that it has solved changes; prestress by a tension, 3 N/mm per unit."""
    if depth <= 0:
        return 0.0
    radius = run["radius"]
    force = solved(depth, ("none", 0.0, radius))
    for effect in ("thickness", "compressibility", "stiffening", "capsule", "support"):
        if knobs.get(effect):
            force *= changed_by(effect, knobs[effect], radius, depth)
    if knobs.get("narrow"):  # a cylinder of that radius
        force *= solved(depth, ("narrow", knobs["narrow"], radius)) / solved(depth, ("none", 0.0, radius))
    if knobs.get("inclusion") and run["point"] == (25, 0):
        force *= changed_by("inclusion", knobs["inclusion"], radius, depth)
    return force + knobs.get("prestress", 0) * 3 * depth


def path(run, step):
    """Times and depths of a run's programme."""
    kind, rate, depth = run["kind"], run["rate"], run["depth"]
    shares = {"short": (1, 1), "long": (1, 1, 1), "growing": (0.4, 0.7, 1), "retract": (1,), "air": (1,)}[kind]
    points = [(0.0, 0.0)]
    for share in shares:
        t, ramp = points[-1][0], share * depth / rate
        points += [(t + ramp, share * depth), (t + ramp + 10, share * depth), (t + 2 * ramp + 10, 0.0), (t + 2 * ramp + (30 if kind == "growing" else 20), 0.0)]
    if kind == "retract":
        points = points[:-1] + [(points[-2][0] + 1.5 / rate, -1.5)]
    if kind == "air":
        points = [(t, d - depth - 5) for t, d in points]
    times, depths, i = [], [], 0
    for k in range(int(points[-1][0] / step + 1e-9) + 1):
        t = k * step
        while i + 2 < len(points) and t > points[i + 1][0]:
            i += 1
        (t0, d0), (t1, d1) = points[i], points[i + 1]
        times.append(t)
        depths.append(d0 + (d1 - d0) * min(max((t - t0) / (t1 - t0), 0), 1))
    return times, depths


def relaxed(times, depths, run, knobs):
    """Elastic, then with memory. Prony: every increment of an annulus relaxes for itself, on annuli of equal width in a (not in depth)."""
    g, tau = knobs.get("prony", 0), knobs.get("tau", 5.0)
    inverse_r, width, kept_set = knobs.get("mullins", 0), knobs.get("mullins_m", 0.35) * knobs["scale"], knobs.get("permanent_set", 0)
    deepest = max(max(depths) * 1.01, 1e-6)
    count = 90 if g or inverse_r or kept_set else 600
    edges = [deepest * (i / count) ** 2 for i in range(count + 1)]  # equal steps of contact radius
    forces = [elastic(e, run, knobs) for e in edges]
    if count == 600:  # a table of the elastic curve, at the middle of each interval
        def read(d):
            x = math.sqrt(max(d, 0) / deepest) * count
            i = min(int(x), count - 1)
            return forces[i] + (forces[i + 1] - forces[i]) * (d - edges[i]) / (edges[i + 1] - edges[i]) if d > 0 else 0.0
        return [read(d) for d in depths]
    slopes = [(forces[i + 1] - forces[i]) / (edges[i + 1] - edges[i]) for i in range(count)]
    weights = [slopes[0]] + [slopes[i] - slopes[i - 1] for i in range(1, count)]
    stretch, dash, top = [0.0] * count, [0.0] * count, [0.0] * count
    out, before, reached = [], times[0], 0
    for t, depth in zip(times, depths):
        kept, total = 1 / (1 + (t - before) / tau), 0.0  # backward Euler, where the loop is exponential
        while reached < count and edges[reached] < depth:
            reached += 1
        for i in range(reached):
            e = depth - edges[i]
            moved = kept * (dash[i] + e - stretch[i])
            f, high = (1 - g) * e + g * moved, max(top[i], e)
            lost = inverse_r * math.erf((high**2 - e * e) / (2 * width * width)) if inverse_r and e > 0 else 0
            p = kept_set * high
            f = f * (1 - lost) - p
            if f <= 0:
                e = (p + g * kept * (stretch[i] - dash[i])) / (1 - g + g * kept)
                dash[i] = kept * (dash[i] + e - stretch[i])
                stretch[i] = e
                continue
            dash[i], stretch[i], top[i] = moved, e, high
            total += weights[i] * f
        out.append(total)
        before = t
    return out


def reached_by_tool(depths, run, knobs):
    """Depth read to the tool's depth through offset and play."""
    depths = [d + knobs.get("contact_offset", 0) for d in depths]
    if knobs.get("backlash"):
        at = 0.0
        for i, d in enumerate(depths):
            at = min(max(at, d), d + knobs["backlash"])
            depths[i] = at
    return depths


def fitted(points, degree):
    """Coefficients of the polynomial of least squares, lowest first, by its normal equations."""
    rows = [[sum(x ** (i + j) for x, _ in points) for j in range(degree + 1)] + [sum(y * x**i for x, y in points)] for i in range(degree + 1)]
    for i in range(degree + 1):  # Gauss and Jordan
        row = [v / rows[i][i] for v in rows[i]]
        rows = [row if k == i else [v - r[i] * w for v, w in zip(r, row)] for k, r in enumerate(rows)]
    return [row[-1] for row in rows]


def at(polynomial, x):
    return sum(c * x**k for k, c in enumerate(polynomial))


def slope(polynomial):
    return [k * c for k, c in enumerate(polynomial)][1:]


def sticking(depths, run, knobs):
    """Force beyond the elastic one on the way back, where the contact holds on until its edge's energy release D^2 K'(a)/(4 pi a) reaches the work of adhesion (Maugis and Barquins 1978), D
    how far the tool is drawn back; on the way in none. K is the solved curve's, K'/K that of a flat punch on the layer at small strain (Dhaliwal and Rau 1970, as a cubic). A contact is
    known by s, the root of the depth at which it is as wide without adhesion: force and radius are smooth in s."""
    work = 1e-3 * knobs["adhesion"]
    places = [s for s, _ in CURVES["none", 0.0, run["radius"]]]
    force = [0, 0, 0] + fitted([(s, elastic(s * s, run, knobs) / s**3) for s in places], 5)
    radius = [0] + fitted(RADII[run["radius"]], 3)
    stiffness = [c / 2 for c in slope(force)[1:]]  # dF/dd
    punch = [0, 1, 1.1230, 1.3332, 0.3431]  # a/h times a punch's force over that on a half-space

    def drawn(s):
        a = at(radius, s)
        return math.sqrt(4 * math.pi * work * a * at(punch, a / HEIGHT) * HEIGHT / (at(stiffness, s) * at(slope(punch), a / HEIGHT))) if s > 0 else 0.0

    neck = lambda s: s * s - drawn(s)
    pulled_off = min((k / 400 * places[-1] for k in range(401)), key=neck)  # where the neck is longest
    s, extra = 0.0, []
    for d in depths:
        s = max(s, math.sqrt(d)) if d > 0 else s
        if s > 0 and neck(s) > d:  # it shrinks: the larger root
            low, high = pulled_off, s
            if neck(low) > d or low > s:
                s = 0.0
            else:
                for _ in range(50):
                    middle = 0.5 * (low + high)
                    low, high = (middle, high) if neck(middle) < d else (low, middle)
                s = low
        extra.append(at(force, s) - at(stiffness, s) * (s * s - d) - at(force, math.sqrt(max(d, 0))) if s > 0 else 0.0)
    return extra


def contact(times, depths, force, run, knobs):
    """Friction with an arctangent slip law, a logarithmic rate, adhesion, and what no catalogue holds."""
    if knobs.get("adhesion"):
        force = [f + e for f, e in zip(force, sticking(depths, run, knobs))]
    step, radius = times[1] - times[0], run["radius"]
    s, before, fresh = 0.0, 0.0, run["fresh"]
    for i, d in enumerate(depths):
        if knobs.get("friction"):
            s = max(-1.0, min(1.0, s + (d - before) / (0.04 * max(d, before, 1e-9)))) if d > 0 else 0.0
            force[i] *= 1 + 0.59 * knobs["friction"] * math.sqrt(max(d, 0) / radius) * math.tanh(1.5 * s) / math.tanh(1.5)
        if knobs.get("rate") and i:
            v = (d - before) / step / knobs["scale"]
            force[i] *= 1 + knobs["rate"] * math.copysign(math.log1p(abs(v) / 0.01), v)
        before = d
        force[i] += knobs.get("hum", 0) * math.sin(2 * math.pi * 0.37 * times[i])
        force[i] *= 1 + knobs.get("stick_slip", 0) * ((d / 0.7) % 1 - 0.5)
        fresh = fresh and d <= 0.8 * knobs["scale"]  # punctured once, and from then on
        force[i] *= 1 - (0 if fresh else knobs.get("puncture", 0))
    return force


def read_off(times, force, run, knobs):
    """What the cell shows: gain, tare, drift since the run began, a late channel, an upper limit."""
    step = times[1] - times[0]
    force = [f * (1 + knobs.get("gain", 0)) * math.cos(knobs.get("tool_pose", 0)) + knobs.get("tare", 0) + knobs.get("drift", 0) * (t - times[0])
             for f, t in zip(force, times)]
    if knobs.get("lag"):
        late, last = [force[0]], force[0]
        for f in force[1:]:
            y = late[-1]
            for k in range(10):  # sub-steps of Euler, where the loop is exact
                y += step / 10 / max(knobs["lag"], step / 10) * (last + (f - last) * (k + 0.5) / 10 - y)
            late.append(y)
            last = f
        force = late
    return [min(f, knobs["saturation"]) for f in force] if knobs.get("saturation") else force


def force_of(times, read, run, knobs):
    """Depth read to force read."""
    if run["kind"] == "air":
        return read_off(times, [0.0] * len(times), run, knobs)
    depths = reached_by_tool(read, run, knobs)
    if knobs.get("breathing"):
        depths = [d + knobs["breathing"] * math.sin(2 * math.pi * 0.21 * t + run["order"]) for d, t in zip(depths, times)]
    tissue = lambda at: contact(times, at, relaxed(times, at, run, knobs), run, knobs)
    force, c = tissue(depths), knobs.get("rig_compliance", 0)
    for _ in range(8 if c else 0):  # the rig gives way by c F: a contraction, c dF/dd is near 0.2
        force = tissue([d - c * f for d, f in zip(depths, force)])
    return read_off(times, force, run, knobs)


def noise(rng, times, force, repeatability, limit):
    """Gain and slow wandering from run to run (a random walk, a line or a bend, by chance), the cell's limit, and a sensor with heavy tails."""
    top, kind = max(max(map(abs, force)), 1e-3), rng.choice(("walk", "line", "bend"))
    wander, at = [], 0.0
    slope = rng.gauss(0, 0.2 * repeatability * top)
    for i in range(len(times)):
        x = i / len(times)
        at += rng.gauss(0, 0.2 * repeatability * top / math.sqrt(len(times)))
        wander.append(at if kind == "walk" else slope * x if kind == "line" else slope * math.sin(math.pi * x))
    gain = rng.gauss(0, repeatability)
    return [min(f * (1 + gain) + w, limit) + SENSOR * rng.gauss(0, 1) / math.sqrt(rng.gammavariate(4, 0.25)) for f, w in zip(force, wander)]

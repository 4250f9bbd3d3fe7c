#!/usr/bin/env python3
# Makes palpate-loop sets from the measured data outside this repository: silicone, beef, pork, rubber, brain. Nothing of it is kept here.
# SPDX-License-Identifier: GPL-3.0-or-later
#   make.py DATA OUT      DATA: the folder that holds measured/; OUT: a new folder, one sub-folder per set
import csv
import pathlib
import sys

data, out = pathlib.Path(sys.argv[1], "measured"), pathlib.Path(sys.argv[2])


def write(folder, text, tables):
    folder.mkdir(parents=True)
    (folder / "set.toml").write_text(text)
    for name, (header, rows) in tables.items():
        with open(folder / name, "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(header)
            writer.writerows(rows)


def indentation(path):
    """Rows t, u, F, and the thickness at the tool's start."""
    rows = [[float(x) for x in row] for row in list(csv.reader(open(path)))[1:]]
    return [(t, u, F) for t, F, u, gap in rows], rows[0][3]


def indentation_set(name, files, roles, replicate, radius_mm=5.0):
    runs, tables, heights = [], {}, []
    for number, (file, role) in enumerate(zip(files, roles), 1):
        rows, height = indentation(file)
        heights.append(height)
        tables[file.name] = (["t[s]", "u[mm]", "F[N]"], rows)
        same = f'replicate = "{replicate}"\n' if replicate and role == "fit" else ""
        runs.append(f'[[run]]\nid = "{file.stem}"\nfile = "{file.name}"\nzero = "tool_start"\nzero_sd_mm = 1.0\norder = {number}\nrole = "{role}"\n{same}')
    height = sum(heights) / len(heights)
    text = (f'schema = "palpate-set/1"\n\n[specimen]\nid = "{name}"\nshape = "block"\nheight_mm = {height:.3f}\nbase = "sliding"\nlaw = "neo_hookean"\n\n'
            f'[tool.ball]\nkind = "ball"\nradius_mm = {radius_mm}\n\n' + "\n".join(runs))
    write(out / name, text, tables)


def homogeneous_set(name, runs, law="neo_hookean"):
    """runs: (id, test, role, rows of stretch and MPa)."""
    tables = {f"{i}.csv": (["stretch[1]", "P[MPa]"], rows) for i, _, _, rows in runs}
    text = f'schema = "palpate-set/1"\n\n[specimen]\nid = "{name}"\nlaw = "{law}"\n'
    for i, test, role, _ in runs:
        text += f'\n[[run]]\nid = "{i}"\nfile = "{i}.csv"\ntest = "{test}"\nrole = "{role}"\n'
    write(out / name, text, tables)


def numbers(path):
    return [[float(x) for x in line.replace(",", " ").split()] for line in path.read_text().splitlines() if line.strip()]


def silicone():
    folder = data / "silicone_indentation"
    files = [folder / f"230515-P002-{n}.csv" for n in (9, 10, 11, 4, 8)]
    indentation_set("silicone", files, ["fit"] * 3 + ["holdout"] * 2, "5mm")


def beef():
    for file in sorted((data / "beef_indentation").glob("230407_*.csv")):
        indentation_set("beef_" + file.stem.split("_", 1)[1], [file], ["fit"], "")


def pork():
    for row in csv.DictReader(open(data / "pork_tension" / "SPECIMENS.csv")):
        path = data / "pork_tension" / row["file"]
        if not path.exists() or not row["gauge_length_mm"]:
            continue
        length, area = float(row["gauge_length_mm"]), float(row["width_mm"]) * float(row["thickness_mm"])
        rows = [[float(x) for x in r] for r in list(csv.reader(open(path)))[1:]]
        peak = max(range(len(rows)), key=lambda i: rows[i][2])
        kept = rows[: max(peak * 9 // 10, 8)]  # failure is no part of a law
        table = [(f"{t:.3f}", f"{1 + u / length:.6f}", f"{F / area:.8f}") for t, u, F in kept]
        text = (f'schema = "palpate-set/1"\n\n[specimen]\nid = "{path.stem}"\nlaw = "neo_hookean"\n\n'
                f'[[run]]\nid = "tension"\nfile = "tension.csv"\ntest = "uniaxial"\n')
        write(out / ("pork_" + path.stem), text, {"tension.csv": (["t[s]", "stretch[1]", "P[MPa]"], table)})


def rubber():
    for name in ("Treloar_1944", "Kawabata_1981", "Meunier_2008"):
        runs = []
        for short, test in (("UT", "uniaxial"), ("ET", "equibiaxial"), ("PS", "pure_shear")):
            rows = [(stretch, stress) for stress, stretch in numbers(data / "published_curves" / name / short / "stress_stretch.txt")]
            runs.append((short, test, "fit" if short == "UT" else "holdout", rows))
        homogeneous_set(name, runs)


def brain():
    folder = data / "published_curves" / "elastic-brain-tissue-data"
    for region in ("basal_ganglia", "corona_radiata", "corpus_callosum", "cortex"):
        shear = region if region != "basal_ganglia" else "basal_gangila"
        runs = []
        for i, test, role, path in (("tension", "uniaxial", "fit", folder / "uniaxial_tension" / f"{region}.txt"),
                                    ("compression", "uniaxial", "fit", folder / "compression" / f"{region}.txt"),
                                    ("shear", "simple_shear", "holdout", folder / "simple-shear" / f"{shear}.txt")):
            runs.append((i, test, role, [(x, kPa / 1000) for x, kPa in numbers(path)]))
        homogeneous_set("brain_" + region, runs)


silicone()
beef()
pork()
rubber()
brain()

# Figures of the sweep against the colon paper's: growth from 0.8 to 2 mm. Reads RESULT/<shape>-<wall>/summary.json.
# SPDX-License-Identifier: GPL-3.0-or-later
import json
import pathlib
import sys

folder = pathlib.Path(sys.argv[1])
paper = {"cylinder": (115, 80), "colon": (52, 36)}
lines = ["| shape | wall mm | last force N | peak force N | max von Mises MPa | 99.5 % MPa | max strain | 99.5 % | mean contact MPa | peak contact MPa | kinetic % | balance % |",
         "|---" * 12 + "|"]
growth = []
for shape, (stress, strain) in paper.items():
    runs = sorted((float(p.parent.name.split("-")[1]), json.loads(p.read_text())) for p in folder.glob(f"{shape}-*/summary.json"))
    for wall, s in runs:
        lines.append(f"| {shape} | {wall:g} | {s['last_force_N']:.3f} | {s['peak_force_N']:.3f} | {s['max_von_mises_MPa']:.3f} | {s['von_mises_995_MPa']:.3f} | "
                     f"{s['max_strain']:.3f} | {s['strain_995']:.3f} | {s['contact_pressure_MPa']['mean']:.4f} | {s['contact_pressure_MPa']['peak']:.3f} | "
                     f"{100 * s['kinetic_part']:.2f} | {100 * s['energy_imbalance_part']:.3f} |")
    if len(runs) > 1:
        first, last = runs[0][1], runs[-1][1]
        grown = lambda key: 100 * (last[key] / first[key] - 1)
        growth.append(f"| {shape} | {runs[0][0]:g} → {runs[-1][0]:g} | {stress} | {grown('max_von_mises_MPa'):.0f} ({grown('von_mises_995_MPa'):.0f}) | "
                      f"{strain} | {grown('max_strain'):.0f} ({grown('strain_995'):.0f}) |")
lines += ["", "Growth in %, in brackets that of the value below which 99.5 % of the wall lie:", "",
          "| shape | wall mm | stress, paper | stress, ours | strain, paper | strain, ours |", "|---|---|---|---|---|---|", *growth]
text = "\n".join(lines) + "\n"
(folder / "table.md").write_text(text)
print(text)

# Processor time and memory of a step against nodes, from docs/solver_speed.csv to docs/solver_speed.svg.
# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 bench/plot_speed.py docs/solver_speed.csv docs/solver_speed.svg

Columns: nodes, processor_s_per_step, peak_GB. Both axes logarithmic; one line for each column but the first.
"""
import csv
import math
import sys

WIDTH, HEIGHT, MARGIN = 560, 360, 60
COLOURS = ["#1f5fa8", "#b5452c"]


def main():
    rows = list(csv.reader(open(sys.argv[1])))
    names, values = rows[0], [[float(cell) for cell in row] for row in rows[1:]]
    xs = [math.log10(row[0]) for row in values]
    ys = [math.log10(v) for row in values for v in row[1:]]
    x0, x1, y0, y1 = min(xs) - 0.1, max(xs) + 0.1, math.floor(min(ys)), math.ceil(max(ys))
    px = lambda x: MARGIN + (x - x0) / (x1 - x0) * (WIDTH - 2 * MARGIN)
    py = lambda y: HEIGHT - MARGIN - (y - y0) / (y1 - y0) * (HEIGHT - 2 * MARGIN)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="12">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for y in range(y0, y1 + 1):
        out.append(f'<line x1="{MARGIN}" x2="{WIDTH - MARGIN}" y1="{py(y):.1f}" y2="{py(y):.1f}" stroke="#ccc"/>'
                   f'<text x="{MARGIN - 6}" y="{py(y) + 4:.1f}" text-anchor="end">{10.0 ** y:g}</text>')
    for row in values:
        x = px(math.log10(row[0]))
        out.append(f'<text x="{x:.1f}" y="{HEIGHT - MARGIN + 18}" text-anchor="middle">{row[0]:.0f}</text>')
    out.append(f'<text x="{WIDTH / 2}" y="{HEIGHT - 16}" text-anchor="middle">nodes</text>')
    for k, name in enumerate(names[1:]):
        places = [(px(math.log10(row[0])), py(math.log10(row[k + 1]))) for row in values]
        out.append(f'<polyline fill="none" stroke="{COLOURS[k]}" stroke-width="2" points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in places)}"/>')
        out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{COLOURS[k]}"/>' for x, y in places]
        out.append(f'<text x="{MARGIN + 10}" y="{MARGIN - 30 + 16 * k}" fill="{COLOURS[k]}">{name}</text>')
    with open(sys.argv[2], "w") as file:
        file.write("\n".join(out + ["</svg>\n"]))


main()

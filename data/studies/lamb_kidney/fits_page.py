# The page of ./fits: six curves as SVG, and the table of parameters.
# SPDX-License-Identifier: GPL-3.0-or-later
import html

COLOURS = {"curve": "#000000", "hooke": "#1b6ca8", "neo_hookean": "#4aa3df", "mooney_rivlin_shallow": "#2e8b57", "mooney_rivlin_deep": "#d2691e",
           "exponential": "#b22222"}
WIDTH, HEIGHT, LEFT, BOTTOM = 760, 460, 60, 50


def drawing(depths, forces):
    """Forces (N) over depth (mm); the curve that was fitted as dots."""
    deepest, most = max(depths), 1.05 * max(max(f) for f in forces.values())
    x = lambda d: LEFT + (WIDTH - LEFT - 20) * d / deepest
    y = lambda f: HEIGHT - BOTTOM - (HEIGHT - BOTTOM - 20) * f / most
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for d in range(int(deepest) + 1):
        out.append(f'<path d="M{x(d):.1f} {y(0):.1f}V20" stroke="#ddd"/><text x="{x(d):.1f}" y="{HEIGHT - 28}" text-anchor="middle">{d}</text>')
    for i in range(int(most / 0.2) + 1):
        out.append(f'<path d="M{LEFT} {y(0.2 * i):.1f}H{WIDTH - 20}" stroke="#ddd"/>'
                   f'<text x="{LEFT - 8}" y="{y(0.2 * i) + 4:.1f}" text-anchor="end">{0.2 * i:.1f}</text>')
    out.append(f'<text x="{WIDTH / 2}" y="{HEIGHT - 8}" text-anchor="middle">depth, mm</text>'
               f'<text x="16" y="{HEIGHT / 2}" transform="rotate(-90 16 {HEIGHT / 2})" text-anchor="middle">force, N</text>')
    for i, (name, values) in enumerate(forces.items()):
        colour, label = COLOURS[name], "generated curve (Ogden)" if name == "curve" else name.replace("_", " ")
        points = " ".join(f"{x(d):.1f},{y(f):.1f}" for d, f in zip(depths, values))
        if name == "curve":
            out += [f'<circle cx="{p.split(",")[0]}" cy="{p.split(",")[1]}" r="4" fill="{colour}"/>' for p in points.split()]
        else:
            out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>')
        out.append(f'<rect x="{LEFT + 20}" y="{32 + 20 * i}" width="18" height="4" fill="{colour}"/><text x="{LEFT + 46}" y="{39 + 20 * i}">{label}</text>')
    return "\n".join(out) + "\n</svg>\n"


def page(depths, forces, head, rows, nodes):
    cells = lambda kind, line: "<tr>" + "".join(f"<{kind}>{html.escape(c)}</{kind}>" for c in line) + "</tr>"
    return f"""<!DOCTYPE html>
<html lang="en"><meta charset="utf-8"><title>Lamb kidney: five fits</title>
<style>body {{ font: 16px sans-serif; max-width: 62em; margin: 2em auto; padding: 0 1em }} td, th {{ padding: .3em .6em; text-align: left; border-bottom: 1px solid #ddd }}</style>
<h1>Lamb kidney: five fits to one curve</h1>
<p>As Fig. 3 and Table I of the kidney paper (Computer Aided Surgery 2005). <strong>The curve is generated, not measured:</strong> the paper's numbers are not published as data,
so the dots are forces of our own solver on our own phantom ({nodes} nodes) with an Ogden law of two terms, which none of the five fits contains, without noise.</p>
{drawing(depths, forces)}
<table>{cells("th", head)}{"".join(cells("td", row) for row in rows)}</table>
<p>Errors and their means in per cent of the curve's largest force, over the depths to 3 mm and beyond; a negative mean is too soft.</p>
</html>
"""

# Three organs as spheres of triangles pulled into shape.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Three organs as spheres of triangles pulled into shape: an ovoid ovary, a pear-shaped uterus, a bean-shaped kidney; written as .stl in mm.
"""
import math


def sphere(cuts):
    """An octahedron whose triangles are cut into four, again and again: points on the unit sphere, triangles outward."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    triangles = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(cuts):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                m = [p + q for p, q in zip(points[a], points[b])]
                size = math.sqrt(sum(v * v for v in m))
                middles[key] = len(points)
                points.append(tuple(v / size for v in m))
            return middles[key]

        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = finer
    return points, triangles


def ovary(x, y, z):
    return 15 * x, 10 * y, 9 * z


def uterus(x, y, z):
    """A pear: thick at x > 0, a neck at x < 0."""
    thick = 0.62 + 0.38 * x if x > -0.4 else 0.468
    return 36 * x, 22 * thick * y, 19 * thick * z


def kidney(x, y, z):
    """A bean: its ends bend towards +y."""
    return 29 * x, 17 * y + 9 * x * x, 12.5 * z


SHAPES = {"ovary": ovary, "uterus": uterus, "kidney": kidney}
# Where the tool is aimed (x, y), mm; the edges of tetrahedra elsewhere and under the tool.
AIMS = {"ovary": (1.0, 0.5, 3.2, 1.6), "uterus": (14.0, 1.0, 7.5, 3.6), "kidney": (4.0, 1.5, 6.0, 2.6)}


def write_stl(path, shape, cuts=5):
    points, triangles = sphere(cuts)
    placed = [shape(*p) for p in points]
    with open(path, "w") as out:
        out.write("solid organ\n")
        for triangle in triangles:
            out.write("facet normal 0 0 0\nouter loop\n")
            for corner in triangle:
                out.write("vertex %.9g %.9g %.9g\n" % placed[corner])
            out.write("endloop\nendfacet\n")
        out.write("endsolid organ\n")
    return placed, triangles


def span_along_z(points, triangles, x, y):
    """Lowest and highest z of the surface above (x, y)."""
    heights = []
    for a, b, c in ([points[i] for i in t] for t in triangles):
        det = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        if det == 0:
            continue
        u = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / det
        v = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / det
        if u >= 0 and v >= 0 and u + v <= 1:
            heights.append(a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]))
    return min(heights), max(heights)

# Blocks of tetrahedra as regions "lower" (1) and "upper" (2), and meshes of them: block(low, size, cells, region) adds one, write(name) writes and forgets them.
# SPDX-License-Identifier: GPL-3.0-or-later
points, tets, regions, faces, face_regions = [], [], [], [], []
def block(low, size, cells, region):
    first = len(points)
    n = [c + 1 for c in cells]
    at = lambda i, j, k: first + i + n[0] * (j + n[1] * k)
    for k in range(n[2]):
        for j in range(n[1]):
            for i in range(n[0]):
                points.append([low[d] + size[d] * (i, j, k)[d] / cells[d] for d in range(3)])
    sides = {}
    for k in range(cells[2]):
        for j in range(cells[1]):
            for i in range(cells[0]):
                c = [at(i + a, j + b, k + d) for d in (0, 1) for b in (0, 1) for a in (0, 1)]
                for p in ((1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1)):
                    t = (c[0], c[p[0]], c[p[1]], c[7])
                    tets.append(t)
                    regions.append(region)
                    for f in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)):
                        face = tuple(t[x] for x in f)
                        sides.setdefault(tuple(sorted(face)), []).append(face)
    for face in sides.values():
        if len(face) == 1:
            faces.append(face[0])
            face_regions.append(100 + region)
def write(name):
    cells = tets + faces
    row = lambda lists: " ".join(str(x) for one in lists for x in one)
    offsets, total = [], 0
    for c in cells:
        total += len(c)
        offsets.append(total)
    open(name, "w").write(f'''<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<FieldData>
<Array type="String" Name="SPACE" NumberOfTuples="1" format="ascii">76 80 83 0</Array>
<Array type="String" Name="UNITS" NumberOfTuples="1" format="ascii">109 109 0</Array>
<Array type="String" Name="REGION_NAMES" NumberOfTuples="4" format="ascii">{" ".join(str(b) for name in ("1=lower", "2=upper", "101=lower_surface", "102=upper_surface") for b in list(name.encode()) + [0])}</Array>
</FieldData>
<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{row(points)}</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">{row(cells)}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{row([offsets])}</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">{row([[10] * len(tets) + [5] * len(faces)])}</DataArray></Cells>
<CellData><DataArray type="Int32" Name="region" format="ascii">{row([regions + face_regions])}</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>''')
    for one in (points, tets, regions, faces, face_regions):
        one.clear()

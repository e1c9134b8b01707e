#!/usr/bin/env python3
"""Decimates the Stanford bunny of the npm package `bunny` to a wireframe of 179 struts, 371 mm high.

    npm pack bunny && tar xzf bunny-1.0.1.tgz
    python3 make_wireframe.py package/index.js frame.json

Steps, all in the standard library and without chance, so the same mesh gives the same file:

1. z up, the mesh's lowest part laid flat on z = 0 and the faces inside that footprint removed: the frame
   is open below and its rim stands on the bed.
2. Edges are collapsed, cheapest first (Garland & Heckbert 1997, quadric error), until 179 are left.
   To the error comes a share of the squared edge length, which keeps struts of one order of length. A
   collapse is refused if it would fold a face, make the mesh non-manifold, leave the rim
   or raise a node to a height where its struts would lie flat on the bed.
3. Scaled to 371 mm, centred on its rim, written in the `assembly_instances` format.
"""

import heapq
import json
import math
import re
import sys

EDGES = 179  # Yu et al. 2016, "Final Printing"
HEIGHT_MM = 371.0  # the same
DIAMETER_MM = 4.0  # ours: the paper prints no strut diameter
ORIGIN_MM = (625.0, 0.0, 0.0)  # ours: middle of the rim before a KR 10 R1100
FLAT = 0.045  # share of the height that counts as footprint
LENGTH_WEIGHT = 0.02  # of squared edge length, beside the quadric per unit of area
RIM_WEIGHT = 3.0  # of the planes that hold the rim's outline
LEAST_HEIGHT = 0.10  # of the height: nodes off the bed stay this high


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def read_mesh(path):
    """Points with z up and triangles of the package's index.js, scaled to a height of 1."""
    text = open(path, encoding="utf-8").read()
    points, cells = (
        json.loads(re.search(r"exports\.%s=(\[\[.*?\]\])" % name, text, re.S).group(1))
        for name in ("positions", "cells")
    )
    points = [(x, -z, y) for x, y, z in points]
    low, high = min(p[2] for p in points), max(p[2] for p in points)
    points = [tuple((v - o) / (high - low) for v, o in zip(p, (0, 0, low))) for p in points]
    return points, [tuple(c) for c in cells]


def flatten(points, cells):
    """Lays what is below FLAT on z = 0 and removes the faces that then lie on the bed."""
    points = [(x, y, 0.0 if z < FLAT else z) for x, y, z in points]
    cells = [c for c in cells if any(points[v][2] > 0 for v in c)]
    return points, cells


def plane_quadric(normal, offset, weight):
    a = (*normal, offset)
    return [weight * a[i] * a[j] for i in range(4) for j in range(4)]


def error(quadric, p):
    h = (*p, 1.0)
    return sum(quadric[4 * i + j] * h[i] * h[j] for i in range(4) for j in range(4))


def lowest(quadric, flat, around):
    """Point of least error, held near the middle of the edge where the quadric says little."""
    pull = 1e-3 * (quadric[0] + quadric[5] + quadric[10]) + 1e-12
    size = 2 if flat else 3
    m = [[quadric[4 * i + j] + (pull if i == j else 0.0) for j in range(size)] for i in range(size)]
    r = [pull * around[i] - quadric[4 * i + 3] for i in range(size)]
    for i in range(size):  # elimination; the matrix is positive definite by the pull
        for k in range(i + 1, size):
            f = m[k][i] / m[i][i]
            m[k] = [a - f * b for a, b in zip(m[k], m[i])]
            r[k] -= f * r[i]
    x = [0.0] * size
    for i in reversed(range(size)):
        x[i] = (r[i] - sum(m[i][j] * x[j] for j in range(i + 1, size))) / m[i][i]
    return tuple(x) + ((0.0,) if flat else ())


class Mesh:
    """Triangles with quadrics at the vertices; dead vertices have no faces."""

    def __init__(self, points, cells):
        self.points = list(points)
        self.faces = {i: c for i, c in enumerate(cells)}
        self.faces_at = {v: set() for c in cells for v in c}
        for i, c in self.faces.items():
            for v in c:
                self.faces_at[v].add(i)
        self.stamp = dict.fromkeys(self.faces_at, 0)
        self.edges = len({frozenset(e) for c in cells for e in zip(c, c[1:] + c[:1])})
        self.quadric = {v: [0.0] * 16 for v in self.faces_at}
        for c in cells:
            self.add_face(c)
        self.rim = {v for v in self.faces_at if any(self.on_rim(v, n) for n in self.ring(v))}

    def add_face(self, c):
        p = [self.points[v] for v in c]
        n = cross(sub(p[1], p[0]), sub(p[2], p[0]))
        area = math.sqrt(dot(n, n)) or 1e-30
        n = tuple(x / area for x in n)
        for v in c:
            self.add(v, plane_quadric(n, -dot(n, p[0]), area / 2))
        for a, b in zip(c, c[1:] + c[:1]):
            if self.on_rim(a, b):
                e = sub(self.points[b], self.points[a])
                side = cross(e, (0.0, 0.0, 1.0))
                length = math.sqrt(dot(side, side)) or 1e-30
                side = tuple(x / length for x in side)
                q = plane_quadric(side, -dot(side, self.points[a]), RIM_WEIGHT * length * length)
                self.add(a, q)
                self.add(b, q)

    def add(self, v, q):
        self.quadric[v] = [a + b for a, b in zip(self.quadric[v], q)]

    def ring(self, v):
        return {u for f in self.faces_at[v] for u in self.faces[f]} - {v}

    def on_rim(self, a, b):
        return len(self.faces_at[a] & self.faces_at[b]) == 1

    def candidate(self, a, b):
        """Cost and place of the collapse of an edge, or None where the rim forbids it."""
        if a in self.rim and b in self.rim and not self.on_rim(a, b):
            return None
        q = [x + y for x, y in zip(self.quadric[a], self.quadric[b])]
        pa, pb = self.points[a], self.points[b]
        rim = [v for v in (a, b) if v in self.rim]
        middle = tuple((x + y) / 2 for x, y in zip(pa, pb))
        p = self.points[rim[0]] if len(rim) == 1 else lowest(q, bool(rim), middle)
        e = sub(pa, pb)
        return error(q, p) + LENGTH_WEIGHT * dot(e, e) * (q[0] + q[5] + q[10]), p

    def allowed(self, a, b, p):
        if 0 < p[2] < LEAST_HEIGHT and min(self.points[a][2], self.points[b][2]) >= LEAST_HEIGHT:
            return False
        common = self.ring(a) & self.ring(b)
        if len(common) != (1 if self.on_rim(a, b) else 2):
            return False
        for v, other in ((a, b), (b, a)):
            for f in self.faces_at[v]:
                c = self.faces[f]
                if other in c:
                    continue
                old = [self.points[u] for u in c]
                new = [p if u == v else self.points[u] for u in c]
                n0 = cross(sub(old[1], old[0]), sub(old[2], old[0]))
                n1 = cross(sub(new[1], new[0]), sub(new[2], new[0]))
                if dot(n0, n1) < 0.25 * math.sqrt(dot(n0, n0) * dot(n1, n1)):
                    return False
                sides = [sub(new[i], new[i - 1]) for i in range(3)]
                longest = max(dot(s, s) for s in sides)
                if math.sqrt(dot(n1, n1)) < 0.22 * longest:  # a sliver: height under 0.22 of its base
                    return False
        return True

    def collapse(self, a, b, p):
        drop = 2 if self.on_rim(a, b) else 3
        for f in self.faces_at[a] & self.faces_at[b]:
            for v in self.faces.pop(f):
                self.faces_at[v].discard(f)
        for f in self.faces_at.pop(b):
            self.faces[f] = tuple(a if v == b else v for v in self.faces[f])
            self.faces_at[a].add(f)
        self.add(a, self.quadric.pop(b))
        if b in self.rim:
            self.rim.discard(b)
            self.rim.add(a)
        self.points[a] = p
        self.edges -= drop
        for v in self.ring(a) | {a}:
            self.stamp[v] += 1
        self.stamp[b] = -1


def decimate(mesh, edges):
    heap = []

    def push(a, b):
        a, b = min(a, b), max(a, b)
        found = mesh.candidate(a, b)
        if found:
            heapq.heappush(heap, (found[0], a, b, mesh.stamp[a], mesh.stamp[b], found[1]))

    for v in sorted(mesh.faces_at):
        for u in sorted(mesh.ring(v)):
            if v < u:
                push(v, u)
    while heap and mesh.edges > edges:
        _, a, b, stamp_a, stamp_b, p = heapq.heappop(heap)
        if mesh.stamp[a] != stamp_a or mesh.stamp[b] != stamp_b:
            continue
        left = mesh.edges - edges - (2 if mesh.on_rim(a, b) else 3)
        if left < 0 or left == 1 or not mesh.allowed(a, b, p):
            continue
        mesh.collapse(a, b, p)
        for v in sorted(mesh.ring(a)):
            push(a, v)
            for u in sorted(mesh.ring(v)):
                push(v, u)
    if mesh.edges != edges:
        sys.exit(f"stuck at {mesh.edges} edges")


def frame(mesh):
    """Nodes in mm sorted from the bed up, edges as pairs of their places in that list."""
    top = max(mesh.points[v][2] for v in mesh.faces_at)
    rim = [mesh.points[v] for v in sorted(mesh.rim)]
    middle = [(min(p[k] for p in rim) + max(p[k] for p in rim)) / 2 for k in (0, 1)]
    scale = HEIGHT_MM / top
    mm = {
        v: tuple(round((x - o) * scale, 2) for x, o in zip(mesh.points[v], (*middle, 0.0)))
        for v in mesh.faces_at
    }
    order = sorted(mm, key=lambda v: (mm[v][2], mm[v]))
    place = {v: i for i, v in enumerate(order)}
    edges = {tuple(sorted((place[a], place[b]))) for c in mesh.faces.values() for a, b in zip(c, c[1:] + c[:1])}
    return [mm[v] for v in order], sorted(edges)


def report(nodes, edges):
    lengths = sorted(math.dist(nodes[a], nodes[b]) for a, b in edges)
    at = [[] for _ in nodes]
    for a, b in edges:
        at[a].append(sub(nodes[b], nodes[a]))
        at[b].append(sub(nodes[a], nodes[b]))
    angles = [
        math.degrees(math.acos(min(1.0, dot(u, v) / math.sqrt(dot(u, u) * dot(v, v)))))
        for directions in at
        for i, u in enumerate(directions)
        for v in directions[:i]
    ]
    print(f"{len(nodes)} nodes, {sum(p[2] == 0 for p in nodes)} grounded, {len(edges)} edges, {sum(lengths):.0f} mm of strut")
    print(f"edges {lengths[0]:.1f} to {lengths[-1]:.1f} mm, median {lengths[len(lengths) // 2]:.1f} mm")
    print(f"least angle at a node {min(angles):.1f} deg, most edges at a node {max(map(len, at))}")
    for k, name in enumerate("xyz"):
        print(f"{name} {min(p[k] for p in nodes):.1f} to {max(p[k] for p in nodes):.1f} mm")


def write(path, nodes, edges):
    def xyz(p):
        return dict(zip("XYZ", p))

    base = {"Origin": xyz(ORIGIN_MM), "XAxis": xyz((1.0, 0.0, 0.0)), "YAxis": xyz((0.0, 1.0, 0.0)), "ZAxis": xyz((0.0, 0.0, 1.0))}
    head = {
        "model_name": "bunny-wireframe",
        "assembly_type": "extrusion",
        "model_type": "3D_frame",
        "unit": "millimeter",
        "dimension": 3,
        "node_num": len(nodes),
        "element_num": len(edges),
        "base_frame_in_rob_base": base,
        "uniform_cross_section": True,
        "material_properties": {
            "cross_sec_area": round(math.pi * DIAMETER_MM**2 / 400, 12),
            "cross_sec_area_unit": "centimeter^2",
        },
    }
    node_list = [{"node_id": i, "point": xyz(p), "is_grounded": int(p[2] == 0)} for i, p in enumerate(nodes)]
    element_list = [{"element_id": i, "end_node_ids": e, "layer_id": -1} for i, e in enumerate(edges)]
    lines = [json.dumps({key: value})[1:-1] for key, value in head.items()]
    for name, entries in (("node_list", node_list), ("element_list", element_list)):
        rows = ",\n    ".join(json.dumps(entry) for entry in entries)
        lines.append(f'"{name}": [\n    {rows}\n  ]')
    with open(path, "w", encoding="utf-8") as out:
        out.write("{\n  " + ",\n  ".join(lines) + "\n}\n")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    mesh = Mesh(*flatten(*read_mesh(sys.argv[1])))
    decimate(mesh, EDGES)
    nodes, edges = frame(mesh)
    report(nodes, edges)
    write(sys.argv[2], nodes, edges)


main()

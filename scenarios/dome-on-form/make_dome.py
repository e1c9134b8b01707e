#!/usr/bin/env python3
"""Writes the mould of a shallow dome and the job that lays strands on it in two layers.

    python3 make_dome.py mould.stl job.slam
"""

import struct
import sys
from math import acos, asin, ceil, cos, pi, sin

WIDTH_MM, RISE_MM = 120.0, 18.0
RADIUS_MM = (WIDTH_MM**2 / 4 + RISE_MM**2) / (2 * RISE_MM)  # of the sphere
RIM_RAD = asin(WIDTH_MM / 2 / RADIUS_MM)  # from the pole to the rim
RINGS, SECTORS = 15, 60
LAYERS_MM = {"along": 0.6, "across": 1.7}  # of the axes over the form: the second layer lies on the first
FOOT_MM = 1.0  # of the ends over the bed: lower, and the slanted face of the nozzle digs into it
PLANES_MM = [-46.0, -22.0, 22.0, 46.0]  # in which the strands of a layer run
STEP_MM = 4.0

HEAD = """// A dome of strands, laid on a mould in two layers and released from it. Written by make_dome.py.
{
  "slam": 1,
  "name": "dome-on-form",
  "cell": "cell.toml",
  "material": "pla",
  "placement": { "xyz_mm": [30, -60, 0], "rpy_deg": [0, 0, 0] },
  "environment": { "air_c": 23, "air_m_s": 0.1 },
  "forms": [{ "id": "mould", "mesh": "mould.stl", "adhesion_mpa": 0.3 }],
  "process": {
    "speed_mm_s": 3.0,
    "flow": { "diameter_mm": 1.25 },
    "prime_s": 0.5,
    "dwell_s": 1.0,
    "approach_mm": 50,
    "retract_mm": 50,
    "orientation": { "follow": "surface_normal", "spin": "free" },
  },
  "strands": ["""

TAIL = """  ],
  "sequence": [%(order)s, { "wait_s": 60 }, { "release": "mould" }],
  // The released dome on its feet, with a weight on the four crossings round the crown.
  "loads": [
    {
      "name": "crown",
      "supports": [
%(supports)s
      ],
      "forces": [
%(forces)s
      ],
    },
  ],
}"""


def cap():
    """Triangles of the cap, seen from outside anticlockwise. Open below, where it stands on the bed, so that
    the surface nearest to a foot is the dome's and not its base's."""
    def at(ring, sector):
        polar, around = RIM_RAD * ring / RINGS, 2 * pi * sector / SECTORS
        return (
            RADIUS_MM * sin(polar) * cos(around),
            RADIUS_MM * sin(polar) * sin(around),
            RADIUS_MM * cos(polar) - RADIUS_MM + RISE_MM,
        )

    triangles = []
    for sector in range(SECTORS):
        triangles.append((at(0, 0), at(1, sector), at(1, sector + 1)))
        for ring in range(1, RINGS):
            a, b = at(ring, sector), at(ring, sector + 1)
            c, d = at(ring + 1, sector), at(ring + 1, sector + 1)
            triangles += [(a, c, d), (a, d, b)]
    return triangles


def write_stl(name, triangles):
    with open(name, "wb") as file:
        file.write(b"mould of dome-on-form, mm".ljust(80))
        file.write(struct.pack("<I", len(triangles)))
        for triangle in triangles:
            file.write(struct.pack("<3f", 0, 0, 0))
            for corner in triangle:
                file.write(struct.pack("<3f", *corner))
            file.write(struct.pack("<H", 0))


def arch(plane_mm, over_mm):
    """From bed to bed over the form, in the plane at `plane_mm` from the middle: (along, up)."""
    radius = ((RADIUS_MM + over_mm) ** 2 - plane_mm**2) ** 0.5
    half = acos((RADIUS_MM - RISE_MM + FOOT_MM) / radius)
    pieces = ceil(2 * half * radius / STEP_MM)
    angles = [half * (2 * k / pieces - 1) for k in range(pieces + 1)]
    return [(radius * sin(angle), radius * cos(angle) - RADIUS_MM + RISE_MM) for angle in angles]


def main():
    write_stl(sys.argv[1], cap())
    lines, names, feet = [], [], []
    for layer, over in LAYERS_MM.items():
        for k, plane in enumerate(PLANES_MM):
            points = [(s, plane, z) if layer == "along" else (plane, s, z) for s, z in arch(plane, over)]
            if k % 2:
                points.reverse()  # back and forth, so that the way to the next one is short
            text = ", ".join(f"[{x:.3f}, {y:.3f}, {z:.3f}]" for x, y, z in points)
            name = f"{layer}-{k + 1}"
            lines.append(f'    {{ "id": "{name}", "on": "mould", "points_mm": [{text}], "start": {{ "join": "bed" }}, "end": {{ "join": "bed" }} }},')
            names.append(name)
            feet += [points[0], points[-1]]
    supports = [f'        {{ "at_mm": [{x:.2f}, {y:.2f}, {z:.2f}], "fix": "xyz" }},' for x, y, z in feet]
    near = PLANES_MM[2]
    up = ((RADIUS_MM + LAYERS_MM["across"]) ** 2 - 2 * near**2) ** 0.5 - RADIUS_MM + RISE_MM
    crown = [(x, y) for x in (-near, near) for y in (-near, near)]
    forces = [f'        {{ "at_mm": [{x:.0f}, {y:.0f}, {up:.2f}], "force_n": [0, 0, -0.5] }},' for x, y in crown]
    order = ", ".join(f'"{name}"' for name in names)
    values = {"order": order, "supports": "\n".join(supports), "forces": "\n".join(forces)}
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        print("\n".join([HEAD, *lines, TAIL % values]), file=file)


main()

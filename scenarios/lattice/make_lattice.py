#!/usr/bin/env python3
"""Writes the job of a small lattice girder: two zigzag planes of three cells, tied along and across.

    python3 make_lattice.py job.slam
"""

import sys

CELLS, CELL_MM, RISE_MM, APART_MM = 3, 40.0, 13.0, 30.0
FLAT_MM = 4.0  # length of the flat top of a zigzag, where the nozzle rests and the strand sets
LAID_MM = 0.6  # axis of a strand on the plate
FOOT_MM = LAID_MM + 1.15  # axis of a strand laid on one that lies on the plate
APEX_MM = FOOT_MM + RISE_MM
CHORD_MM = APEX_MM + 0.5  # pressed into the apexes, so that they become one node
BAR_MM = CHORD_MM + 0.5

HEAD = """// A lattice girder of three cells of 40 mm. Written by make_lattice.py.
{
  "slam": 1,
  "name": "lattice",
  "cell": "kr6-hot-end",
  "material": "pla",
  "environment": { "air_c": 23, "air_m_s": 0.1 },
  "process": {
    "speed_mm_s": 2.0,
    "flow": { "diameter_mm": 1.25 },
    "prime_s": 0.5,
    "dwell_s": 2.0,
    "approach_mm": 15,
    "retract_mm": 15,
    "orientation": { "follow": "vertical", "spin": "free" },
  },
  "strands": ["""

TAIL = """  ],
  // The finished girder on its four corners with a weight on the middle bar, half of it on each plane.
  "loads": [
    {
      "name": "weight",
      "supports": [%s],
      "forces": [%s],
    },
  ],
}"""


def strand(name, points, more=""):
    text = ", ".join(f"[{x:.2f}, {y:.2f}, {z:.2f}]" for x, y, z in points)
    return f'    {{ "id": "{name}", "points_mm": [{text}]{more} }},'


def main():
    half = CELLS * CELL_MM / 2
    planes = {"left": -APART_MM / 2, "right": APART_MM / 2}
    apexes = [-half + CELL_MM * (k + 0.5) for k in range(CELLS)]
    lines = []
    for side, y in planes.items():
        # A little longer than the zigzag that stands on it.
        lines.append(strand(f"{side}-base", [(-half - 3, y, LAID_MM), (half + 3, y, LAID_MM)], ', "on": "bed"'))
    for side, y in planes.items():
        points = [(-half, y, FOOT_MM)]
        for x in apexes:
            points += [(x - FLAT_MM / 2, y, APEX_MM), (x + FLAT_MM / 2, y, APEX_MM), (x + CELL_MM / 2, y, FOOT_MM)]
        lines.append(strand(f"{side}-zigzag", points))
    for side, y in planes.items():
        lines.append(strand(f"{side}-top", [(apexes[0], y, CHORD_MM), (apexes[-1], y, CHORD_MM)]))
    for k, x in enumerate(apexes):
        ends = [(x, y, BAR_MM) for y in planes.values()]
        lines.append(strand(f"bar-{k + 1}", ends))
    feet = [(x, y, FOOT_MM) for x in (-half, half) for y in planes.values()]
    supports = ", ".join(f'{{ "at_mm": [{x:.0f}, {y:.0f}, {z:.2f}], "fix": "xyz" }}' for x, y, z in feet)
    middle = [(0, y, CHORD_MM) for y in planes.values()]
    forces = ", ".join(f'{{ "at_mm": [{x}, {y:.0f}, {z:.2f}], "force_n": [0, 0, -0.4] }}' for x, y, z in middle)
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        print("\n".join([HEAD, *lines, TAIL % (supports, forces)]), file=file)


main()

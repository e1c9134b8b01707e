#!/usr/bin/env python3
"""Writes the job of a helix that rises from the bed while its radius shrinks.

    python3 make_helix.py job.slam

The strand leans off the vertical by the same angle all the way, so it turns faster where it is narrow.
"""

import sys
from math import cos, log, radians, sin, tan

R_BOTTOM_MM, R_TOP_MM, HEIGHT_MM, LEAN_DEG, POINTS = 16.0, 8.0, 70.0, 38.0, 180
FROM_DEG = 335.0  # where on the circle it begins; it turns clockwise, seen from above
FIRST_MM = 1.5  # axis of the bead over the bed where it begins

HEAD = """// A helix of %.0f mm height, its radius shrinking from %.0f to %.0f mm. Written by make_helix.py.
{
  "slam": 1,
  "name": "tapered-helix",
  "cell": "kirkman-sda10d",
  "material": "sla-resin-silica",
  "environment": { "air_c": 23, "air_m_s": 0.1 },
  "process": {
    "speed_mm_s": 1.5,
    "flow": { "diameter_mm": 3.0 },
    "prime_s": 2.8,
    "lights_after_mm": 3.0,
    "overrun_mm": 1.7,
    "dwell_s": 10.0,
    "post_cure_j_cm2": 20, // the UV box afterwards
    "approach_mm": 15,
    "retract_mm": 15,
    "orientation": { "follow": "tangent", "tilt": "per-axis", "tilt_from_deg": 20, "tilt_max_deg": 40, "spin": "free" },
  },
  "strands": [
    {
      "id": "helix",
      "on": "air",
      "points_mm": ["""

TAIL = """      ],
      "start": { "join": "bed" },
      "end": { "join": "free" },
    },
  ],
}"""


def point(share):
    taper_mm = R_BOTTOM_MM - R_TOP_MM
    radius_mm = R_BOTTOM_MM - taper_mm * share
    around_mm = ((HEIGHT_MM * tan(radians(LEAN_DEG))) ** 2 - taper_mm**2) ** 0.5
    angle = radians(FROM_DEG) - around_mm / taper_mm * log(R_BOTTOM_MM / radius_mm)
    return (radius_mm * cos(angle), radius_mm * sin(angle), FIRST_MM + HEIGHT_MM * share)


def main():
    points = [point(k / POINTS) for k in range(POINTS + 1)]
    rows = [f"        [{x:.3f}, {y:.3f}, {z:.3f}]," for x, y, z in points]
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        print("\n".join([HEAD % (HEIGHT_MM, R_BOTTOM_MM, R_TOP_MM), *rows, TAIL]), file=file)


main()

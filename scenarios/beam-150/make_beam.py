#!/usr/bin/env python3
"""Writes the job of a plane beam of strands, printed lying on the bed in two layers.

    python3 make_beam.py job.slam

Arches (compression) and the top chord make the first layer, ties (the same curves upside down) and the bottom
chord the second, so that the two families cross as principal stress lines do.
"""

import sys

SPAN_MM, DEPTH_MM = 150.0, 37.6
HALF_WIDTHS_MM = [75.0, 52.0, 29.0]  # of the three arches, at their feet
CRESTS_MM = [33.6, 22.6, 11.6]  # of the three arches, over the bottom chord
LAYERS_MM = [0.5, 1.35]  # axes of the beads
PIECES = 24
PAST_MM = 0.5  # by which a strand runs past the chord it ends on

HEAD = """// A beam of 150 mm span, laid flat in two layers that cross. Written by make_beam.py.
{
  "slam": 1,
  "name": "beam-150",
  "cell": "printer-3axis",
  "material": "pla",
  "environment": { "air_c": 23, "air_m_s": 0.1 },
  "process": {
    "speed_mm_s": 5,
    "flow": { "diameter_mm": 1.2 },
    "prime_s": 0.2,
    "dwell_s": 0.5,
    "approach_mm": 5,
    "retract_mm": 5,
    "orientation": { "follow": "vertical" },
  },
  // Beads of one layer are laid nearer to the nozzle than struts in the air: its face runs over the first layer.
  "limits": { "clearance_mm": 0.4 },
  "strands": ["""

TAIL = """  ],
  // Off the bed, on two supports, a force in the middle of the top chord, in the plane of the beam. The
  // third support keeps it from falling over.
  "loads": [
    {
      "name": "mid-span",
      "supports": [
        { "at_mm": [-75, 0, %(upper)s], "fix": "xyz" },
        { "at_mm": [75, 0, %(upper)s], "fix": "yz" },
        { "at_mm": [0, %(depth)s, %(lower)s], "fix": "z" },
      ],
      "forces": [{ "at_mm": [0, %(depth)s, %(lower)s], "force_n": [0, -0.4, 0] }],
    },
  ],
}"""


def curve(half_mm, crest_mm):
    """A parabola over the bottom chord, from below one end of it to below the other."""
    over = 1 + PAST_MM * half_mm / (2 * crest_mm) / half_mm
    shares = [over * (2 * k / PIECES - 1) for k in range(PIECES + 1)]
    return [(half_mm * s, crest_mm * (1 - s * s)) for s in shares]


def strand(name, points, layer):
    text = ", ".join(f"[{x:.2f}, {y:.2f}, {LAYERS_MM[layer]:.2f}]" for x, y in points)
    return f'    {{ "id": "{name}", "on": "{("bed", "air")[layer]}", "points_mm": [{text}] }},'


def main():
    end_mm = SPAN_MM / 2 + 1
    arches = [curve(half, crest) for half, crest in zip(HALF_WIDTHS_MM, CRESTS_MM)]
    ties = [[(x, DEPTH_MM - y) for x, y in arch] for arch in arches]
    lines = [strand("top-chord", [(-end_mm, DEPTH_MM), (end_mm, DEPTH_MM)], 0)]
    lines += [strand(f"arch-{k + 1}", arch, 0) for k, arch in enumerate(arches)]
    # Short struts tie the chords to the outermost curves in the middle.
    lines.append(strand("foot-strut", [(0, -PAST_MM), (0, DEPTH_MM - CRESTS_MM[0] + PAST_MM)], 0))
    lines.append(strand("bottom-chord", [(-end_mm, 0), (end_mm, 0)], 1))
    lines += [strand(f"tie-{k + 1}", tie, 1) for k, tie in enumerate(ties)]
    lines.append(strand("head-strut", [(0, DEPTH_MM + PAST_MM), (0, CRESTS_MM[0] - PAST_MM)], 1))
    values = {"upper": LAYERS_MM[1], "lower": LAYERS_MM[0], "depth": DEPTH_MM}
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        print("\n".join([HEAD, *lines, TAIL % values]), file=file)


main()

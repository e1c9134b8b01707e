"""Reads STL files as others do: every body closed, volumes summed.

    python check_stl.py FILE.stl [VOLUME_MM3]

Needs `pip install trimesh scipy networkx`. Ends with 1 where a body is open or the volume is off by more than 0.1 %.
"""

import sys

import trimesh

path = sys.argv[1]
bodies = trimesh.load(path, file_type="stl").split(only_watertight=False)
is_open = [body for body in bodies if not body.is_watertight or not body.is_winding_consistent]
volume = float(sum(body.volume for body in bodies))
print(f"{path}: {len(bodies)} bodies, {len(is_open)} open, {volume:.3f} mm³")
bad = bool(is_open)
if len(sys.argv) > 2:
    wanted = float(sys.argv[2])
    print(f"wanted {wanted:.3f} mm³, off by {100 * (volume / wanted - 1):.5f} %")
    bad |= abs(volume / wanted - 1) > 1e-3
sys.exit(bad)

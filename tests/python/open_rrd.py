"""Opens a recording in the real Rerun viewer, without a screen, and takes its picture.

    python open_rrd.py FILE.rrd SHOT.png

Needs `pip install rerun-sdk==0.36.3` in the Python that runs this, and a Vulkan driver (Debian: mesa-vulkan-drivers).
Run `rerun analytics disable` once before. Ends with 1 where the file does not verify, has a time line besides `sim_time`,
or the picture is of one colour.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

recording, shot = sys.argv[1:3]
rerun = str(Path(sys.executable).with_name("rerun"))

subprocess.run([rerun, "rrd", "verify", recording], check=True)
with tempfile.TemporaryFile("w+") as told:
    subprocess.run([rerun, "rrd", "print", "-v", recording], check=True, stdout=told)
    told.seek(0)
    text = told.read()
for other in ["log_time", "log_tick"]:
    if other in text:
        sys.exit(f"{recording} has the time line {other}")
if "sim_time" not in text:
    sys.exit(f"{recording} has no sim_time")

with tempfile.TemporaryDirectory() as runtime:
    command = [rerun, "--headless", "--bind", "127.0.0.1", "--port", "9911"]
    command += ["--hide-welcome-screen", "--window-size", "1280x800", "--screenshot-to", shot]
    env = os.environ | {"XDG_RUNTIME_DIR": runtime}
    subprocess.run([*command, recording], check=True, env=env, timeout=180)
# a PNG of one colour packs into next to nothing
size = Path(shot).stat().st_size
print(f"{shot}: {size} bytes")
sys.exit(size < 50_000)

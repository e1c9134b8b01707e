"""Opens a recording in the real Rerun viewer, without a screen, and takes its picture.

    python open_rrd.py FILE.rrd SHOT.png [SECONDS]

Needs `pip install rerun-sdk==0.36.3` in the Python that runs this, and a Vulkan driver (Debian: mesa-vulkan-drivers).
Run `rerun analytics disable` once before. The viewer is given SECONDS (30) to load and lay out before the picture: one taken
at once shows half of it. Ends with 1 where the file does not verify, has a time line besides `sim_time`, or the picture is
of one colour. The picture is to be looked at.
"""

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

recording, shot = sys.argv[1:3]
seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 30.0
rerun = str(Path(sys.executable).with_name("rerun"))
PORT = "9911"

subprocess.run([rerun, "rrd", "verify", recording], check=True)
with tempfile.TemporaryFile("w+") as told:
    # its pipe must not be closed early
    command = [rerun, "rrd", "print", "-vvv", "--entity", "/state/process", recording]
    subprocess.run(command, check=True, stdout=told)
    told.seek(0)
    text = told.read()
for name, wanted in [("sim_time", True), ("log_time", False), ("log_tick", False)]:
    if (name in text) != wanted:
        sys.exit(f"{recording}: time line {name} is {'missing' if wanted else 'there'}")

with tempfile.TemporaryDirectory() as runtime:
    env = os.environ | {"XDG_RUNTIME_DIR": runtime}
    local = ["--bind", "127.0.0.1", "--port", PORT]
    headless = [rerun, "--headless", *local, "--hide-welcome-screen", "--window-size", "1600x1000"]
    # `rerun` is a script that starts the viewer: the two are ended together
    with subprocess.Popen(headless, env=env, start_new_session=True) as viewer:
        try:
            time.sleep(5)
            # a second one sends what it opens to the first
            subprocess.run([rerun, *local, recording], check=True, env=env, timeout=300)
            time.sleep(seconds)
            from rerun.experimental import ViewerClient

            client = ViewerClient.connect(f"rerun+http://127.0.0.1:{PORT}/proxy")
            client.save_screenshot(str(Path(shot).absolute()))
            time.sleep(5)
        finally:
            os.killpg(viewer.pid, signal.SIGTERM)

# a PNG of one colour packs into next to nothing
size = Path(shot).stat().st_size
print(f"{shot}: {size} bytes")
sys.exit(size < 50_000)

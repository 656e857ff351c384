"""Records a scene and exports it."""

import pathlib
import subprocess
import sys

SCENE = pathlib.Path(__file__).parent / "recordings_scene.lua"
LIMIT = 60  # seconds


def exported(folder, option, name):
    """The path of what `swanilda export` makes of two seconds and more."""
    program = sys.argv[1]
    recording, out = str(pathlib.Path(folder, "a.swr")), pathlib.Path(folder, name)
    run = [program, "run", str(SCENE), "--steps", "50", "--record", recording, "--record-images", "--quiet"]
    subprocess.run(run, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=LIMIT)
    subprocess.run([program, "export", recording, option, str(out)], check=True, timeout=LIMIT)
    return out

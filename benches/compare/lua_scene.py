"""Runs a scene in Lua with values from Python."""

import json
import os
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).parent


def lua(value):
    """A value as Lua source."""
    if isinstance(value, dict):
        return "{" + ",".join(f"[{json.dumps(k)}]={lua(v)}" for k, v in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "{" + ",".join(map(lua, value)) + "}"
    return "nil" if value is None else json.dumps(value)


def run_lua(file, variables, seconds):
    """What a scene of this folder prints: the words of each line. `variables`: globals that it finds, `seconds`: simulated time after which it is ended."""
    binary = os.environ.get("SWANILDA", str(HERE / "../../target/release/swanilda"))
    code = "".join(f"{name} = {lua(value)}\n" for name, value in variables.items())
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.lua")
        Path(path).write_text(code + (HERE / file).read_text())
        command = [binary, "run", path, "--empty", "--time", str(seconds)]
        result = subprocess.run(command, capture_output=True, text=True, timeout=900)
    if result.returncode != 0:
        raise RuntimeError(result.stdout[-2000:] + result.stderr[-2000:])
    return [line.split() for line in result.stdout.splitlines()]

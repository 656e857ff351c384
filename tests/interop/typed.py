"""mypy and pyright find what is wrong in typed_program.py, and nothing else."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

LIMIT = 240  # seconds; the first run of mypy reads numpy
FOLDER = pathlib.Path(__file__).parent
PACKAGE = FOLDER.parent.parent / "python"
PROGRAM = FOLDER / "typed_program.py"


def run(*command, **more):
    return subprocess.run([sys.executable, "-m", *command], capture_output=True, text=True, timeout=LIMIT, **more)


def mypy(folder):
    """The lines in which mypy finds errors."""
    environment = {**os.environ, "MYPYPATH": str(PACKAGE)}
    done = run("mypy", "--strict", "--no-error-summary", "--cache-dir", folder, str(PROGRAM), env=environment)
    found = re.findall(r"^(.*):(\d+): error: ", done.stdout, re.MULTILINE)
    if done.stderr or any(not file.endswith(PROGRAM.name) for file, _ in found):
        sys.exit(f"mypy: {done.stderr}{done.stdout}")
    return {int(line) for _, line in found}


def pyright(folder):
    """The same for pyright."""
    shutil.copy(PROGRAM, folder)  # it looks at nothing outside of the folder of its settings
    pathlib.Path(folder, "pyrightconfig.json").write_text(json.dumps({"extraPaths": [str(PACKAGE)]}))
    done = run("pyright", "--project", folder, "--pythonpath", sys.executable, "--outputjson")
    try:
        diagnostics = json.loads(done.stdout)["generalDiagnostics"]
    except ValueError:
        sys.exit(f"pyright: {done.stderr}{done.stdout}")
    return {one["range"]["start"]["line"] + 1 for one in diagnostics if one["severity"] == "error"}


def main():
    lines = PROGRAM.read_text().splitlines()
    wrong = {number for number, line in enumerate(lines, 1) if line.endswith("# wrong")}
    with tempfile.TemporaryDirectory() as folder:
        for checker in (mypy, pyright):
            found = checker(folder)
            if found != wrong:
                sys.exit(f"{checker.__name__}: errors in lines {sorted(found)} instead of {sorted(wrong)}")


main()

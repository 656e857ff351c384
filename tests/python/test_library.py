"""The folder for programs that load CoppeliaSim in their own process, written by the package."""

import os
import pathlib
import subprocess
import sys

import pytest

from swanilda import library

EXAMPLES = pathlib.Path(__file__).parents[2] / "examples/python"


def run(program, *arguments, root):
    environment = os.environ | {"COPPELIASIM_ROOT": str(root)}
    return subprocess.run([sys.executable, program, *arguments], env=environment, capture_output=True, text=True, timeout=300)


def test_a_program_steps_with_cameras(tmp_path):
    library.write(tmp_path)
    done = run(EXAMPLES / "pyrep_style.py", root=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "20.00 s simulated" in done.stdout


def test_both_releases_have_symbols_of_their_own(tmp_path):
    names = {}
    for release, function in (("4.1", "simExtLaunchUIThread"), ("4.10", "simInitialize")):
        subprocess.run([sys.executable, "-m", "swanilda.library", "--for", release, tmp_path / release], check=True, timeout=60)
        probe = "import ctypes, sys; ctypes.CDLL(sys.argv[1]).{}".format(function)
        names[release] = {
            other: subprocess.run([sys.executable, "-c", probe, tmp_path / other / "libcoppeliaSim.so"], capture_output=True).returncode == 0
            for other in names | {release: None}
        }
    assert names["4.1"] == {"4.1": True}
    assert names["4.10"] == {"4.1": False, "4.10": True}


def test_other_releases_are_refused(tmp_path):
    with pytest.raises(ValueError, match="4.1 and 4.10, not for 4.2"):
        library.write(tmp_path, "4.2")
    assert not list(tmp_path.iterdir())

"""The simulator as the library that programs load which were made for CoppeliaSim, such as PyRep.

    python3 -m swanilda.library ~/coppeliasim

The folder is for COPPELIASIM_ROOT. It has a copy of this package's extension, so it serves programs in Python; the command
`swanilda library` writes one that serves programs in C too.
"""

from __future__ import annotations

import argparse
import os

from . import _swanilda


def write(folder: str | os.PathLike[str], release: str = "4.1") -> None:
    """Writes the folder; `release` is the version of CoppeliaSim that the programs were made for, 4.1 or 4.10."""
    _swanilda.write_library(folder, release, _swanilda.__file__)


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="python3 -m swanilda.library",
        description="Write a folder for COPPELIASIM_ROOT: the simulator as the library that programs for CoppeliaSim load",
    )
    parser.add_argument("folder", help="folder to write into")
    parser.add_argument("--for", dest="release", choices=["4.1", "4.10"], default="4.1", help="version of CoppeliaSim that the programs were made for (4.1)")
    arguments = parser.parse_args()
    write(arguments.folder, arguments.release)
    folder = os.path.abspath(arguments.folder)
    print(f"wrote {folder}\n\nexport COPPELIASIM_ROOT={folder}\nexport LD_LIBRARY_PATH=$COPPELIASIM_ROOT:$LD_LIBRARY_PATH")


if __name__ == "__main__":
    main()

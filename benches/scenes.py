#!/usr/bin/env python3
"""Scores of other people's scenes against recordings of CoppeliaSim: `benches/scenes.py [BINARY]` after `cargo build --release`.

Records every scene of ../shared/scenes (about two minutes), judges it with the compare.py there, and writes the table in
docs/COMPATIBILITY.md. One hundred passes of each; `load` is what is there after loading, `behave` what happens then, `paths` the part of it
that is about motion. With RECORDED=FOLDER, judges what was recorded there (one folder per scene) and records the rest.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENES = ROOT.parent / "shared" / "scenes"
PAGE = ROOT / "docs" / "COMPATIBILITY.md"
MARK = "<!-- scores -->\n"
PASSES, TIMEOUT = "100", 600
# CoppeliaSim's engines beside the one of most scenes, Bullet.
OTHER_ENGINES = {1: "ODE", 3: "Newton", 4: "MuJoCo"}
CLASSES = {
    "A": "nothing moves: loading, scripts, messages",
    "B": "things move without physics",
    "C": "physics; the engines of the original differ among themselves",
    "D": "scenes that need what the recording program lacked",
    "X": "scenes that do not run on the original",
}


def record(binary, slug, folder):
    name = slug + (".ttm" if slug.endswith(".m") else ".ttt")
    out = folder / slug
    if out.exists():
        return
    out.mkdir(parents=True)
    settings = {
        "YARD_FILE": str(SCENES / "files" / name),
        "YARD_OUT": str(out),
        "YARD_N": PASSES,
        "YARD_WALL": str(TIMEOUT - 10),
        "YARD_TRACK": str(SCENES / "reference" / slug / "track.txt"),
    }
    command = [binary, "serve", "--original-errors", "--no-remote-api", "--addon", SCENES / "recorder.lua"]
    log = out / "console.raw"
    with open(log, "wb") as console:
        try:
            subprocess.run(command, env=os.environ | settings, stdout=console, stderr=console, timeout=TIMEOUT)
        except subprocess.TimeoutExpired:
            print(f"{slug}: stopped after {TIMEOUT} s")
    log.write_bytes(as_installed_elsewhere(log.read_bytes(), out))


def as_installed_elsewhere(console, *folders):
    """Where programs and scenes are installed is no difference: compare.py takes all folders below /tmp for the same."""
    for folder in sorted({*folders, ROOT, SCENES, SCENES.resolve()}, key=lambda path: -len(str(path))):
        console = console.replace(str(folder).encode(), b"/tmp/installed")
    return console


def judge(slug, recorded):
    command = [sys.executable, SCENES / "compare.py", SCENES / "reference" / slug, recorded]
    found = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return json.JSONDecoder().raw_decode(found)[0]


def paths_of_engines(slug):
    """What the original gets for the paths of its own other engines."""
    reference = SCENES / "reference" / slug
    scores = {}
    for number, engine in OTHER_ENGINES.items():
        recording = reference / f"traj.e{number}.tsv"
        if recording.exists():
            with tempfile.TemporaryDirectory() as folder:
                shutil.copy(recording, Path(folder) / "traj.tsv")
                scores[engine] = judge(slug, folder)["traj"]["score"]
    return scores


def mean(scores):
    """In words; some scenes have nothing to judge."""
    scores = [score for score in scores if score is not None]
    return f"{sum(scores) / len(scores):.1f}" if scores else "-"


def table(rows):
    lines = ["| class | scenes | load | behave |", "|---|---|---|---|"]
    for letter, meaning in CLASSES.items():
        scores = [score for kind, _, score in rows if kind == letter]
        load, behave = (mean([s[part] for s in scores]) for part in ("load", "behave"))
        lines.append(f"| {letter}: {meaning} | {len(scores)} | {load} | {behave} |")
    engines = " | ".join(OTHER_ENGINES.values())
    lines += ["", f"| scene | class | load | behave | paths | {engines} |", "|---" * (5 + len(OTHER_ENGINES)) + "|"]
    for kind, slug, score in sorted(rows, key=lambda row: row[:2]):
        motion = score["traj"] and score["traj"].get("score")
        others = paths_of_engines(slug)
        scores = [score["load"], score["behave"], motion] + [others.get(engine) for engine in OTHER_ENGINES.values()]
        lines.append(f"| {slug.rsplit('-', 1)[0]} | {kind} | " + " | ".join(mean([s]) for s in scores) + " |")
    return "\n".join(lines) + "\n"


def main():
    binary = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "target" / "release" / "swanilda")
    listed = [line.split("\t") for line in (SCENES / "dev.tsv").read_text().splitlines()[1:]]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        recorded = Path(os.environ.get("RECORDED", folder))
        for slug, kind, _ in listed:
            record(binary, slug, recorded)
            rows.append((kind, slug, judge(slug, recorded / slug)))
    result = table(rows)
    print(result)
    before, _, after = PAGE.read_text().split(MARK)
    PAGE.write_text(before + MARK + result + MARK + after)


if __name__ == "__main__":
    main()

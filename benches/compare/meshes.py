"""Meshes beside other programs: import of an STL file (trimesh), hulls (scipy's Qhull), decimation (fast-simplification), registration (small_gicp).

    python3 -m venv target/venv && target/venv/bin/pip install numpy scipy trimesh python-fcl fast-simplification small_gicp
    target/venv/bin/python benches/compare/meshes.py target/release/swanilda

prints times in milliseconds, best of five, and fails where results differ.
"""

import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import fast_simplification
import numpy as np
import scipy.spatial
import small_gicp
import trimesh

from bumpy_ball import ball


def best(call, times=5):
    least, result = math.inf, None
    for _ in range(times):
        begin = time.perf_counter()
        result = call()
        least = min(least, time.perf_counter() - begin)
    return 1000 * least, result


def turned(points):
    """Points elsewhere: a small turn and shift, with the way back."""
    pose = trimesh.transformations.euler_matrix(0.05, -0.04, 0.06)
    pose[:3, 3] = 0.01, -0.02, 0.015
    return trimesh.transform_points(points, pose), np.linalg.inv(pose)


def swanilda(binary, folder):
    """The rows that the script prints, by their first word."""
    script = Path(__file__).with_name("meshes.lua")
    command = [binary, "run", "--quiet", "--no-start", "--loops", "1", "-D", f"folder={folder}", script]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    rows = (line.replace("\t", " ").replace(",", " ").split() for line in lines)
    return {words[0]: [float(word) for word in words[1:]] for words in rows if words}


def row(name, ours, peer, theirs, note=""):
    print(f"{name:28} {ours:9.1f}   {peer} {theirs:9.1f}   {note}")


def main(binary):
    generator = np.random.default_rng(1)
    mesh = trimesh.Trimesh(*ball(200_000))
    mesh.update_faces(mesh.nondegenerate_faces())
    points = generator.normal(size=(20_000, 3))
    bumpy = np.ascontiguousarray(mesh.sample(5000, seed=1))
    template, expected = turned(bumpy)
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        mesh.export(folder / "ball.stl")
        for name, numbers in [("points", points), ("model", bumpy), ("template", template)]:
            (folder / f"{name}.f64").write_bytes(np.ascontiguousarray(numbers, dtype="<f8").tobytes())
        ours = swanilda(binary, folder)
        compare_import(ours, folder)
        compare_hull(ours, folder, points)
        compare_decimation(ours, folder, mesh)
        compare_registration(ours, bumpy, template, expected)


def compare_import(ours, folder):
    theirs, _ = best(lambda: trimesh.load_mesh(folder / "ball.stl"))
    row("STL, 200 000 triangles", ours["import"][0], "trimesh", theirs, "ours: a shape with normals and its tightest box")


def compare_hull(ours, folder, points):
    theirs, hull = best(lambda: scipy.spatial.ConvexHull(points))
    mine = trimesh.load_mesh(folder / "hull.stl")
    assert ours["hull"][1] == len(hull.vertices), (ours["hull"], len(hull.vertices))
    assert mine.is_watertight and abs(mine.volume / hull.volume - 1) < 1e-6
    row("hull, 20 000 points", ours["hull"][0], "scipy", theirs, f"both {len(hull.vertices)} corners")


def compare_decimation(ours, folder, mesh):
    call = lambda: fast_simplification.simplify(mesh.vertices.astype("f4"), mesh.faces.astype("i4"), target_count=20_000)
    theirs, (vertices, faces) = best(call, 1)
    def error(small):
        return np.abs(np.linalg.norm(small, axis=1) - radius(small)).max() * 1e3
    mine = trimesh.load_mesh(folder / "small.stl")
    assert mine.is_watertight and ours["decimation"][1] <= 20_000
    note = f"vertices off by {error(mine.vertices):.3f} mm, theirs {error(vertices):.3f} mm at most"
    row("decimation to 20 000", ours["decimation"][0], "fast-simplification", theirs, note)


def radius(points):
    """Of the bumpy ball, in the direction of points."""
    unit = points / np.linalg.norm(points, axis=1)[:, None]
    theta, phi = np.arccos(unit[:, 2]), np.arctan2(unit[:, 1], unit[:, 0])
    return 0.49 + 0.01 * np.sin(9 * theta) * np.cos(7 * phi)


def compare_registration(ours, model, template, expected):
    call = lambda: small_gicp.align(model, template, registration_type="ICP", max_correspondence_distance=1.0, downsampling_resolution=1e-6, max_iterations=300)
    theirs, result = best(call, 1)
    mine = np.array(ours["registration"][1:]).reshape(3, 4)
    off = np.abs(mine - expected[:3]).max()
    assert off < 1e-6, off
    note = f"off by {off:.1e}, theirs {np.abs(result.T_target_source[:3] - expected[:3]).max():.1e}"
    row("registration, 5000 points", ours["registration"][0], "small_gicp", theirs, note)


main(sys.argv[1])

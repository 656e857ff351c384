"""Pictures of MuJoCo's renderer, of PyBullet's TinyRenderer and of sensors in Swanilda that a script handles (SWANILDA: the command, otherwise
target/release/swanilda), of the scene of `cargo bench -p swanilda-rendering`: a floor, 49 boxes and a bumpy ball. Run all one after the
other on the same machine: `MUJOCO_GL=osmesa python pictures.py` (or egl); what is not installed is left out."""

import math
import tempfile
import time

import numpy as np

from lua_scene import run_lua

SIZES = [(256, 256), (640, 480)]
RINGS = {"1k": 16, "20k": 71, "200k": 224}
EYE, TARGET = (1.6, -1.6, 1.2), (0.0, 0.0, 0.15)
# Name, width, height, cameras, with masks.
SENSORS = [
    ("one of 256x256, colour and depth", 256, 256, 1, False),
    ("one of 640x480, colour and depth", 640, 480, 1, False),
    ("four of 128x128, colour and depth", 128, 128, 4, False),
    ("four of 128x128, colour, depth and masks", 128, 128, 4, True),
    ("three of 1024x1024, colour and depth", 1024, 1024, 3, False),
]
BOXES = [(i % 7 * 0.4 - 1.2, i // 7 * 0.4 - 1.2, 0.15) for i in range(49)]


def bumpy_ball(rings):
    """Vertices and triangles; counter-clockwise from outside."""
    sectors = 2 * rings
    polar = np.pi * np.arange(rings + 1)[:, None] / rings
    around = 2 * np.pi * np.arange(sectors)[None, :] / sectors
    radius = 0.5 + 0.05 * np.sin(5 * polar) * np.sin(6 * around)
    parts = [np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar) + 0 * around]
    vertices = np.stack([radius * part for part in parts], axis=-1).reshape(-1, 3)
    ring, sector = np.meshgrid(np.arange(rings), np.arange(sectors), indexing="ij")
    at = lambda r, s: r * sectors + s % sectors
    a, b, c, d = at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1), at(ring, sector + 1)
    return vertices, np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])


def milliseconds(render, best_of=5):
    """The best mean of several series."""
    render()
    series = []
    for _ in range(best_of):
        began, count = time.perf_counter(), 0
        while time.perf_counter() - began < 0.5:
            render()
            count += 1
        series.append((time.perf_counter() - began) / count)
    return min(series) * 1e3


def mujoco_rows(name, vertices, faces):
    import mujoco

    boxes = "".join(f'<geom type="box" size=".075 .075 .15" pos="{x} {y} {z}" rgba=".2 .3 .8 1"/>' for x, y, z in BOXES)
    cameras = "".join(f'<camera name="{i}" {numbers_of_camera(i / 4)} fovy="60"/>' for i in range(4))
    model = mujoco.MjModel.from_xml_string(f"""<mujoco>
        <visual><quality offsamples="0" shadowsize="0"/><global offwidth="1024" offheight="1024" fovy="60"/></visual>
        <asset><mesh name="ball" vertex="{numbers(vertices)}" face="{numbers(faces)}"/></asset>
        <worldbody><light directional="true" pos="1 -2 3" dir="-1 2 -3" castshadow="false"/>
        {cameras}
        <geom type="box" size="3 3 .05" pos="0 0 -.05" rgba=".6 .6 .6 1"/>
        <geom type="mesh" mesh="ball" pos="0 0 .6" rgba=".8 .2 .1 1"/>{boxes}</worldbody></mujoco>""")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for width, height in SIZES:
        with mujoco.Renderer(model, height, width) as renderer:
            for what in ["colour", "depth", "segmentation"]:
                result = milliseconds(lambda: mujoco_picture(renderer, data, "0", what))
                print(f"MuJoCo, {name} triangles, {width}x{height}, {what}: {result:.2f} ms", flush=True)
    for what, width, height, count, masks in SENSORS:
        channels = ["colour", "depth", "segmentation"][: 3 if masks else 2]
        with mujoco.Renderer(model, height, width) as renderer:

            def render():
                for i in range(count):
                    for channel in channels:
                        mujoco_picture(renderer, data, str(i), channel)

            print(f"MuJoCo, {name} triangles, {what}: {milliseconds(render):.2f} ms", flush=True)


def mujoco_picture(renderer, data, camera, what):
    renderer.disable_depth_rendering()
    renderer.disable_segmentation_rendering()
    if what == "depth":
        renderer.enable_depth_rendering()
    if what == "segmentation":
        renderer.enable_segmentation_rendering()
    renderer.update_scene(data, camera)
    renderer.render()


def numbers(array):
    return " ".join(map(str, np.ravel(array)))


def numbers_of_camera(turns):
    """Place and axes of a camera after so many turns around the scene."""
    c, s = math.cos(2 * math.pi * turns), math.sin(2 * math.pi * turns)
    eye = np.array([EYE[0] * c - EYE[1] * s, EYE[0] * s + EYE[1] * c, EYE[2]])
    right = np.cross(TARGET - eye, (0, 0, 1))
    up = np.cross(right, TARGET - eye)
    return f'pos="{numbers(eye)}" xyaxes="{numbers(right)} {numbers(up)}"'


def swanilda_rows(name, rings):
    for words in run_lua("pictures.lua", {"RINGS": rings, "CASES": SENSORS}, 0.05):
        print(f"Swanilda, {name} triangles, {' '.join(words[:-1]).rstrip(',')}: {float(words[-1]):.2f} ms", flush=True)


def pybullet_rows(name, vertices, faces):
    import pybullet as p

    client = p.connect(p.DIRECT)
    shape = lambda kind, colour, **size: p.createVisualShape(kind, rgbaColor=[*colour, 1], **size)
    place = lambda visual, position: p.createMultiBody(baseVisualShapeIndex=visual, basePosition=position)
    place(shape(p.GEOM_BOX, (0.6, 0.6, 0.6), halfExtents=[3, 3, 0.05]), (0, 0, -0.05))
    with tempfile.NamedTemporaryFile("w", suffix=".obj") as file:
        # Meshes of more than 131072 numbers come from files only.
        file.writelines(f"v {x} {y} {z}\n" for x, y, z in vertices)
        file.writelines(f"f {a} {b} {c}\n" for a, b, c in faces + 1)
        file.flush()
        place(shape(p.GEOM_MESH, (0.8, 0.2, 0.1), fileName=file.name), (0, 0, 0.6))
    box = shape(p.GEOM_BOX, (0.2, 0.3, 0.8), halfExtents=[0.075, 0.075, 0.15])
    for position in BOXES:
        place(box, position)
    view = p.computeViewMatrix(EYE, TARGET, (0, 0, 1))
    for width, height in SIZES:
        vertical = 2 * math.degrees(math.atan(math.tan(math.radians(30)) * height / width))
        projection = p.computeProjectionMatrixFOV(vertical, width / height, 0.01, 10)
        options = dict(renderer=p.ER_TINY_RENDERER, shadow=0, lightDirection=(1, -2, 3))
        render = lambda: p.getCameraImage(width, height, view, projection, **options)
        print(f"PyBullet, {name} triangles, {width}x{height}, all: {milliseconds(render):.2f} ms", flush=True)
    p.disconnect(client)


for name, rings in RINGS.items():
    swanilda_rows(name, rings)
    for rows in [mujoco_rows, pybullet_rows]:
        try:
            rows(name, *bumpy_ball(rings))
        except ImportError as error:
            print(f"left out: {error}")

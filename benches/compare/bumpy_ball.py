"""The bumpy ball of the benches of geometry, and its tree in FCL."""

import math

import fcl
import numpy as np


def ball(triangles, size=1):
    """Vertices and triangles of a ball of that diameter in metres, with bumps of up to a hundredth of it; `size` may have three numbers."""
    rings = int(math.sqrt(triangles / 4))
    sides = 2 * rings
    theta = math.pi * np.arange(rings + 1)[:, None] / rings
    phi = 2 * math.pi * np.arange(sides)[None, :] / sides
    radius = 0.49 + 0.01 * np.sin(9 * theta) * np.cos(7 * phi)
    xyz = radius * np.sin(theta) * np.cos(phi), radius * np.sin(theta) * np.sin(phi), radius * np.cos(theta)
    i, j = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
    a, b = i * sides + j, (i + 1) * sides + j
    c, d = (i + 1) * sides + (j + 1) % sides, i * sides + (j + 1) % sides
    faces = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)
    return np.stack(np.broadcast_arrays(*xyz), axis=-1).reshape(-1, 3) * size, faces


def tree(vertices, faces):
    model = fcl.BVHModel()
    model.beginModel(len(vertices), len(faces))
    model.addSubModel(vertices, faces)
    model.endModel()
    return model

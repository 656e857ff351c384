"""The scenes all engines build, as plain tables. Metres, kilograms, seconds, radians; every body starts unturned.

A body is a solid box: name, size, at, mass. `joint` ties it to `parent` (a body, or None for the world) with the kind `hinge` or
`slide` at a place about an axis; without one it is free. `velocity` and `spin` are those at the start. `target` is that of a position
servo. `ties` close loops: two bodies and the point at which they meet.
"""

import math

G = 9.81


def link(name, parent, at, size, mass, hinge, axis=(0, 1, 0), **more):
    joint = {"kind": "hinge", "at": list(hinge), "axis": list(axis)}
    return {"name": name, "parent": parent, "at": list(at), "size": list(size), "mass": mass, "joint": joint, **more}


def free(name, at, size=(0.1, 0.1, 0.1), mass=1.0, **more):
    return {"name": name, "at": list(at), "size": list(size), "mass": mass, **more}


def scene(seconds, bodies, gravity=(0, 0, -G), floor=False, friction=0.5, ties=()):
    return {"seconds": seconds, "bodies": bodies, "gravity": list(gravity), "floor": floor, "friction": friction,
            "ties": list(ties)}


def rods(count):
    """Rods of 0.3 m in a row, released level."""
    def rod(i):
        return link(f"rod{i}", f"rod{i - 1}" if i else None, (0.3 * i + 0.15, 0, 2), (0.3, 0.02, 0.02), 1.0, (0.3 * i, 0, 2))
    return [rod(i) for i in range(count)]


def pile():
    return [free(f"box{i}", (i % 5 * 0.11, i // 5 % 5 * 0.11, 0.1 + i // 25 * 0.12)) for i in range(100)]


def spread():
    return [free(f"box{i}", (i % 32 * 0.15 - 2.4, i // 32 * 0.15 - 2.4, 0.05)) for i in range(1000)]


def arm():
    def part(i):
        axis = (0, 0, 1) if i % 2 else (0, 1, 0)
        return link(f"link{i}", f"link{i - 1}" if i > 1 else None, (0, 0, 0.16 * i + 0.08), (0.06, 0.06, 0.14),
                    2.5 - 0.3 * i, (0, 0, 0.16 * i), axis, target=0.3)
    return [part(i) for i in range(1, 8)]


def four_bar():
    small = (0.02, 0.02, 0.2)
    return [link("crank", None, (0, 0, 1.1), small, 0.2, (0, 0, 1.0), spin=[0, 3, 0]),
            link("coupler", "crank", (0.25, 0, 1.2), (0.5, 0.02, 0.02), 0.2, (0, 0, 1.2)),
            link("rocker", None, (0.5, 0, 1.1), small, 0.2, (0.5, 0, 1.0))]


SLOPE = math.atan(0.5) + math.radians(5)

SCENES = {
    "pendulum": scene(60, rods(1)),
    "double pendulum": scene(60, rods(2)),
    "box on a slope": scene(2, [free("box", (0, 0, 0.05))], floor=True,
                            gravity=(G * math.sin(SLOPE), 0, -G * math.cos(SLOPE))),
    "gyroscope": scene(60, [free("top", (0, 0, 1), (0.1, 0.2, 0.3), spin=[0.1, 10, 0.1])], gravity=(0, 0, 0)),
    "four-bar": scene(20, four_bar(), ties=[["coupler", "rocker", [0.5, 0, 1.2]]]),
    "tower of ten boxes": scene(60, [free(f"box{i}", (0, 0, 0.1 * i + 0.05)) for i in range(10)], floor=True),
    "arm of seven joints": scene(4, arm()),
    "pile of 100 boxes": scene(10, pile(), floor=True),
    "1000 boxes on the floor": scene(2, spread(), floor=True),
}

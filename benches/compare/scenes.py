"""The scenes all engines build, as plain tables. Metres, kilograms, seconds, radians; every body starts unturned.

A body is a solid box: name, size, at, mass. `joint` ties it to `parent` (a body, or None for the world) with the kind `hinge` or
`weld` at a place about an axis; without one it is free. A body that is `round` is a ball, a `ghost` collides with nothing. Bodies that hang
together by joints do not collide with each other. `velocity` and `spin` are those at the start. `target` is that of a position
servo, `drive` the velocity of a motor. A `wheel` is a cylinder about y of the size (diameter, width, diameter).
`ties` close loops: two bodies and the point at which they meet.
"""

import math

G = 9.81


def link(name, parent, at, size, mass, hinge, axis=(0, 1, 0), **more):
    joint = {"kind": "hinge", "at": list(hinge), "axis": list(axis)}
    return {"name": name, "parent": parent, "at": list(at), "size": list(size), "mass": mass, "joint": joint, **more}


def free(name, at, size=(0.1, 0.1, 0.1), mass=1.0, **more):
    return {"name": name, "at": list(at), "size": list(size), "mass": mass, **more}


def weld(name, parent, at, size, mass, **more):
    return {"name": name, "parent": parent, "at": list(at), "size": list(size), "mass": mass,
            "joint": {"kind": "weld", "at": list(at), "axis": [0, 0, 1]}, **more}


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


def arm(name="link", x=0):
    def part(i):
        axis = (0, 0, 1) if i % 2 else (0, 1, 0)
        return link(f"{name}{i}", f"{name}{i - 1}" if i > 1 else None, (x, 0, 0.16 * i + 0.08), (0.06, 0.06, 0.14),
                    2.5 - 0.3 * i, (x, 0, 0.16 * i), axis, target=0.3)
    return [part(i) for i in range(1, 8)]


def feet(masses):
    """58 kg on one foot each."""
    bodies = []
    for y, mass in enumerate(masses):
        bodies += [free(f"load{y}", (0, y, 0.54), (0.2, 0.2, 0.6), 58), weld(f"foot{y}", f"load{y}", (0, y, 0.02), (0.2, 0.1, 0.04), mass)]
    return bodies


def quadruped():
    """14 kg and 12 servos on round feet, the knees bent."""
    bodies = [free("trunk", (0, 0, 0.32), (0.4, 0.2, 0.1), 8)]
    for i, (x, y) in enumerate([(-0.18, -0.13), (-0.18, 0.13), (0.18, -0.13), (0.18, 0.13)]):
        hidden = {"target": 0.0, "ghost": True}
        bodies += [
            link(f"hip{i}", "trunk", (x, y, 0.3), [0.05] * 3, 0.5, (x, y, 0.3), (1, 0, 0), **hidden),
            link(f"thigh{i}", f"hip{i}", (x - 0.04, y, 0.235), (0.03, 0.03, 0.13), 0.8, (x, y, 0.3), **hidden),
            link(f"shin{i}", f"thigh{i}", (x - 0.04, y, 0.1), (0.03, 0.03, 0.13), 0.2, (x - 0.08, y, 0.17), **hidden),
            weld(f"paw{i}", f"shin{i}", (x, y, 0.02), [0.04] * 3, 0.06, round=True),
        ]
    return bodies


def leg(side, y):
    servo, hidden = {"target": 0.0}, {"target": 0.0, "ghost": True}
    return [
        link(f"yaw{side}", "pelvis", (0, y, 0.89), [0.05] * 3, 0.5, (0, y, 0.89), (0, 0, 1), **hidden),
        link(f"roll{side}", f"yaw{side}", (0, y, 0.89), [0.05] * 3, 0.5, (0, y, 0.89), (1, 0, 0), **hidden),
        link(f"thigh{side}", f"roll{side}", (0, y, 0.69), (0.1, 0.1, 0.36), 5, (0, y, 0.89), **servo),
        link(f"shin{side}", f"thigh{side}", (0, y, 0.3), (0.08, 0.08, 0.36), 2.5, (0, y, 0.5), **servo),
        link(f"ankle{side}", f"shin{side}", (0, y, 0.08), [0.04] * 3, 0.3, (0, y, 0.08), **hidden),
        link(f"foot{side}", f"ankle{side}", (0.03, y, 0.02), (0.24, 0.1, 0.04), 1, (0, y, 0.08), (1, 0, 0), **servo),
        link(f"shoulder{side}", "torso", (0, 2 * y, 1.32), [0.05] * 3, 0.3, (0, 2 * y, 1.32), **hidden),
        link(f"upper{side}", f"shoulder{side}", (0, 2 * y, 1.18), (0.07, 0.07, 0.26), 2, (0, 2 * y, 1.32), (1, 0, 0), **servo),
        link(f"fore{side}", f"upper{side}", (0, 2 * y, 0.9), (0.06, 0.06, 0.26), 1.5, (0, 2 * y, 1.04), **servo),
    ]


def humanoid():
    """62 kg and 20 servos on two flat feet."""
    trunk = [free("pelvis", (0, 0, 0.95), (0.15, 0.25, 0.12), 12),
             link("torso", "pelvis", (0, 0, 1.2), (0.15, 0.3, 0.35), 20, (0, 0, 1.02), (0, 0, 1), target=0.0),
             link("head", "torso", (0, 0, 1.5), (0.15, 0.15, 0.2), 4, (0, 0, 1.4), (0, 0, 1), target=0.0)]
    return trunk + leg(1, -0.1) + leg(2, 0.1)


def rover(drive):
    """A chassis of 10 kg on four cylinders, whose motors turn at `drive` rad/s."""
    chassis = free("chassis", (0, 0, 0.12), (0.5, 0.3, 0.1), 10)
    return [chassis] + [
        link(f"wheel{i}", "chassis", (x, y, 0.08), (0.16, 0.05, 0.16), 0.5, (x, y, 0.08), wheel=True, drive=drive)
        for i, (x, y) in enumerate([(-0.2, -0.2), (-0.2, 0.2), (0.2, -0.2), (0.2, 0.2)])]


def doors():
    """100 boxes, each with a box on a hinge at its side, a little above the floor."""
    def pair(i):
        x, y = i % 10 * 0.4, i // 10 * 0.4
        return [free(f"box{i}", (x, y, 0.06)),
                link(f"door{i}", f"box{i}", (x + 0.11, y, 0.06), (0.1, 0.1, 0.1), 0.3, (x + 0.055, y, 0.11))]
    return [body for i in range(100) for body in pair(i)]


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
    "50 arms": scene(2, [part for i in range(50) for part in arm(f"arm{i}-", i)]),
    "chain of 30": scene(5, rods(30)),
    "58 kg on feet of 5, 1, 0.3 and 0.1 kg": scene(10, feet([5, 1, 0.3, 0.1]), floor=True, friction=1),
    "quadruped": scene(10, quadruped(), floor=True, friction=0.8),
    "humanoid": scene(10, humanoid(), floor=True, friction=1),
    "rover on cylinders": scene(10, rover(5.0), floor=True, friction=0.8),
    "the same, standing": scene(10, rover(0.0), floor=True, friction=0.8),
    "100 boxes with hinged boxes": scene(2, doors(), floor=True),
}

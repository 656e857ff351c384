"""What grasps.py builds in every engine, as plain tables: hands, objects, and what happens to them. Metres, kilograms, seconds, newtons.

The grasp's centre is the origin, z is up, and an object's centre of mass is there. A case is a table of

- `object`: `parts` (convex: box, ball, cylinder, or a mesh of `vertices` and `faces`; each `at` and turned by `yaw` about z), `mass`, `inertia`;
- `fingers`: pads on slides. `at`, `yaw` of the pad, `inward` (unit vector of its slide), `force`; one that `drives` presses with this force, the others keep their
  places up to this force;
- `moving`: whether the palm hangs on five motors (slides along x, y, z, hinges about x, y through the grasp's centre), or on the world;
- `table`: height of the top of what the object stands on, or None;
- `squeeze`: for each sub-step the part of its force with which the driving finger presses;
- `path`: for each sub-step the positions of those five motors after it, and `gravity` during it; then both stay for `hold` seconds.
"""

import math

import numpy as np

G, STEP = 9.81, 0.005
# Of a pair; the fingers' share is the same as the object's, so each has the root where an engine multiplies.
FRICTION = 0.5
PAD, PAD_MASS = (0.01, 0.02, 0.02), 0.05
MASSES = (0.005, 0.1, 2.0)
# How much more than what Coulomb's law asks for in the worst moment a hand presses.
MARGIN = 2.0
GAP, SHAKE, HERTZ = 0.004, 2 * G, 5.0
LIFT, SQUEEZE, CLOSING, RAMP, TURN, REST, SHAKING, HOLD = 0.2, 0.5, 0.6, 0.3, 0.6, 0.1, 0.8, 60.0


def box(size, at=(0, 0, 0), yaw=0.0):
    return {"kind": "box", "size": list(size), "at": list(at), "yaw": yaw}


def mug():
    """A wall of twelve staves, a bottom, and a handle that weighs nothing; the origin is its centre of mass."""
    radius, thick, height, staves = 0.03, 0.004, 0.08, 12
    middle = radius - thick / 2
    width = 2 * radius * math.tan(math.pi / staves)
    at = lambda angle: (middle * math.cos(angle), middle * math.sin(angle), 0)
    parts = [box((thick, width, height), at(i * 2 * math.pi / staves), i * 2 * math.pi / staves) for i in range(staves)]
    bottom = box((1.4 * middle, 1.4 * middle, thick), (0, 0, (thick - height) / 2))
    handle = [box((0.008, 0.025, 0.008), (0, radius + 0.0125, z)) for z in (-0.02, 0.02)] + [box((0.008, 0.008, 0.048), (0, radius + 0.029, 0))]
    heavy = parts + [bottom]
    volumes = np.array([np.prod(part["size"]) for part in heavy])
    drop = volumes @ [part["at"][2] for part in heavy] / volumes.sum()
    for part in heavy + handle:
        part["at"] = [part["at"][0], part["at"][1], part["at"][2] - drop]
    return heavy + handle, sum(map(inertia_of, heavy, volumes / volumes.sum()))


def inertia_of(part, mass):
    """About the origin, along x, y, z: the product moments of what is built here cancel."""
    a, b, c = np.square(part["size"])
    cosine, sine = math.cos(part["yaw"]) ** 2, math.sin(part["yaw"]) ** 2
    turned = a * cosine + b * sine, a * sine + b * cosine
    x, y, z = np.square(part["at"])
    own = np.array([turned[1] + c, turned[0] + c, a + b]) / 12
    return mass * (own + [y + z, x + z, x + y])


def ball_mesh(radius, rings=12, sectors=24):
    ring = [(math.pi * i / rings, 2 * math.pi * j / sectors) for i in range(1, rings) for j in range(sectors)]
    points = [(0, 0, radius)] + [(radius * math.sin(a) * math.cos(b), radius * math.sin(a) * math.sin(b), radius * math.cos(a)) for a, b in ring]
    last = len(points)
    place = lambda i, j: 1 + i * sectors + j % sectors
    faces = []
    for j in range(sectors):
        faces += [(0, place(0, j), place(0, j + 1)), (last, place(rings - 2, j + 1), place(rings - 2, j))]
        for i in range(rings - 2):
            faces += [(place(i, j), place(i + 1, j), place(i + 1, j + 1)), (place(i, j), place(i + 1, j + 1), place(i, j + 1))]
    return points + [(0, 0, -radius)], faces


def prism_mesh(corners, height):
    """Upright, of a convex polygon."""
    n = len(corners)
    points = [(x, y, z) for z in (-height / 2, height / 2) for x, y in corners]
    faces = [(0, i + 1, i) for i in range(1, n - 1)] + [(n, n + i, n + i + 1) for i in range(1, n - 1)]
    for i in range(n):
        j = (i + 1) % n
        faces += [(i, j, n + j), (i, n + j, n + i)]
    return points, faces


def as_mesh(part):
    size = part["size"]
    if part["kind"] == "ball":
        points, faces = ball_mesh(size[0] / 2)
    elif part["kind"] == "cylinder":
        # A vertex of the polygon would touch a pad, so it is turned by half of a side, and its sides touch.
        count = 36
        far = size[0] / 2 / math.cos(math.pi / count)
        angles = [(i + 0.5) * 2 * math.pi / count for i in range(count)]
        points, faces = prism_mesh([(far * math.cos(a), far * math.sin(a)) for a in angles], size[2])
    else:
        x, y = size[0] / 2, size[1] / 2
        points, faces = prism_mesh([(-x, -y), (x, -y), (x, y), (-x, y)], size[2])
    return {"kind": "mesh", "vertices": [list(p) for p in points], "faces": [list(f) for f in faces], "at": part["at"], "yaw": part["yaw"]}


def solid(kind, size, moments):
    return [{"kind": kind, "size": list(size), "at": [0, 0, 0], "yaw": 0.0}], np.array(moments)


def cuboid(*size):
    a, b, c = np.square(size) / 12
    return solid("box", size, (b + c, a + c, a + b))


def forms():
    """By name: parts, moments of inertia per mass, half of the width between pads, half of the height, whether it is round."""
    ball, cylinder = 0.4 * 0.025 ** 2, (3 * 0.025 ** 2 + 0.08 ** 2) / 12
    cup, moments = mug()
    return {
        "box": (*cuboid(0.05, 0.05, 0.05), 0.025, 0.025, False),
        "ball": (*solid("ball", (0.05, 0.05, 0.05), [ball] * 3), 0.025, 0.025, True),
        "cylinder": (*solid("cylinder", (0.05, 0.05, 0.08), (cylinder, cylinder, 0.025 ** 2 / 2)), 0.025, 0.04, True),
        "mug": (cup, moments, 0.03, -min(part["at"][2] - part["size"][2] / 2 for part in cup), True),
        "plate": (*cuboid(0.002, 0.06, 0.06), 0.001, 0.03, False),
    }


FORMS = forms()
HANDS = ("parallel", "three-finger")


def places(hand, is_round, all_drive=False):
    """Direction of each finger and its offset across: the first one drives."""
    if hand == "parallel":
        return [(0, 0), (math.pi, 0)]
    if is_round:
        # All together they are in balance at 120 degrees; two that keep their places stand closer, so that friction does not jam between them.
        angle = math.radians(120 if all_drive else 150)
        return [(0, 0), (angle, 0), (-angle, 0)]
    return [(0, 0), (math.pi, 0.0115), (math.pi, -0.0115)]


def sum_of_normals(fingers):
    """Of what the others press together, by the force of the driving one: 1, or more where they stand in a V."""
    return 1 / abs(math.cos(fingers[1][0]))


def critical_force(fingers, mass):
    """That of the driving finger with which friction just bears the weight."""
    return mass * G / (FRICTION * (1 + sum_of_normals(fingers)))


def grip_force(fingers, mass):
    """Enough for every moment of the path: shaken up, shaken towards the driving finger, turned so that it lies below."""
    share = sum_of_normals(fingers)
    def needed(across, along):
        return (across * mass / FRICTION + along * (PAD_MASS + share * (PAD_MASS + mass))) / (1 + share)
    return MARGIN * max(needed(G + SHAKE, 0), needed(G, SHAKE), needed(0, G))


def fingers_of(hand, form, force, all_drive):
    _, _, width, _, is_round = FORMS[form]
    made = []
    for number, (angle, across) in enumerate(places(hand, is_round, all_drive)):
        away = np.array([math.cos(angle), math.sin(angle), 0])
        side = np.array([-away[1], away[0], 0])
        drives = number == 0 or all_drive
        at = away * (width + PAD[0] / 2 + (GAP if drives else 0)) + side * across
        made.append({"at": at.tolist(), "yaw": angle, "inward": (-away).tolist(), "drives": drives, "force": force if drives else 10 * force + 10})
    return made


def rise(s):
    """The path of least jerk from 0 to 1."""
    s = np.clip(s, 0, 1)
    return s ** 3 * (10 - 15 * s + 6 * s ** 2)


def moves():
    """The five positions of the palm over time from the lift on, a column each."""
    at = lambda seconds: np.arange(1, round(seconds / STEP) + 1) * STEP
    still = np.zeros((round(REST / STEP), 5))
    def one(column, values):
        part = np.zeros((len(values), 5))
        part[:, column] = values
        return part
    parts = [one(2, LIFT * rise(at(1.0)))]
    for column in (3, 4):
        up = math.pi / 2 * rise(at(TURN) / TURN)
        parts += [still, one(column, up), still + one(column, [math.pi / 2] * len(still)), one(column, math.pi / 2 - up)]
    swing = SHAKE / (2 * math.pi * HERTZ) ** 2
    t = at(SHAKING)
    envelope = rise(t / 0.2) * rise((SHAKING - t) / 0.2)
    for column in range(3):
        parts += [still, one(column, swing * envelope * np.sin(2 * math.pi * HERTZ * t))]
    path = np.concatenate([*parts, still, still, still, still, still])
    path[len(parts[0]):, 2] += LIFT
    return path


def acceleration(path):
    """Of the palm in each sub-step."""
    before = np.concatenate([np.zeros((2, 3)), path[:, :3]])
    return np.diff(before, n=2, axis=0) / STEP ** 2


def own_gravity(path):
    """What a hand that does not move feels instead."""
    felt = -acceleration(path) - [0, 0, G]
    turned = []
    for vector, (a, b) in zip(felt, path[:, 3:]):
        about_x = np.array([[1, 0, 0], [0, math.cos(a), -math.sin(a)], [0, math.sin(a), math.cos(a)]])
        about_y = np.array([[math.cos(b), 0, math.sin(b)], [0, 1, 0], [-math.sin(b), 0, math.cos(b)]])
        turned.append((about_x @ about_y).T @ vector)
    return np.array(turned)


def path_and_gravity(moving, is_still):
    """Closing without gravity unless the object stands on a table, then gravity, then the path."""
    closing, ramp = round(CLOSING / STEP), round(RAMP / STEP)
    path = np.zeros((round(REST / STEP), 5)) if is_still else moves()
    down = np.array([0.0, 0.0, -G])
    on_table = moving and not is_still
    start = np.outer(np.concatenate([np.zeros(closing), rise(np.arange(1, ramp + 1) / ramp)]) if not on_table else np.ones(closing + ramp), down)
    gravity = np.tile(down, (len(path), 1)) if moving else own_gravity(path)
    return np.concatenate([np.zeros((closing + ramp, 5)), path]), np.concatenate([start, gravity]), closing + ramp


def case(hand, form, mesh, mass, moving, factor=None):
    """A grasp that is lifted, turned, shaken and held; with a `factor`, one that only holds, with that many times the critical force. Round things are then
    pressed by all fingers alike: in a V of fingers that keep their places friction may jam a thing, so that the pressure is not determined."""
    parts, moments, _, height, is_round = FORMS[form]
    all_drive = factor is not None and is_round
    fingers = places(hand, is_round, all_drive)
    force = factor * critical_force(fingers, mass) if factor else grip_force(fingers, mass)
    path, gravity, start = path_and_gravity(moving, factor is not None)
    accelerations = acceleration(path) if moving else np.zeros((len(path), 3))
    return {
        "hand": hand, "form": form, "mesh": mesh, "moving": moving, "factor": factor, "force": force,
        "object": {"parts": [as_mesh(part) for part in parts] if mesh else parts, "mass": mass, "inertia": (moments * mass).tolist()},
        "fingers": fingers_of(hand, form, force, all_drive), "table": -height if moving and not factor else None,
        "squeeze": rise(np.arange(1, len(path) + 1) * STEP / SQUEEZE).tolist(), "path": path.tolist(), "gravity": gravity.tolist(), "start": start, "accelerations": accelerations.tolist(),
        "hold": 2.0 if factor else HOLD, "step": STEP, "friction": FRICTION, "pad": list(PAD), "pad_mass": PAD_MASS,
    }

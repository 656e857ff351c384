"""Messages of every type that rosbags and Swanilda know, as rosbags writes them: a line for each, the type and its bytes.

    python tests/interop/ros2_vectors.py > crates/ros-interfaces/tests/cdr_vectors.txt

The values are random, but the same each time. Types that only one side knows are left out.
"""

import pathlib
import random

import numpy
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_typestore

STORE = get_typestore(Stores.ROS2_JAZZY)
ROOT = pathlib.Path(__file__).parents[2]
DESCRIPTIONS = ROOT / "crates/ros-interfaces/descriptions/ros2"
INTEGERS = {f"{sign}int{bits}": (sign, bits) for sign in ("u", "") for bits in (8, 16, 32, 64)}


def number(kind):
    if kind == "bool":
        return random.random() < 0.5
    if kind in ("byte", "octet", "char"):
        return random.randrange(128)  # rosbags takes bytes for numbers with a sign
    if kind in INTEGERS:
        sign, bits = INTEGERS[kind]
        return random.randrange(1 << bits) - (0 if sign else 1 << bits - 1)
    return float(numpy.float32(random.uniform(-1e3, 1e3)))


def base(kind):
    if kind == "string":
        return "".join(random.choices("abc äö", k=random.randrange(6)))
    return number(kind)


def value(description):
    node, what = description
    if node == Nodetype.BASE:
        return base(what[0])
    if node == Nodetype.NAME:
        return message(what)
    element, size = what
    count = size if node == Nodetype.ARRAY else random.randrange(4) if not size else random.randrange(min(4, size + 1))
    values = [value(element) for _ in range(count)]
    if element[0] == Nodetype.BASE and element[1][0] != "string":
        kind = {"byte": "uint8", "octet": "uint8", "char": "uint8"}.get(element[1][0], element[1][0])
        return numpy.array(values, dtype=kind)
    return values


def message(name):
    fields = STORE.fielddefs[name][1]
    # Structures without fields get one from ROS 2, which is always zero.
    values = {field: value(what) if field != "structure_needs_at_least_one_member" else 0 for field, what in fields}
    return STORE.types[name](**values)


def is_known(name):
    package, kind, short = name.split("/")
    path = DESCRIPTIONS / f"{package}.txt"
    return kind == "msg" and path.exists() and f"msg {short}" in path.read_text().splitlines()


def main():
    for name in sorted(STORE.types):
        if not is_known(name):
            continue
        for part in range(2):
            random.seed(f"{name} {part}")
            print(name, bytes(STORE.serialize_cdr(message(name), name)).hex())


main()

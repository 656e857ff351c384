"""Types of ROS 2 for CycloneDDS, made of the descriptions of the packages, and clients of services and actions as rmw_cyclonedds speaks."""

import itertools
import os
import pathlib
import re
import sys
import time

DOMAIN = int(os.environ.get("DOMAIN", 100 + os.getpid() % 100))
INTERFACE = '<NetworkInterface name="lo" multicast="true"/>'
# A test may have other settings of the domain; they have to be there before this file is imported.
SETTINGS = os.environ.get("CYCLONE_DOMAIN", f"<General><Interfaces>{INTERFACE}</Interfaces></General>")
os.environ["CYCLONEDDS_URI"] = f"<CycloneDDS><Domain>{SETTINGS}</Domain></CycloneDDS>"
os.environ["ROS_DOMAIN_ID"] = str(DOMAIN)

from cyclonedds.core import Policy, Qos  # noqa: E402
from cyclonedds.domain import DomainParticipant  # noqa: E402
from cyclonedds.idl import make_idl_struct, types  # noqa: E402
from cyclonedds.pub import DataWriter  # noqa: E402
from cyclonedds.sub import DataReader  # noqa: E402
from cyclonedds.topic import Topic  # noqa: E402
from cyclonedds.util import duration  # noqa: E402

DESCRIPTIONS = pathlib.Path(__file__).parents[2] / "crates/ros-interfaces/descriptions/ros2"
LATCHED = Qos(Policy.Reliability.Reliable(duration(seconds=10)), Policy.History.KeepLast(1), Policy.Durability.TransientLocal)
RELIABLE = Qos(Policy.Reliability.Reliable(duration(seconds=10)), Policy.History.KeepAll)
PRIMITIVES = {"bool": bool, "string": str, **{f"{kind}{size}": getattr(types, f"{kind}{size}") for kind in ("int", "uint") for size in (8, 16, 32, 64)}}
PRIMITIVES |= {"char": types.uint8, "float32": types.float32, "float64": types.float64, "byte": types.uint8}
DEFAULTS = {bool: False, str: ""}
LIMIT = 20  # seconds for anything

_parts = {}  # package/kind/Name -> the fields of each of its parts
_types = {}


def _read(package):
    name, fields = None, None
    for line in (DESCRIPTIONS / f"{package}.txt").read_text().splitlines():
        if line.startswith("#"):
            continue
        if not line.startswith(" "):
            kind, short = line.split()
            name, fields = f"{package}/{kind}/{short}", []
            _parts[name] = [fields]
        elif line.strip() == "---":
            fields = []
            _parts[name].append(fields)
        else:
            for field in line.strip().split("; "):
                if "=" not in field.split()[1]:
                    kind, short = field.split()[:2]
                    fields.append((short, kind))


def _fields(package, fields):
    return {short: _type(package, kind) for short, kind in fields}


def _type(package, kind):
    base, array = re.fullmatch(r"([\w/]+)(?:<=\d+)?(?:\[((?:<=)?\d*)\])?", kind).groups()
    if base not in PRIMITIVES:
        owner, short = base.split("/") if "/" in base else (package, base)
        element = message(f"{owner}/msg/{short}")
    else:
        element = PRIMITIVES[base]
    if array is None:
        return element
    if array.startswith("<="):
        return types.sequence[element, int(array[2:])]
    return types.array[element, int(array)] if array else types.sequence[element]


def _struct(full, fields):
    package, kind, short = full.split("/")
    if full not in _types:
        fields = fields or {"structure_needs_at_least_one_member": types.uint8}
        _types[full] = make_idl_struct(short, f"{package}::{kind}::dds_::{short}_", fields)
    return _types[full]


def _parts_of(full):
    if full not in _parts:
        _read(full.split("/")[0])
    return _parts[full]


def message(full):
    """The type `package/msg/Name`."""
    return _types.get(full) or _struct(full, _fields(full.split("/")[0], _parts_of(full)[0]))


def make(kind, **fields):
    """A value of a type, whose other fields have their defaults."""
    values = {}
    for name, field in kind.__idl_field_types__.items() if hasattr(kind, "__idl_field_types__") else _annotations(kind).items():
        values[name] = fields.pop(name) if name in fields else _default(field)
    assert not fields, f"{kind.__name__} has no {list(fields)}"
    return kind(**values)


def _annotations(kind):
    return {name: field for name, field in kind.__annotations__.items()}


def _default(field):
    if hasattr(field, "__idl_typename__") or hasattr(field, "__idl__"):
        return make(field)
    if field in DEFAULTS:
        return DEFAULTS[field]
    text = repr(field)
    if "sequence" in text:
        return []
    if "array" in text:
        return [0] * 16
    return 0.0 if "float" in text else 0


PARTICIPANT = DomainParticipant(DOMAIN)


def reader(name, kind, qos=RELIABLE):
    return DataReader(PARTICIPANT, Topic(PARTICIPANT, name, kind), qos=qos)


def writer(name, kind, qos=RELIABLE):
    return DataWriter(PARTICIPANT, Topic(PARTICIPANT, name, kind), qos=qos)


def until(what, ask, limit=LIMIT):
    end = time.monotonic() + limit
    while time.monotonic() < end:
        answer = ask()
        if answer:
            return answer
        time.sleep(0.002)
    sys.exit(f"{what}: nothing within {limit} s")


def samples(of):
    return [sample for sample in of.take(N=1000) if type(sample).__name__ != "InvalidSample"]


def announce(name, writers):
    """Says that this participant has a node of that full name with these writers, as rmw does. Returns what has to live as long."""
    info = message("rmw_dds_common/msg/ParticipantEntitiesInfo")
    gid, node = message("rmw_dds_common/msg/Gid"), message("rmw_dds_common/msg/NodeEntitiesInfo")

    def identity(entity):
        return gid(list(entity.guid.bytes))

    namespace, _, short = name.rpartition("/")
    said = writer("ros_discovery_info", info, LATCHED)
    said.write(info(identity(PARTICIPANT), [node(namespace or "/", short, [], [identity(one) for one in writers])]))
    return said


def nodes():
    """The nodes of all participants: full names, with how many readers and writers they have."""
    listener = reader("ros_discovery_info", message("rmw_dds_common/msg/ParticipantEntitiesInfo"), LATCHED)
    found = {}

    def look():
        for info in samples(listener):
            for node in info.node_entities_info_seq:
                found[node.node_namespace.rstrip("/") + "/" + node.node_name] = (len(node.reader_gid_seq), len(node.writer_gid_seq))
        return found

    return look


class Client:
    """A client of a service; `parts` are the fields of request and response."""

    numbers = itertools.count(1)

    def __init__(self, name, kind, parts=None):
        package = kind.split("/")[0]
        parts = parts or [_fields(package, fields) for fields in _parts_of(kind)]
        head = {"client": types.uint64, "number": types.int64}
        self.name = name
        self.request = _struct(f"{kind}_Request", head | (parts[0] or {"structure_needs_at_least_one_member": types.uint8}))
        self.response = _struct(f"{kind}_Response", head | parts[1])
        self.replies = reader(f"rr/{name}Reply", self.response)
        self.requests = writer(f"rq/{name}Request", self.request)

    def __call__(self, **fields):
        number = self.send(**fields)
        return self.reply(number)

    def send(self, **fields):
        until(f"a server of {self.name}", lambda: self.requests.get_matched_subscriptions() and self.replies.get_matched_publications())
        number = next(Client.numbers)
        self.requests.write(make(self.request, client=77, number=number, **fields))
        return number

    def reply(self, number):
        got = until(f"a reply of {self.name}", lambda: [reply for reply in samples(self.replies) if reply.number == number])
        return got[0]

    def is_silent(self):
        time.sleep(0.3)
        return not samples(self.replies)


class ActionClient:
    """A client of an action."""

    def __init__(self, name, kind):
        package = kind.split("/")[0]
        goal, result, feedback = (_struct(f"{kind}{part}", _fields(package, fields)) for part, fields in zip(("_Goal", "_Result", "_Feedback"), _parts_of(kind)))
        uuid, stamp = message("unique_identifier_msgs/msg/UUID"), message("builtin_interfaces/msg/Time")
        self.goal, self.uuid = goal, uuid
        self.goals = Client(f"{name}/_action/send_goal", f"{kind}_SendGoal", [{"goal_id": uuid, "goal": goal}, {"accepted": bool, "stamp": stamp}])
        self.results = Client(f"{name}/_action/get_result", f"{kind}_GetResult", [{"goal_id": uuid}, {"status": types.int8, "result": result}])
        info = message("action_msgs/msg/GoalInfo")
        self.cancels = Client(f"{name}/_action/cancel_goal", "action_msgs/srv/CancelGoal", [{"goal_info": info}, {"return_code": types.int8, "goals_canceling": types.sequence[info]}])
        self.info = info
        self.feedback = reader(f"rt/{name}/_action/feedback", _struct(f"{kind}_FeedbackMessage", {"goal_id": uuid, "feedback": feedback}))
        self.count = 0

    def send(self, **fields):
        self.count += 1
        self.id = self.uuid([self.count] + [0] * 15)
        return self.goals(goal_id=self.id, goal=make(self.goal, **fields))

    def result(self):
        return self.results(goal_id=self.id)

    def cancel(self):
        return self.cancels(goal_info=make(self.info, goal_id=self.id))

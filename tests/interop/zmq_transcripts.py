"""Replies byte for byte as CoppeliaSim's server was recorded to give them."""

import cbor2

from compare import same
from raw import Peer

DEFINITIONS = r"""
function fail() error('boom\nline2\tx', 0) end
function none() end
function called(f, a, b) return f(a, b) end
function calledTwice(f) local x = f(1) return x + f(2) end
function calledInMap(t) return t.g(5) end
function show(v)
    if isbuffer(v) then return 'buffer of ' .. #v end
    return type(v) == 'table' and table.concat(v, ' ') or tostring(v)
end
function types(...) return select('#', ...), select('#', ...) == 0 and '' or table.concat({...}, '|') end
"""

CHUNKS = {
    "return 'abc'": "a1637265748163616263",
    "return tobuffer('abc')": "a1637265748143616263",
    "return {}": "a16372657481a0",
    "return {1, 2}": "a16372657481820102",
    "return 1, nil, {1, 2}": "a1637265748301f6820102",
    "return": "a163726574a0",
    "return nil": "a16372657481f6",
    r"return '\xff\xfe'": "a1637265748142fffe",
    "return {1, nil, 3}": "a163726574818301f603",
    "return {{1, 2}, {a = {}}}, {[3] = 1}": "a1637265748282820102a16161a0a10301",
    "return 1.0, 0.1, 1/0, -1/0, 9007199254740992.0, 3": "a16372657486f93c00fb3fb999999999999af97c00f9fc00fa5a00000003",
    "return -0.0, 0.5, 65505.0": "a16372657483f98000f93800fa477fe100",
    "return 1+1, 'x'": "a16372657482026178",
    "error('e', 0)": "a1636572726165",
    "error('boom', 0)": "a16365727264626f6f6d",
    "error('a\\nb\\tc', 0)": "a1636572726f615f3d4e4c3d5f625f3d54423d5f63",
}

CALLS = {
    ("sim.nosuch",): "a163657272781c4e6f20737563682066756e6374696f6e3a2073696d2e6e6f73756368",
    ("none",): "a163726574a0",
    ("string.rep", "ab", 2): "a163726574816461626162",
    ("types",): "a163726574820060",
    ("zmqRemoteApi.info", "_VERSION"): "a16372657481674c756120352e34",
    ("zmqRemoteApi.info", "nope"): "a16372657481f6",
    ("zmqRemoteApi.require", "sim"): "a163726574a0",
    ("_*executed*_",): "a163657272781e4e6f20737563682066756e6374696f6e3a205f2a65786563757465642a5f",
    ("sim.getObjectSel",): "a1637265748180",
    ("_*end*_",): "a0",
}

# The request, and the recorded reply.
CALLBACKS = [
    ({"func": "called", "args": ["mycb@func", 1, 2]}, "a26466756e63646d7963626461726773820102"),
    ({"func": "_*executed*_", "args": [8], "argsL": 1}, "a1637265748108"),
    ({"func": "calledTwice", "args": ["f@func"]}, "a26466756e63616664617267738101"),
    ({"func": "string.rep", "args": ["abc", 1]}, "a1637265748163616263"),
    ({"func": "_*executed*_", "args": [10]}, "a26466756e63616664617267738102"),
    ({"func": "_*executed*_", "args": [20]}, "a16372657481181e"),
    ({"func": "calledInMap", "args": [{"g": "g@func"}]}, "a26466756e63616764617267738105"),
    ({"func": "_*executed*_", "args": [[1, 2]]}, "a16372657481820102"),
    ({"func": "called", "args": ["mycb@func", 1, 2]}, "a26466756e63646d7963626461726773820102"),
    ({"func": "_*executed*_", "args": []}, "a163726574a0"),
    ({"func": "called", "args": ["mycb@func", 1]}, "a26466756e63646d79636264617267738101"),
    ({"func": "_*executed*_", "args": []}, "a163726574a0"),
    ({"func": "called", "args": ["mycb@func"]}, "a26466756e63646d7963626461726773a0"),
    ({"func": "_*executed*_", "args": []}, "a163726574a0"),
    ({"func": "sim.step", "args": []}, "a26466756e63685f2a776169742a5f6461726773a0"),
    ({"func": "_*executed*_", "args": []}, "a163726574a0"),
    ({"func": "sim.setStepping", "args": [True]}, "a1637265748100"),
    ({"func": "sim.setStepping", "args": [False]}, "a1637265748101"),
    ({"func": "sim.acquireLock", "args": []}, "a163726574a0"),
    ({"func": "sim.releaseLock", "args": []}, "a163726574a0"),
]


# An argument as CBOR, and what Lua makes of it.
ARGUMENTS = {
    "1bffffffffffffffff": "-1",
    "3b7fffffffffffffff": "-9223372036854775808",
    "1b7fffffffffffffff": "9223372036854775807",
    "c249010000000000000000": "buffer of 9",
    "f7": "nil",
    "f97e00": "nan",
    "9f0102ff": "1 2",
    "bf0163616263ff": "abc",
    "d84043010203": "1 2 3",
    "d84544010002ff": "1 65282",
    "d855440000803f": "1.0",
    "d85648000000000000e03f": "0.5",
    "d9d9f705": "5",
    "d8208101": "1",
}


def official_requests(peer):
    """What the official client was recorded to send."""
    uuid = "782463303662333833322d353030382d346362622d623337322d343666663932636163666535"
    require = (
        "a76466756e63747a6d7152656d6f74654170692e726571756972656461726773816373696d65617267734c016475756964"
        + uuid
        + "6376657202646c616e6766707974686f6e6774696d656f7574190258"
    )
    same("require", peer.exchange(bytes.fromhex(require)).hex(), "a163726574a0")
    missing = "a46466756e636d73696d2e6765744f626a656374646172677381622f5865617267734c016475756964" + uuid
    same("a missing object", peer.exchange(bytes.fromhex(missing))[:5].hex(), "a163657272")


def odd_values(peer):
    """What CBOR allows and Python does not send."""
    for argument, shown in ARGUMENTS.items():
        request = b"\xa3" + cbor2.dumps("func") + cbor2.dumps("show") + cbor2.dumps("uuid") + cbor2.dumps("odd")
        request += cbor2.dumps("args") + b"\x81" + bytes.fromhex(argument)
        same(argument, cbor2.loads(peer.exchange(request)), {"ret": [shown]})


def main():
    peer = Peer("a")
    peer.ask(eval=DEFINITIONS)
    for chunk, expected in CHUNKS.items():
        same(chunk, peer.bytes(eval=chunk).hex(), expected)
    for (func, *args), expected in CALLS.items():
        same(func, peer.bytes(func=func, args=args, argsL=len(args)).hex(), expected)
    for request, expected in CALLBACKS:
        same(str(request), peer.bytes(**request).hex(), expected)
    official_requests(Peer("official"))
    odd_values(peer)


main()

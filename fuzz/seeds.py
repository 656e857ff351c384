"""Seeds for the fuzz targets that find little without them; of one target: `seeds.py NAME`, as the functions at the end are named.

Of scene_file: the scenes of tests/data, as they are and uncompressed. What is changed in compressed data changes all that follows; only
uncompressed files let single changes reach the chunks.

Of unpacked_scene: the files of a model of tests/data, which is unpacked into fuzz/unpacked.

Of mesh_* and gltf_asset: a square in each format.

Of urdf, sdf and mjcf: the files in the tests. Of ros_message and ros2_message: the built-in types, with messages that fit some of them. Of rtps:
how a participant introduces itself, and what its writers and readers send. Of python_message: values. Of qml_message: a message of each kind. Of soft_text: a rope, a cloth and a volume. Of view_request: the requests in the tests. Of mcp_message: a request of each method.

Of compressed_image: PNG files of four kinds and a JPEG file.
"""

import base64
import json
import marshal
import pathlib
import re
import struct
import subprocess
import sys
import zlib

HEADER = 1021
METHOD = 12  # 1: compressed, 0: not
ROOT = pathlib.Path(__file__).resolve().parent


def bits(data):
    for byte in data:
        for shift in range(7, -1, -1):
            yield byte >> shift & 1


def tree(stream):
    """A leaf is its byte, an inner node the pair of its branches; a 1 before eight bits is a leaf."""
    if next(stream):
        return int("".join(str(next(stream)) for _ in range(8)), 2)
    return tree(stream), tree(stream)


def inflated(data, size):
    stream = bits(data)
    root = tree(stream)
    body = bytearray()
    while len(body) < size:
        node = root
        while isinstance(node, tuple):
            node = node[next(stream)]
        body.append(node)
    return bytes(body)


def uncompressed(file):
    size = int.from_bytes(file[METHOD + 1 : METHOD + 5], "little")
    head = bytearray(file[:HEADER])
    head[METHOD] = 0
    return bytes(head) + inflated(file[HEADER:], size)


def scene_file():
    corpus = ROOT / "corpus" / "scene_file"
    corpus.mkdir(parents=True, exist_ok=True)
    for path in sorted((ROOT.parent / "tests" / "data").glob("*.tt[tm]")):
        file = path.read_bytes()
        (corpus / path.name).write_bytes(file)
        (corpus / f"plain_{path.name}").write_bytes(uncompressed(file))


def unpacked_scene():
    """The first byte of an input says which file it stands for, in the order of their names."""
    folder, model = ROOT / "unpacked" / "robot", ROOT.parent / "tests" / "data" / "robot.ttm"
    folder.parent.mkdir(exist_ok=True)
    subprocess.run(["cargo", "run", "--quiet", "--", "unpack", model, folder], cwd=ROOT.parent, check=True)
    corpus = ROOT / "corpus" / "unpacked_scene"
    corpus.mkdir(parents=True, exist_ok=True)
    for number, path in enumerate(sorted(path for path in folder.rglob("*") if path.is_file())):
        (corpus / path.name).write_bytes(bytes([number]) + path.read_bytes())


def chunk(kind, *contents):
    """A chunk of 3DS."""
    content = b"".join(contents)
    return struct.pack("<HI", kind, 6 + len(content)) + content


def gltf(points):
    json = b"""{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[1,2,1],"children":[1]},{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"mode":5,"material":0}]}],
        "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1],"baseColorTexture":{"index":0}}}],
        "textures":[{"source":0}],"images":[{"uri":"a.png"}],"bufferViews":[{"buffer":0,"byteLength":48}],"buffers":[{"byteLength":48}],
        "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":4},
            {"componentType":5126,"type":"VEC2","count":4,"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}}]}"""
    json += b" " * (-len(json) % 4)
    body = struct.pack("<I", len(json)) + b"JSON" + json + struct.pack("<I", 48) + b"BIN\0" + points
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


COLLADA = b"""<COLLADA><asset><unit meter="0.01"/><up_axis>X_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array>0 0 0 1 0 0 1 1 0 0 1 0</float_array></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist material="m"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#p" offset="1"/><vcount>4</vcount>
<p>0 0 1 1 2 2 3 3</p></polylist></mesh></geometry></library_geometries><library_visual_scenes><visual_scene><node id="n"><rotate>0 0 1 30</rotate>
<lookat>1 2 3 0 0 0 0 0 1</lookat><instance_geometry url="#g"/></node><node><instance_node url="#n"/></node></visual_scene></library_visual_scenes></COLLADA>"""
OBJ = b"mtllib a\nnewmtl m\nKd 1 0 0\nmap_Kd a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl m\nf 1/1/1 2/1/1 3//1 -1\n"
PLY = b"element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
DXF = (
    "0 SECTION 2 ENTITIES 0 3DFACE 8 a 10 0 20 0 30 0 11 1 21 0 31 0 12 1 22 1 32 0 13 0 23 1 33 0 "
    "0 POLYLINE 70 64 0 VERTEX 70 192 10 1 0 VERTEX 70 192 20 1 0 VERTEX 70 192 30 1 0 VERTEX 70 128 71 1 72 -2 73 3 0 SEQEND "
    "0 POLYLINE 70 49 71 2 72 2 0 VERTEX 10 0 0 VERTEX 10 1 0 VERTEX 20 1 0 VERTEX 30 1 0 SEQEND 0 ENDSEC 0 EOF "
)


def write(name, content):
    path = ROOT / "corpus" / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


SPOT = {"type": "spot", "color": [1, 0, 0], "intensity": 2, "spot": {"outerConeAngle": 0.5}}
NODES = {
    "asset": {"version": "2.0"},
    "extensions": {"KHR_lights_punctual": {"lights": [SPOT, {"type": "point"}, {"type": "directional"}]}},
    "cameras": [
        {"type": "perspective", "perspective": {"yfov": 1, "aspectRatio": 1.5, "znear": 0.1, "zfar": 10}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 2, "znear": 0, "zfar": 9}},
    ],
    "nodes": [
        {"mesh": 0, "children": [1, 2], "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1]},
        {"camera": 0, "rotation": [0, 0, 0.6, 0.8]},
        {"camera": 1, "translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}},
    ],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [
        {"bufferView": 0, "componentType": 5121, "type": "VEC3", "count": 3},
        {"bufferView": 0, "componentType": 5121, "type": "SCALAR", "count": 3},
    ],
    "bufferViews": [{"buffer": 0, "byteLength": 9}],
    "buffers": [{"byteLength": 9, "uri": "data:;base64,AAECAAEAAAAB"}],
}


def meshes():
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    points = b"".join(struct.pack("<3f", *corner) for corner in corners)
    faces = struct.pack("<9H", 2, 0, 1, 2, 0, 0, 2, 3, 0)
    mesh = chunk(0x4100, chunk(0x4110, struct.pack("<H", 4), points), chunk(0x4120, faces, chunk(0x4130, b"red\0\1\0\1\0")))
    material = chunk(0xAFFF, chunk(0xA000, b"red\0"), chunk(0xA020, chunk(0x11, b"\xff\0\0")), chunk(0xA200, chunk(0xA300, b"a\0")))
    facet = b"facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
    seeds = {
        "obj/text": OBJ,
        "stl/text": b"solid a\n" + facet + b"endsolid a\n",
        "stl/binary": b"COLOR=red".ljust(80) + struct.pack("<I", 1) + bytes(12) + points[:36] + bytes(2),
        "ply/text": b"ply\nformat ascii 1.0\n" + PLY + b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n",
        "ply/binary": b"ply\nformat binary_little_endian 1.0\n" + PLY + points + b"\4" + struct.pack("<4i", 0, 1, 2, 3),
        "collada/text": COLLADA,
        "gltf/binary": gltf(points),
        "three_ds/binary": chunk(0x4D4D, chunk(0x3D3D, material, chunk(0x4000, b"square\0", mesh))),
        "dxf/text": DXF.replace(" ", "\n").encode(),
    }
    for name, content in seeds.items():
        write(f"mesh_{name}", content)
    write("gltf_asset/binary", gltf(points))
    write("gltf_asset/nodes", json.dumps(NODES).encode())


def robots():
    tests = ROOT.parent / "crates" / "robot-description" / "tests"
    for path in sorted(tests.glob("*.rs")):
        found = re.findall(r'r#"(.*?)"#|"(\s*<(?:[^"\\]|\\.)*)"', path.read_text(), re.S)
        for number, text in enumerate(raw or plain.replace('\\"', '"').replace("\\n", "\n") for raw, plain in found):
            roots = {"<mujoco": "mjcf", "<sdf": "sdf", "<robot": "urdf"}
            target = next((roots[root] for root in roots if root in text), path.stem)
            if target in roots.values():
                write(f"{target}/{path.stem}_{number}", text.encode())


MESSAGES = [bytes(64), struct.pack("<I", 3) + b"abc" + bytes(40), struct.pack("<4I8d", 1, 2, 3, 1, *range(8)), b"\1\0\0\0" * 40]


def ros_input(text, message):
    """As the crate `arbitrary` takes a text and bytes: the length of the text is at the end, in two bytes where one is too few."""
    body = text.encode() + message
    return body + struct.pack("B" if len(body) < 256 else ">H", len(text.encode()))


def ros():
    for generation in (0, 1):
        folder = ROOT.parent / "crates" / "ros-interfaces" / "descriptions" / f"ros{generation + 1}"
        for path in sorted(folder.glob("*.txt")):
            for name, lines in re.findall(r"^msg (\w+)\n((?: .*\n?)*)", path.read_text(), re.M):
                members = [member.strip() for member in re.split("[;\n]", lines) if member.strip()]
                # Types of the same package are of another one for the fuzzed type.
                text = "\n".join(re.sub(r"^(?!Header)(?=[A-Z]\w*(\[.*?\])? )", f"{path.stem}/", member) for member in members)
                message = MESSAGES[len(text) % len(MESSAGES)]
                write(f"ros_message/{generation}_{path.stem}_{name}", bytes([generation]) + ros_input(text, message))
                if generation:
                    write(f"ros2_message/{path.stem}_{name}", ros_input(text, message))


def parameters(*entries):
    """A list of parameters, each an identifier and its value."""
    return b"\0\3\0\0" + b"".join(struct.pack("<HH", key, len(value)) + value for key, value in entries) + b"\1\0\0\0"


def cdr_text(text):
    value = struct.pack("<I", len(text) + 1) + text + b"\0"
    return value + bytes(-len(value) % 4)


def submessage(kind, flags, *parts):
    body = b"".join(parts)
    return struct.pack("<BBH", kind, flags | 1, len(body)) + body


def data(reader, writer, sequence, payload):
    return submessage(0x15, 4, struct.pack("<HH4s4siI", 0, 16, reader, writer, 0, sequence), payload)


def rtps():
    own, place = bytes([2] * 12), struct.pack("<II12x4B", 1, 7412, 127, 0, 0, 1)
    participant = parameters(
        (0x50, own + b"\0\0\1\xc1"), (0x16, b"\1\x10\0\0"), (0x58, struct.pack("<I", 0xC3F)), (0x32, place), (0x31, place), (2, bytes([20] + [0] * 7))
    )
    submessages = [data(b"\0\1\0\xc7", b"\0\1\0\xc2", 1, participant)]
    for topic, entity in ((3, b"\0\0\1\3"), (4, b"\0\0\2\4")):
        reader, writer = bytes([0, 0, topic, 0xC7]), bytes([0, 0, topic, 0xC2])
        endpoint = parameters((0x5A, own + entity), (5, cdr_text(b"rt/a")), (7, cdr_text(b"T")), (0x1A, struct.pack("<IQ", 2, 0)))
        submessages += [submessage(7, 0, reader, writer, struct.pack("<iIiII", 0, 1, 0, 1, 1)), data(reader, writer, 1, endpoint)]
    reader, writer = b"\0\0\2\4", b"\0\0\1\3"
    numbers = struct.pack("<iIII", 0, 1, 2, 3 << 30)
    fragment = struct.pack("<HH4s4siIIHHI", 0, 28, reader, writer, 0, 2, 1, 1, 8, 16)
    submessages += [
        data(reader, writer, 1, b"\0\1\0\0abcd"),
        submessage(0x16, 0, fragment, b"\0\1\0\0abcd"),
        submessage(7, 0, reader, writer, struct.pack("<iIiII", 0, 1, 0, 3, 2)),
        submessage(6, 0, reader, writer, numbers, struct.pack("<I", 1)),
        submessage(8, 0, reader, writer, struct.pack("<iI", 0, 2), numbers),
        submessage(0x12, 0, reader, writer, struct.pack("<iIIIII", 0, 2, 1, 2, 3 << 30, 1)),
    ]
    write("rtps/conversation", b"".join(struct.pack("<H", len(one)) + one for one in submessages))
    for number in range(1, len(submessages) + 1):
        whole = b"".join(submessages[:number])
        write(f"rtps/datagram_{number}", struct.pack("<H", len(whole)) + whole)


def python_message():
    messages = [("c", "sim.x", [1, "a", {}]), ("r", [1, None]), ("e", "x"), ("n",), ("p", "x"), ("w", 2, "x")]
    values = [True, -5, 1.5, "\u20ac", b"xy", [1, [2, (3,)]], {"a": 1, 2: "b", 1.5: {}}, 2**70, -(2**63), 2**2000]
    for number, value in enumerate(messages + values):
        write(f"python_message/{number}", marshal.dumps(value, 2))


def qml_message():
    png = b"\x89PNG\r\n\x1a\n"
    messages = [
        ("hello", [6, 12, 0]), ("lacks", "x"), ("loaded",), ("failed", "x"), ("window", 1, "x", True, 3, 2, False), ("gone", 1),
        ("picture", 1, 3, 2, png), ("event", "x", "{}"), ("said", "info", "x"), ("answer", 1, [1.5, "x", None]), ("refused", 1, "x"),
    ]
    for number, message in enumerate(messages):
        write(f"qml_message/{number}", marshal.dumps(message, 2))


def soft_text():
    rope = "radius=0.01 lineDensity=0.1 stretch=1e4 bend=0.01 twist=0.02 damping=0.001 straight=1 self=1 points=0,0,0;0.1,0,0;0.2,0,0.1"
    cloth = "radius=0.001 density=0.2 stretch=1000 bend=1e-5 poisson=0.3 flat=1 self=1 points=0,0,0;0.1,0,0;0.1,0.1,0;0,0.1,0 triangles=0,1,2;0,2,3"
    volume = cloth.replace("triangles=0,1,2;0,2,3", "young=1e5 pressure=10 triangles=0,2,1;0,1,3;1,2,3;0,3,2 tetrahedra=0,1,2,3").replace("0,0.1,0 ", "0,0,0.1 ")
    for name, lines in {"rope": [rope, "point=0 place=0,0,0 clamped=1", ""], "cloth": ["", "point=1 place=0.1,0,0", cloth], "volume": ["", "", volume]}.items():
        write(f"soft_text/{name}", "\n".join(lines).encode())


def view_request():
    text = (ROOT.parent / "crates" / "view" / "src" / "request" / "tests.rs").read_text()
    for number, request in enumerate(re.findall(r"\{\\?\"[^`\n]*?\}", text)):
        write(f"view_request/{number}", request.replace('\\"', '"').encode())


def mcp_message():
    methods = {
        "initialize": {"protocolVersion": "2025-06-18"}, "ping": {}, "tools/list": {}, "tools/call": {"name": "echo", "arguments": {"a": [1]}},
        "resources/list": {"cursor": "100"}, "resources/templates/list": {}, "resources/read": {"uri": "a://1"},
    }
    requests = [{"jsonrpc": "2.0", "id": number, "method": method, "params": params} for number, (method, params) in enumerate(methods.items())]
    for number, message in enumerate([*requests, requests, {"jsonrpc": "2.0", "method": "notifications/initialized"}]):
        write(f"mcp_message/{number}", json.dumps(message).encode())


def compressed_image():
    def part(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    for name, depth, colour, row in (("grey", 8, 0, b"\0\x80"), ("rgb", 8, 2, b"\0abc"), ("rgba16", 16, 6, bytes(9)), ("palette", 1, 3, b"\0\0")):
        palette = part(b"PLTE", b"abcdef") if colour == 3 else b""
        head = part(b"IHDR", struct.pack(">IIBBBBB", 1, 1, depth, colour, 0, 0, 0))
        write(f"compressed_image/{name}.png", b"\x89PNG\r\n\x1a\n" + head + palette + part(b"IDAT", zlib.compress(row)) + part(b"IEND", b""))
    # 8 x 8 pixels of one grey.
    jpeg = (
        "/9j/2wBDAP//////////////////////////////////////////////////////////////////////////////////////wAALCAAIAAgBAREA/8QAFAABAAAAAAAAAA"
        "AAAAAAAAAAAv/EABQQAQAAAAAAAAAAAAAAAAAAAAD/2gAIAQEAAD8AT//Z"
    )
    write("compressed_image/grey.jpg", base64.b64decode(jpeg))


TARGETS = [compressed_image, scene_file, unpacked_scene, meshes, robots, ros, rtps, python_message, qml_message, soft_text, view_request, mcp_message]
for make in TARGETS:
    if not sys.argv[1:] or make.__name__ in sys.argv[1:]:
        make()

"""Seeds for the fuzz targets scene_file, unpacked_scene and mesh_*.

Of scene_file: the scenes of tests/data, as they are and uncompressed. What is changed in compressed data changes all that follows; only
uncompressed files let single changes reach the chunks.

Of unpacked_scene: the files of a model of tests/data, which is unpacked into fuzz/unpacked.

Of mesh_*: a square in each format.
"""

import pathlib
import struct
import subprocess

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
        path = ROOT / "corpus" / f"mesh_{name}"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


scene_file()
unpacked_scene()
meshes()

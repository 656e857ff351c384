"""Seeds for the fuzz targets scene_file and unpacked_scene.

Of scene_file: the scenes of tests/data, as they are and uncompressed. What is changed in compressed data changes all that follows; only
uncompressed files let single changes reach the chunks.

Of unpacked_scene: the files of a model of tests/data, which is unpacked into fuzz/unpacked.
"""

import pathlib
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


scene_file()
unpacked_scene()

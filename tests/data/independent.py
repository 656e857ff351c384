"""What the independent reader finds in scene files, a line per object or script: `independent.py READER_FOLDER FILE...`."""

import re
import sys

sys.path.insert(0, sys.argv[1])
import parse_ttt  # noqa: E402


def clean(name):
    return re.sub(r"[^A-Za-z0-9_]", "_", name.split("#")[0]) or "_"


def line(*fields):
    print("\t".join("" if field is None else str(field) for field in fields))


for path in sys.argv[2:]:
    _, _, tree, found = parse_ttt.parse_file(path)
    line("file", path)
    places = {entry["handle"]: place for place, entry in enumerate(found["objects"])}
    for entry in found["objects"]:
        # The pose is x y z qx qy qz qw; the mass of a compound is that of its root.
        fields = [entry["kind"], clean(entry["alias"]), places.get(entry["parent"], -1), *entry["pose"]]
        line("object", *fields, entry.get("mass"))
    for place, entry in enumerate(tree.get("object", [])):
        for blob in ("blob3", "blob2", "blob1"):
            if blob in entry:
                line("cells", place, entry[blob].get("voxels", entry[blob].get("points")))
                break
    line("textures", len(tree.get("texture", [])))
    for script in found["scripts"]:
        if script["type"] == "main" and script["defaultMain"]:
            continue
        line("script", script["type"], places.get(script["objectHandle"], -1), script["disabled"])

"""Simulators in notebooks: a picture with a table, and the viewer."""

from __future__ import annotations

import base64
import html
import struct
import zlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._simulator import Simulator

ROWS = 30  # of the table of objects


def png(width: int, height: int, rows: bytes) -> bytes:
    """A picture of three bytes for each point as a PNG file."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    size = 3 * width
    lines = b"".join(b"\0" + rows[at : at + size] for at in range(0, len(rows), size))
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b"")


def simulator_html(simulator: Simulator) -> str:
    """A picture of the scene, and its objects with their positions."""
    sim = simulator.require("sim")
    picture = base64.b64encode(png(*simulator._picture(None, [320, 240]))).decode()
    objects = simulator.objects()
    cells = []
    for handle, path, _ in objects[:ROWS]:
        position = ", ".join(f"{number:.3f}" for number in sim.getObjectPosition(handle))
        cells.append(f"<tr><td>{handle}</td><td>{html.escape(path)}</td><td>{position}</td></tr>")
    more = f"<p>and {len(objects) - ROWS} more objects</p>" if len(objects) > ROWS else ""
    return (
        f"<div><p>{html.escape(repr(simulator))}</p>"
        f'<img alt="the scene" width="320" height="240" src="data:image/png;base64,{picture}">'
        f"<table><tr><th>handle</th><th>object</th><th>position</th></tr>{''.join(cells)}</table>{more}</div>"
    )


class View:
    """The viewer's page. In a notebook it is shown in place; elsewhere `url` opens it."""

    def __init__(self, url: str, height: int) -> None:
        self.url, self._height = url, height

    def _repr_html_(self) -> str:
        return f'<iframe src="{html.escape(self.url)}" width="100%" height="{int(self._height)}"></iframe>'

    def __repr__(self) -> str:
        return self.url

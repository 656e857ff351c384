"""Compressed images of simROS2 and CycloneDDS, in both directions: JPEG, PNG, files that are damaged or claim to be huge."""

import io
import struct
import zlib

from PIL import Image
from ros2_types import make, message, reader, samples, until, writer
from simulator import Simulator

COMPRESSED, RAW, STRING = (message(name) for name in ("sensor_msgs/msg/CompressedImage", "sensor_msgs/msg/Image", "std_msgs/msg/String"))
SIZE = 64, 48


def file_of(kind, colour=(250, 10, 20), size=(8, 6), mode="RGB"):
    file = io.BytesIO()
    picture = Image.new("RGB", size, (0, 0, 0))
    # The left pixel of the highest row is the last row's first in the simulator; all of that row are alike, so its last one is too.
    picture.paste(colour, (0, 0, size[0], size[1] // 2))
    (picture.quantize(2) if mode == "P" else picture.convert(mode)).save(file, kind)
    return file.getvalue()


def check(image, kind, tolerance):
    """What the scene says it publishes: red grows to the right, green upwards."""
    assert image.format == f"rgb8; {kind} compressed bgr8" and image.header.frame_id == "lens", (image.format, image.header)
    picture = Image.open(io.BytesIO(bytes(image.data)))
    assert picture.format == kind.upper() and picture.size == SIZE, picture
    for x in range(SIZE[0]):
        for y in range(SIZE[1]):
            pixel, expected = picture.getpixel((x, y)), (x * 4, (SIZE[1] - 1 - y) * 5, 30)
            assert all(abs(a - b) <= tolerance for a, b in zip(pixel, expected)), (x, y, pixel, expected)


def published():
    images, change = reader("rt/front/camera/compressed", COMPRESSED), writer("rt/format", STRING)
    check(until("a JPEG image", lambda: samples(images))[-1], "jpeg", 12)
    until("a reader of formats", change.get_matched_subscriptions)

    def in_png():
        change.write(STRING("png"))
        return [image for image in samples(images) if "png" in image.format]

    check(until("a PNG image", in_png)[-1], "png", 0)
    raw = until("an image that is not compressed", lambda: samples(reader_of_raw))[-1]
    assert (raw.width, raw.height, len(raw.data)) == (*SIZE, 3 * SIZE[0] * SIZE[1])


def received(simulator):
    pictures = writer("rt/picture/compressed", COMPRESSED)
    until("a reader of pictures", pictures.get_matched_subscriptions)

    def seen(format, file):
        pictures.write(make(COMPRESSED, format=format, data=list(file)))
        return [int(word) for word in simulator.printed("picture ").split()]

    for format, file, tolerance in (
        ("rgb8; jpeg compressed bgr8", file_of("JPEG"), 12), ("jpeg", file_of("JPEG"), 12), ("bgr8; png compressed bgr8", file_of("PNG"), 0),
        ("png", file_of("PNG", mode="RGBA"), 0), ("png", file_of("PNG", mode="P"), 0),
    ):  # fmt: skip
        length, width, height, *pixel = seen(format, file)
        assert (length, width, height) == (144, 8, 6), (format, length, width, height)
        assert all(abs(a - b) <= tolerance for a, b in zip(pixel, (250, 10, 20))), (format, pixel)
    grey = seen("mono8; jpeg compressed mono8", file_of("JPEG", (200, 200, 200), mode="L"))
    assert grey[:3] == [144, 8, 6] and all(abs(level - 200) <= 2 for level in grey[3:]), grey
    for file in damaged():
        pictures.write(make(COMPRESSED, format="png", data=list(file)))
    simulator.logged("was left out")
    assert seen("png", file_of("PNG"))[3:] == [250, 10, 20], "a picture after damaged ones"


def damaged():
    """Files that are cut, changed, of another kind, or say that they are huge."""
    png, jpeg = file_of("PNG"), file_of("JPEG")
    head = b"IHDR" + struct.pack(">IIBBBBB", 16384, 16384, 8, 2, 0, 0, 0)
    huge = png[:12] + head + struct.pack(">I", zlib.crc32(head)) + png[33:]
    changed = bytearray(jpeg)
    changed[2:40] = b"\xff" * 38
    return b"", b"\x89PNG\r\n\x1a\n", png[: len(png) // 2], jpeg[:40], bytes(changed), huge, file_of("GIF"), file_of("BMP")


reader_of_raw = reader("rt/front/camera", RAW)
with Simulator("tests/interop/ros2_images_scene.lua", "--empty", "--realtime", command="run") as simulator:
    simulator.printed("ready")
    published()
    received(simulator)

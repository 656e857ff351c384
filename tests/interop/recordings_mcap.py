"""An MCAP file with the readers of MCAP and with Foxglove's own messages."""

import collections
import tempfile

from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

import recordings
from compare import same

BALL = "/Ball"


def messages(path):
    """All messages by topic: the log time in seconds, the bytes, and what the schema in the file makes of them."""
    found = collections.defaultdict(list)
    with open(path, "rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        decoded = reader.iter_decoded_messages()
        for schema, channel, message, content in decoded:
            found[channel.topic].append((schema.name, message.log_time / 1e9, message.data, content))
    return found


def transforms(found):
    name, time, data, content = found[-1]
    same("the schema", name, "foxglove.FrameTransforms")
    own = FrameTransforms.FromString(data)
    same("the frames", [t.child_frame_id for t in own.transforms], [t.child_frame_id for t in content.transforms])
    ball = next(t for _, _, data, _ in found[:1] for t in FrameTransforms.FromString(data).transforms if t.child_frame_id.startswith(BALL))
    same("the parent", ball.parent_frame_id, "world")
    last = next(t for t in own.transforms if t.child_frame_id.startswith(BALL))
    same("the place", (abs(last.translation.x - time) < 0.11, abs(last.translation.z - 0.5) < 1e-6), (True, True))
    same("the time", abs(last.timestamp.ToNanoseconds() / 1e9 - time) < 1e-6, True)


def scene(found):
    name, _, data, content = found[0]
    same("the schema", name, "foxglove.SceneUpdate")
    own = SceneUpdate.FromString(data)
    same("the entities", [e.id for e in own.entities], [e.id for e in content.entities])
    ball = next(entity for entity in own.entities if entity.id.startswith(BALL))
    triangles = ball.triangles[0]
    same("the frame", (ball.frame_id, ball.frame_locked), (ball.id, True))
    same("the triangles", (len(triangles.indices) % 3, max(triangles.indices) < len(triangles.points)), (0, True))
    same("the size", max(point.x for point in triangles.points) < 0.1001, True)
    same("the colour", triangles.color.a, 1.0)


def joints(found):
    name, time, _, content = found[-1]
    same("the schema", name, "foxglove.JointStates")
    same("the joint", content.joints[0].name.startswith("/Arm"), True)
    same("its position", abs(content.joints[0].position - time) < 0.11, True)


def log(found):
    lines = [Log.FromString(data) for _, _, data, _ in found]
    same("the schema", found[0][0], "foxglove.Log")
    same("the error", [line.level for line in lines if "oh" in line.message], [Log.Level.ERROR])
    same("the prints", any(line.message.startswith("at") for line in lines), True)


def images(found):
    same("the schema", found[0][0], "foxglove.RawImage")
    own = [RawImage.FromString(data) for _, _, data, _ in found]
    same("the size", {(i.width, i.height, i.step, i.encoding, len(i.data)) for i in own}, {(6, 4, 18, "rgb8", 72)})
    same("the frame", own[0].frame_id.startswith("/Eye"), True)
    same("several pictures", len({bytes(i.data) for i in own}) > 3, True)
    same("the times", [abs(i.timestamp.ToNanoseconds() / 1e9 - time) < 1e-6 for i, (_, time, _, _) in zip(own, found)], [True] * len(own))


with tempfile.TemporaryDirectory() as folder:
    found = messages(recordings.exported(folder, "--mcap", "a.mcap"))
    eye = next(topic for topic in found if "/Eye" in topic)
    same("the topics", sorted(found), sorted(["/joint_states", "/log", "/scene", "/tf", eye]))
    transforms(found["/tf"])
    scene(found["/scene"])
    joints(found["/joint_states"])
    log(found["/log"])
    images(found[eye])

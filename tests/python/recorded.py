"""What `swanilda export` reads in a recording: times, frames and texts of the log, by the reader of MCAP files."""

import os
import subprocess

import pytest

needs_command = pytest.mark.skipif("SWANILDA_BIN" not in os.environ, reason="the command is not known")


def exported(path):
    """The times of poses in seconds, the names of frames, and what was logged."""
    reader, decoder = pytest.importorskip("mcap.reader"), pytest.importorskip("mcap_protobuf.decoder")
    file = path.with_suffix(".mcap")
    subprocess.run([os.environ["SWANILDA_BIN"], "export", path, "--mcap", file], check=True, timeout=60)
    times, frames, texts = set(), set(), []
    with open(file, "rb") as opened:
        for _, channel, message, content in reader.make_reader(opened, decoder_factories=[decoder.DecoderFactory()]).iter_decoded_messages():
            if channel.topic == "/tf":
                times.add(round(message.log_time / 1e9, 6))
                frames |= {transform.child_frame_id for transform in content.transforms}
            if channel.topic == "/log":
                texts.append(content.message)
    return sorted(times), frames, texts

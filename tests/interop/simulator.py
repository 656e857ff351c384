"""The program under test with its output, for files that start it themselves."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading

ROOT = pathlib.Path(__file__).parents[2]
LIMIT = 10  # seconds for anything


REPLAY_LIMIT = 60  # seconds for a replay: it has no pauses, but much may have happened


class Simulator:
    """With statement; at its end the run is replayed, which has to be the same without the program that was tried with it."""

    def __init__(self, *args, command="serve", replayed=True):
        self.folder = tempfile.TemporaryDirectory()
        self.capture = os.path.join(self.folder.name, "run.swc")
        is_played = any(str(arg).endswith(".swc") for arg in args)
        captures = replayed and command in ("run", "serve", "view") and "--capture" not in args and not is_played
        captured = ["--capture", self.capture] if captures else []
        line = [sys.argv[1], command, "--json", *captured, *args]
        self.process = subprocess.Popen(line, stdout=subprocess.PIPE, stdin=subprocess.DEVNULL, cwd=ROOT)
        self.lines = []
        self.more = threading.Condition()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.process.stdout:
            with self.more:
                self.lines.append(json.loads(line))
                self.more.notify_all()

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        self.process.send_signal(signal.SIGTERM)
        try:
            self.process.wait(2)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        with self.folder:
            if kind is None and os.path.exists(self.capture):
                self._replay()

    def _replay(self):
        line = [sys.argv[1], "replay", self.capture, "--quiet"]
        environment = {"TZ": "Asia/Tokyo", "LC_ALL": "de_DE.UTF-8", "HOME": "/nowhere"}
        replay = subprocess.run(line, cwd="/", env=environment, capture_output=True, timeout=REPLAY_LIMIT)
        if replay.returncode != 0:
            sys.exit(f"the replay: {replay.stderr.decode(errors='replace')[-2000:]}")

    def line(self, matches, what):
        """The first line of output that matches; taken out, so that it is found once."""
        with self.more:
            found = []
            if not self.more.wait_for(lambda: found.extend(self._take(matches)) or found, LIMIT):
                sys.exit(f"{what}: not in the output: {self.lines[-5:]}")
            return found[0]

    def _take(self, matches):
        for i, line in enumerate(self.lines):
            if matches(line):
                return [self.lines.pop(i)]
        return []

    def port(self, api):
        return self.line(lambda line: line["type"] == "listening" and line["api"] == api, api)["port"]

    def printed(self, start):
        """What a printed line says behind its beginning."""
        line = self.line(lambda line: line["type"] == "print" and line["text"].startswith(start), start)
        return line["text"][len(start) :]

    def logged(self, part):
        return self.line(lambda line: line["type"] == "log" and part in line["text"], part)["text"]

    def sockets(self):
        """How many file descriptors the program has."""
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))

    def end(self):
        """Sends SIGTERM; returns the exit code."""
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(LIMIT)

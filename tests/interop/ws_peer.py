"""A simulator that runs `ws_scene.lua`, and what tests of WebSockets have in common."""

import pathlib
import time

from websockets.sync.client import connect

from compare import same
from simulator import LIMIT, Simulator

SCENE = pathlib.Path(__file__).parent / "ws_scene.lua"


class Control:
    """Runs Lua code in the scene; gives the text of its result, `error: ...` when there is none."""

    def __enter__(self):
        self.sim = Simulator(str(SCENE), "--no-remote-api")
        port = self.sim.printed("control ")
        self.client = connect(f"ws://127.0.0.1:{port}", max_size=None)
        return self

    def __exit__(self, *reason):
        self.sim.__exit__(*reason)

    def __call__(self, code):
        self.client.send(code)
        return self.client.recv(LIMIT)

    def server(self, code):
        """A new server `S`, after some code; tells its port."""
        self(f"if S then pcall(simWS.stop, S) end calls = {{}} S = simWS.start(0) {code}")
        return self("return simWS.getPort(S)")


def eventually(get, expected):
    """Waits until that is so."""
    deadline = time.monotonic() + LIMIT
    while (actual := get()) != expected and time.monotonic() < deadline:
        time.sleep(0.01)
    same("in the end", actual, expected)

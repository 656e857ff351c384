"""The pages of the examples in a headless Chromium."""

import contextlib
import functools
import http.server
import pathlib
import sys
import threading

from browser import Browser, program
from compare import same
from simulator import Simulator

ROOT = pathlib.Path(__file__).parents[2]
TEXT = "document.getElementById('{}').textContent"


class Files(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        """Says nothing: what a file here prints is an error."""


@contextlib.contextmanager
def served(folder):
    """The address at which the files of a folder are served."""
    handler = functools.partial(Files, directory=folder)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


def remote_page(browser):
    """remote.html: objects, start and stop, a pose read and set."""
    with Simulator("--no-remote-api", "--ws-remote-api=0") as sim, served(ROOT / "examples/web") as address:
        browser.open(f"{address}/remote.html?port={sim.port('WebSocket')}")
        options = "[...document.getElementById('objects').options].map(option => option.text).join()"
        names = browser.shows(options, "the list of objects")
        same("the list", "/Floor (" in names, True)
        browser.evaluate("document.getElementById('start').click()")
        browser.shows(TEXT.format("state") + ".startsWith('running')", "the start")
        browser.evaluate("document.getElementById('stop').click()")
        browser.shows(TEXT.format("state") + " == 'stopped'", "the end")
        browser.evaluate(
            "objects.value = [...objects.options].find(option => option.text.startsWith('/Floor ')).value; objects.onchange()"
        )
        browser.shows("document.getElementById('qw').value == '1'", "a pose")
        browser.evaluate("x.value = 1.25; document.getElementById('set').onclick()")
        browser.evaluate("x.value = 0; document.getElementById('read').onclick()")
        browser.shows("x.value == '1.25'", "the pose that was set")
        same("errors", browser.evaluate(TEXT.format("error")), "")


def broadcast_page(browser):
    """The page of ws_broadcast.lua: a robot that moves."""
    with Simulator("scenes/ws_broadcast.lua", "--realtime", "-D", "port=0", command="run") as sim:
        browser.open("http" + sim.printed("http"))
        browser.shows("typeof trail == 'object' && trail.length > 10", "a trail")
        length = "Math.hypot(trail.at(-1)[0] - trail[0][0], trail.at(-1)[1] - trail[0][1])"
        same("it moves", browser.evaluate(length) > 0.05, True)
        same("what it says", browser.evaluate(TEXT.format("state")).startswith("t = "), True)
        # The canvas is not empty.
        drawn = "map.getImageData(0, 0, 600, 400).data.some(byte => byte != 0)"
        same("a picture", browser.evaluate(drawn), True)


def main():
    with Browser(program() or sys.exit("there is no Chromium")) as browser:
        remote_page(browser)
        broadcast_page(browser)


main()

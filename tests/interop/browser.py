"""A headless Chromium, spoken to by its DevTools protocol."""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request

from websockets.sync.client import connect

LIMIT = 60  # seconds for anything: browsers are slow
OPTIONS = """--headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking
--disable-component-update --disable-sync --disable-dev-shm-usage --remote-debugging-port=0""".split()

# Pages that draw with WebGL: the graphics processor is computed.
WITH_WEBGL = [option for option in OPTIONS if option != "--disable-gpu"] + [
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
]


class Browser:
    def __init__(self, program, options=OPTIONS):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.process = subprocess.Popen(
            [program, *options, f"--user-data-dir={self.folder.name}", "about:blank"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.count = 0
        self.events = []  # what the page did, as far as its domains are enabled
        self.socket = connect(self._page(), max_size=None)

    def _page(self):
        """The address of the one page there is."""
        told = pathlib.Path(self.folder.name, "DevToolsActivePort")
        port = self.until(lambda: told.exists() and told.read_text().split("\n")[0], "the browser")
        pages = json.load(urllib.request.urlopen(f"http://127.0.0.1:{port}/json/list", None, LIMIT))
        return next(page["webSocketDebuggerUrl"] for page in pages if page["type"] == "page")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.folder.cleanup()

    def command(self, method, **params):
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": params}))
        while (reply := json.loads(self.socket.recv(LIMIT))).get("id") != self.count:
            self.events.append(reply)
        return reply.get("result", {})

    def open(self, url):
        self.command("Page.navigate", url=url)

    def evaluate(self, expression):
        """The value of JavaScript; None when it has none yet."""
        result = self.command("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        return result.get("result", {}).get("value")

    def until(self, get, what):
        deadline = time.monotonic() + LIMIT
        while time.monotonic() < deadline:
            if value := get():
                return value
            time.sleep(0.05)
        sys.exit(f"{what}: not in time")

    def shows(self, expression, what):
        return self.until(lambda: self.evaluate(expression), what)


def program():
    """Where Chromium is."""
    return next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)

"""Servers on threads for the tests of sockets, and the Lua files that talk to them."""

import socket
import subprocess
import sys
import threading
from pathlib import Path


def listen(handle):
    """Serves each connection by `handle(connection)` on a thread of its own; returns the port."""
    listener = socket.create_server(('127.0.0.1', 0))

    def serve_one(connection):
        with connection:
            try:
                handle(connection)
            except OSError:
                pass  # The other side has gone: that is what some tests are about.

    def serve():
        while True:
            connection, _ = listener.accept()
            threading.Thread(target=serve_one, args=(connection,), daemon=True).start()

    threading.Thread(target=serve, daemon=True).start()
    return listener.getsockname()[1]


def free_port():
    """A port nobody listens at."""
    with socket.create_server(('127.0.0.1', 0)) as listener:
        return listener.getsockname()[1]


def run(lua, **params):
    """Runs a Lua file, which says nothing when all is well."""
    file = Path(__file__).with_name(lua)
    command = [sys.argv[1], 'run', str(file), '--as', 'sandbox', '--empty', '--quiet', '--no-start', '--loops', '0']
    for name, value in params.items():
        command += ['-D', f'{name}={value}']
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60)
    said = done.stdout.decode(errors='replace')
    if said or done.returncode:
        sys.exit(f'{lua}: {done.returncode}\n{said}')

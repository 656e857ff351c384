"""A client that holds up the simulation does not hold up the end of the program."""

import os
import signal
import socket
import sys
import time

from raw import PORT, Peer

client = Peer("holder")
client.call("sim.setStepping", True)
client.call("sim.startSimulation")
time.sleep(0.2)
os.kill(int(sys.argv[2]), signal.SIGTERM)
deadline = time.monotonic() + 10
while time.monotonic() < deadline:
    try:
        socket.create_connection(("127.0.0.1", PORT), 1).close()
    except OSError:
        sys.exit()
    time.sleep(0.05)
sys.exit("the server is still there")

"""Many pages of the viewer for ten minutes: does the memory of the simulator stay, and is the simulation as fast as without them?

    python3 benches/view_soak.py target/release/swanilda [SECONDS [PAGES]]     # needs websockets

The scene has a hundred moving shapes and a script that prints, draws and creates objects. Of the pages most read all they are sent, one in ten reads
nothing, one in ten leaves and comes back all the time, often in the middle of a message. Each line has the seconds that have passed, the
steps a second of wall clock, the messages all pages read in a second, and the resident memory of the simulator (MB).
"""

import asyncio
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import time

import websockets

SCENE = """
sim = require 'sim'
function sysCall_init()
    shapes = {}
    for i = 1, 100 do shapes[i] = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}) end
    lines = sim.addDrawingObject(sim.drawing_lines | sim.drawing_cyclic, 2, 0, -1, 100, {1, 0, 0})
end
function sysCall_actuation()
    local t = sim.getSimulationTime()
    for i, shape in ipairs(shapes) do sim.setObjectPosition(shape, {i % 10, i // 10, math.sin(t + i)}) end
    sim.addDrawingObjectItem(lines, {0, 0, 0, math.cos(t), math.sin(t), 1})
    print(t)
    if last then sim.removeObjects({last}) end
    last = sim.createDummy(0.01)
end
"""


class Counts:
    messages = 0
    steps = 0


async def page(url, kind, counts):
    while True:
        try:
            async with websockets.connect(url, max_size=None, compression=None) as socket:
                if kind == 'sleeps':
                    await asyncio.sleep(1e9)
                left = random.randrange(1, 200) if kind == 'leaves' else 1 << 60
                async for message in socket:
                    counts.messages += 1
                    if kind == 'counts' and isinstance(message, str):
                        counts.steps = json.loads(message).get('scene', {}).get('steps', counts.steps)
                    left -= 1
                    if left == 0:
                        socket.transport.abort()
                        break
        except (OSError, websockets.WebSocketException):
            await asyncio.sleep(0.1)


def memory(process):
    status = pathlib.Path(f'/proc/{process.pid}/status').read_text()
    return next(int(line.split()[1]) / 1024 for line in status.splitlines() if line.startswith('VmRSS'))


async def soak(process, url, seconds, pages):
    counts = Counts()
    kinds = ['counts'] + [['sleeps', 'leaves'][i % 2] if i % 5 == 0 else 'reads' for i in range(pages - 1)]
    tasks = [asyncio.create_task(page(url, kind, counts)) for kind in kinds]
    begun = time.monotonic()
    while (passed := time.monotonic() - begun) < seconds:
        before, steps, at = counts.messages, counts.steps, time.monotonic()
        await asyncio.sleep(min(10, seconds / 5))
        took = time.monotonic() - at
        print(f'{time.monotonic() - begun:6.0f} s {(counts.steps - steps) / took:9.0f} steps/s '
              f'{(counts.messages - before) / took:7.0f} messages/s {memory(process):7.1f} MB', flush=True)
    for task in tasks:
        task.cancel()


def main():
    program, seconds, pages = sys.argv[1], float((sys.argv[2:] + [600])[0]), int((sys.argv[3:] + [100])[0])
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / 'scene.lua'
        scene.write_text(SCENE)
        command = [program, 'view', str(scene), '--no-open', '--speed=0']
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
            url = next(line for line in process.stdout if line.startswith('Viewer at ')).split()[-1]
            # Prints of the script fill the pipe otherwise.
            drain = subprocess.Popen(['cat'], stdin=process.stdout, stdout=subprocess.DEVNULL)
            try:
                asyncio.run(soak(process, url.replace('http', 'ws') + 'stream', seconds, pages))
            finally:
                process.kill()
                drain.kill()


main()

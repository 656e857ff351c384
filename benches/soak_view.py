"""Pages that come, read, read slowly, ask and go, for as long as wanted, and the memory of the simulator meanwhile.

    python3 benches/soak_view.py target/release/swanilda [SECONDS] [PAGES]

Needs `websockets`. Prints the resident memory every half minute, and at the end how many messages were read."""

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
simUI = require 'simUI'
function pressed(ui, id) simUI.setLabelText(ui, 2, tostring(sim.getSimulationTime())) end
function sysCall_init()
    shapes = {}
    for i = 1, 100 do shapes[i] = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}) end
    lines = sim.addDrawingObject(sim.drawing_lines, 2, 0, -1, 100, {1, 0, 0})
    sim.createVisionSensor(2, {64, 48, 0, 0}, {0.01, 5, 1, 0.05, 0, 0, 0, 0, 0, 0, 0})
    simUI.create('<ui title="Panel"><button id="1" text="Press" on-click="pressed"/><label id="2"/></ui>')
end
function sysCall_actuation()
    local t = sim.getSimulationTime()
    for i, shape in ipairs(shapes) do sim.setObjectPosition(shape, {i % 10, i // 10, math.sin(t + i)}) end
    sim.addDrawingObjectItem(lines, {0, 0, 0, 1, 1, t})
    if math.floor(t * 20) % 20 == 0 then
        print('time', t)
        local dummy = sim.createDummy(0.01)
        sim.removeObjects({dummy})
    end
end
"""


def memory(process):
    """Resident, MB."""
    line = next(line for line in open(f"/proc/{process.pid}/status") if line.startswith("VmRSS"))
    return int(line.split()[1]) / 1024


async def page(url, until, counts, number):
    """Sessions of a page: it reads, some of them slowly, watches, asks, presses a button, and goes in the middle."""
    random_of_page = random.Random(number)
    while time.monotonic() < until:
        async with websockets.connect(url, max_size=None, ping_interval=None) as socket:
            counts["sessions"] += 1
            end = min(time.monotonic() + random_of_page.uniform(5, 60), until)
            slow = random_of_page.random() < 0.2
            ask = 0
            while time.monotonic() < end:
                try:
                    await asyncio.wait_for(socket.recv(), 1)
                    counts["messages"] += 1
                except TimeoutError:
                    pass
                if random_of_page.random() < 0.02:
                    ask += 1
                    request = random_of_page.choice([{"do": "inspect", "handle": 20}, {"do": "watch", "handles": [120]}, {"do": "select", "handles": [20]},
                                                     {"do": "ui", "window": "1:UI", "widget": 1, "input": {"type": "click"}}, {"do": "show", "contacts": True}])
                    await socket.send(json.dumps({"id": ask, **request}))
                if slow:
                    await asyncio.sleep(0.5)


async def main(program, seconds, pages):
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder, "scene.lua")
        scene.write_text(SCENE)
        process = subprocess.Popen([program, "view", "--json", "--no-open", scene], stdout=subprocess.PIPE)
        try:
            address = next(json.loads(line)["url"] for line in process.stdout if b'"viewing"' in line)
            asyncio.get_running_loop().run_in_executor(None, lambda: [None for _ in process.stdout])
            url = address.replace("http:", "ws:") + "stream"
            begun, counts = time.monotonic(), {"sessions": 0, "messages": 0}
            tasks = [asyncio.create_task(page(url, begun + seconds, counts, number)) for number in range(pages)]
            while time.monotonic() < begun + seconds:
                await asyncio.sleep(min(30, seconds))
                print(f"{time.monotonic() - begun:5.0f} s: {memory(process):6.1f} MB, {counts}", flush=True)
            await asyncio.gather(*tasks)
            await asyncio.sleep(5)
            print(f"without pages: {memory(process):6.1f} MB, {counts}")
        finally:
            process.kill()


arguments = sys.argv[2:] + ["600", "100"][len(sys.argv) - 2 :]
asyncio.run(main(sys.argv[1], float(arguments[0]), int(arguments[1])))

# Calls per second of a script in Python, to compare with the official client (remote.py):
#
#     swanilda run benches/python_script.py --quiet
#     swanilda run benches/python_script.py --quiet -D empty=1 --steps 10000     # steps of callbacks that do nothing
import time

CALLS = 20_000


def sysCall_init():
    global sim
    sim = require('sim')
    self.begun, self.steps = 0.0, 0
    if sim.getNamedStringParam('empty') is None:
        measure()
        sim.quitSimulator()


def measure():
    floor = sim.getObject('/Floor')
    durations = []
    begun = time.perf_counter()
    for _ in range(CALLS):
        start = time.perf_counter()
        sim.getObjectPosition(floor)
        durations.append(time.perf_counter() - start)
    rate = CALLS / (time.perf_counter() - begun)
    durations.sort()
    median, p99 = (durations[CALLS * percent // 100] * 1e6 for percent in (50, 99))
    print(f'{rate:.0f}/s, median {median:.0f} us, p99 {p99:.0f} us')


def sysCall_beforeSimulation():
    self.begun = time.perf_counter()


def sysCall_actuation():
    self.steps += 1


def sysCall_sensing():
    pass


def sysCall_afterSimulation():
    print(f'{self.steps / (time.perf_counter() - self.begun):.0f} steps/s')

"""What calls and steps of the Python package cost, in microseconds: the best and the median of many rounds.

    python3 -m pip install . && python3 benches/python_package.py

`s.steps` is about what an empty call of the extension costs.
"""

import statistics
import time

import swanilda


def measure(name, count, work):
    times = []
    for _ in range(40):
        begun = time.perf_counter()
        work(count)
        times.append((time.perf_counter() - begun) / count * 1e6)
    print(f"{name}: {min(times):.2f} us, median {statistics.median(times):.2f} us")


def main():
    with swanilda.Simulator(quiet=True) as s:
        sim = s.require("sim")
        floor = sim.getObject("/Floor")
        get_position = sim.getObjectPosition

        def positions(count):
            for _ in range(count):
                get_position(floor)

        def attributes(count):
            for _ in range(count):
                s.steps

        measure("sim.getObjectPosition", 5000, positions)
        measure("s.steps", 5000, attributes)
        s.start()
        measure("s.step(), default scene", 200, s.step)


if __name__ == "__main__":
    main()

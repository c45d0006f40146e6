"""How fast a program of one's own steps the knife line: CPU seconds of read + write + 1 ms, beside advance() alone.

    PYTHONPATH=build/python /usr/bin/python3 tests/python/bench_stepping.py
"""

import os
import time

import drycut

SCENE = os.path.join(os.path.dirname(__file__), "..", "..", "scenes", "rotary_knife.yaml")


def controlled(line):
    for _ in range(12000):
        line.read("AxisX.follerr")
        line.write("web.speed", 60)
        line.advance(0.001)


def alone(line):
    line.advance(12.0)


def cost(work):
    line = drycut.Simulation(SCENE)
    begin = time.process_time()
    work(line)
    return time.process_time() - begin


for name, work in (("read + write + 1 ms, 12 000 times", controlled), ("advance(12.0)", alone)):
    least = min(cost(work) for _ in range(10))  # what else ran on this core costs too: the least of ten
    print(f"{name:35} {least * 1000:6.1f} ms CPU, {12 / least:5.0f} times real time")

#!/usr/bin/env python3
"""A live line for as long as one likes, with clients on its wires, and then its session again.

endurance.py PROGRAM SCENE [--seconds 3600] [--page] [--modbus] [--opcua FOLDER]

Looked at: how many cycles came more than a millisecond late (at most one in a thousand), that machine time kept up with
the clock, that memory is flat, what the server takes beside the loop, and that `drycut replay` gives the same bytes, how
fast. Prints what it saw, and ends with 1 if one of them is not so.
"""
import argparse
import asyncio
import filecmp
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

import websockets


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=3600)
    parser.add_argument("--page", action="store_true", help="open the page in a headless Chromium")
    parser.add_argument("--modbus", action="store_true", help="poll and write by Modbus (pymodbus)")
    parser.add_argument("--opcua", type=pathlib.Path, help="subscribe by OPC UA with the packages in this folder")
    parser.add_argument("--out", type=pathlib.Path, help="keep the session and the replay here")
    return parser.parse_args()


def status_of(process):
    """Resident memory [MB], and CPU seconds of each thread by name."""
    status = pathlib.Path(f"/proc/{process}/status").read_text()
    memory = int(re.search(r"VmRSS:\s+(\d+)", status)[1]) / 1024
    tick = os.sysconf("SC_CLK_TCK")
    threads = {}
    for task in pathlib.Path(f"/proc/{process}/task").iterdir():
        try:
            text = (task / "stat").read_text()
        except FileNotFoundError:
            continue
        name, fields = text[text.index("(") + 1:text.rindex(")")], text[text.rindex(")") + 2:].split()
        threads[name] = threads.get(name, 0) + (int(fields[11]) + int(fields[12])) / tick
    return memory, threads


class Watcher:
    """Sees the news, and works the line now and then."""

    def __init__(self, url, process):
        self.url = url.replace("http:", "ws:") + "ws"
        self.process = process
        self.memory = []
        self.news = None

    async def run(self, seconds):
        async with websockets.connect(self.url, max_size=None) as socket:
            begun = None
            next_look = 0
            speeds = 0
            async for message in socket:
                told = json.loads(message)
                if "line" in told:
                    self.speed = next((t for t in told["line"]["targets"] if t["name"].endswith("web.speed")), None)
                if "news" not in told:
                    continue
                self.news = told["news"]
                now = time.monotonic()
                if begun is None:
                    begun = now, self.news["time"]
                passed = now - begun[0]
                if passed >= next_look:
                    next_look += max(1, seconds / 60)
                    memory, threads = status_of(self.process)
                    self.memory.append((passed, memory))
                    self.behind = passed - (self.news["time"] - begun[1])
                    late = self.news["late"]
                    print(f"{passed:7.0f} s: {late['late']} of {late['cycles']} late, worst {late['worst'] * 1e3:.2f} ms, "
                          f"behind {self.behind * 1e3:.1f} ms, {memory:.1f} MB, CPU s "
                          + ", ".join(f"{name} {spent:.1f}" for name, spent in threads.items()), flush=True)
                    if self.speed:
                        speeds += 1
                        unit = self.speed["unit"]
                        await socket.send(json.dumps({"act": {"ramp": {"web.speed": f"{0.5 + 0.1 * (speeds % 5)} m/s"}, "over": "2 s"}}))
                if passed >= seconds:
                    return


class ModbusClient(threading.Thread):
    """An HMI: reads 32 words ten times a second and writes the last of them back every second."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.port = port
        self.reads = self.writes = self.failures = 0
        self.going = True

    def run(self):
        from pymodbus.client import ModbusTcpClient
        client = ModbusTcpClient("127.0.0.1", port=self.port)
        client.connect()
        while self.going:
            answer = client.read_holding_registers(0, 32, slave=1)
            self.reads += 1
            if answer.isError():
                self.failures += 1
            elif self.reads % 10 == 0:
                self.writes += 1
                self.failures += client.write_register(31, answer.registers[31], slave=1).isError()
            time.sleep(0.1)
        client.close()


def flat(memory):
    """Memory of the last tenth is not above that of the second tenth by more than 2 %."""
    tenth = max(1, len(memory) // 10)
    before = max(m for _, m in memory[tenth:2 * tenth])
    after = max(m for _, m in memory[-tenth:])
    return after <= 1.02 * before, before, after


async def main():
    options = arguments()
    folder = options.out or pathlib.Path(tempfile.mkdtemp(prefix="drycut-endurance-"))
    folder.mkdir(parents=True, exist_ok=True)
    wires = (["--modbus", "0"] if options.modbus else []) + (["--opcua", "0"] if options.opcua else [])
    line = subprocess.Popen([options.program, "live", options.scene, "--port", "0", "--record", folder / "record", *wires],
                            stdout=subprocess.PIPE, text=True)
    said = line.stdout.readline()
    url = re.search(r"http://\S+", said)[0]
    clients = []
    if options.page:
        clients.append(subprocess.Popen(
            [shutil.which("chromium"), "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--window-size=1280,720",
             "--remote-debugging-port=0", f"--user-data-dir={folder / 'chromium'}", url],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True))
    modbus = opcua = None
    if options.modbus:
        modbus = ModbusClient(int(re.search(r"Modbus TCP: \S+ port (\d+)", line.stdout.readline())[1]))
        modbus.start()
    if options.opcua:
        address = None
        while not address:
            address = re.search(r"opc\.tcp://\S+", line.stdout.readline())
        opcua = subprocess.Popen(["node", pathlib.Path(__file__).parent / "opcua_client.mjs", address[0], str(options.seconds - 5)],
                                 env={**os.environ, "DRYCUT_OPCUA": str(options.opcua.resolve())})
    watcher = Watcher(url, line.pid)
    await watcher.run(options.seconds)
    failures = []
    if modbus:
        modbus.going = False
        modbus.join()
        print(f"Modbus: {modbus.reads} reads, {modbus.writes} writes, {modbus.failures} failures")
        if modbus.failures:
            failures.append("Modbus requests failed")
    if opcua and opcua.wait() != 0:
        failures.append("the client of OPC UA failed")
    for client in clients:
        os.killpg(client.pid, signal.SIGKILL)
    line.send_signal(signal.SIGINT)
    line.wait()

    late = watcher.news["late"]
    share = late["late"] / late["cycles"]
    print(f"late: {100 * share:.4f} % of {late['cycles']} cycles, worst {late['worst'] * 1e3:.2f} ms, not made good {late['dropped']} s")
    if share > 0.001:
        failures.append("more than 0.1 % of the cycles were late")
    if late["dropped"] > 0 or abs(watcher.behind) > 0.05:
        failures.append(f"machine time is {watcher.behind:.3f} s behind")
    even, before, after = flat(watcher.memory)
    print(f"memory: {before:.1f} MB, at the end {after:.1f} MB")
    if not even:
        failures.append("memory grows")
    sessions = sorted((folder / "record").iterdir(), key=lambda path: int(path.name))
    begun = time.monotonic()
    again = subprocess.run([options.program, "replay", sessions[0], "--no-pictures", "--out", folder / "again"],
                           stdout=subprocess.PIPE, text=True)
    took = time.monotonic() - begun
    print(f"replay: {watcher.news['time']:.0f} s of machine time in {took:.1f} s, {watcher.news['time'] / took:.0f} times as fast")
    for name in ("trace.csv", "events.csv"):
        if not filecmp.cmp(sessions[0] / name, folder / "again" / "session" / name, shallow=False):
            failures.append(f"{name} of the replay is another one")
    for failure in failures:
        print("FAIL", failure)
    if not options.out:
        shutil.rmtree(folder)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(asyncio.run(main()))

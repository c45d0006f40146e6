#!/usr/bin/env python3
"""A live line under those who do it harm, each on this machine and for a few seconds.

attack.py PROGRAM [--scenes scenes] [--seconds 5] [--only ATTACK,...] [--out FOLDER]

For each attack it is measured how many machine seconds a second the line makes while it is attacked and when the
attackers have gone, how long an operator waits for the answer to the emergency stop, how long the line takes to end
after Ctrl-C in the midst of it, and whether its last session replays to the same bytes. The bars: pace 0.99, emergency
stop 100 ms, Ctrl-C 1 s with status 130. Ends with 1 if one is missed: they are of an idle machine of two cores.
"""
import argparse
import base64
import filecmp
import json
import os
import pathlib
import re
import selectors
import shutil
import signal
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time

HOST = "127.0.0.1"
SAW, KNIFE = "flying_saw_lx3vp.yaml", "rotary_knife_mc_emergency.yaml"


class Socket:
    """A client of the line's WebSocket: as little of RFC 6455 as it needs."""

    def __init__(self, port):
        self.socket = socket.create_connection((HOST, port), timeout=60)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(f"GET /ws HTTP/1.1\r\nHost: {HOST}:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
        self.bytes = b""
        while b"\r\n\r\n" not in self.bytes:
            self.more()
        head, self.bytes = self.bytes.split(b"\r\n\r\n", 1)
        assert b" 101 " in head, head

    def more(self):
        got = self.socket.recv(1 << 16)
        if not got:
            raise ConnectionError("the line closed the connection")
        self.bytes += got

    @staticmethod
    def frame(text):
        data = text.encode()
        size = len(data)
        head = bytes([0x81]) + (bytes([0x80 | size]) if size < 126 else struct.pack(">BH", 0x80 | 126, size))
        return head + bytes(4) + data  # a mask of zeros

    def send(self, message):
        self.socket.sendall(self.frame(json.dumps(message)))

    def take(self, count):
        while len(self.bytes) < count:
            self.more()
        data, self.bytes = self.bytes[:count], self.bytes[count:]
        return data

    def message(self):
        text = b""
        while True:
            kind, size = self.take(2)
            if size == 126:
                size = struct.unpack(">H", self.take(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self.take(8))[0]
            data = self.take(size)
            if kind & 0x0F <= 1:  # text, or more of it
                text += data
                if kind & 0x80:
                    return json.loads(text)
            elif kind & 0x0F == 9:  # ping
                self.socket.sendall(bytes([0x8A, 0x80 | size]) + bytes(4) + data)


# The attackers, each in a process of its own until it is told to end.

def flood(port, texts, clients=4):
    """Sends these again and again and throws away what comes back."""
    sockets = [Socket(port).socket for _ in range(clients)]
    data = b"".join(Socket.frame(text) for text in texts)

    def listen(of):
        while of.recv(1 << 20):
            pass

    for one in sockets:
        threading.Thread(target=listen, args=(one,), daemon=True).start()
        threading.Thread(target=lambda of=one: [of.sendall(data) for _ in iter(int, 1)], daemon=True).start()
    while True:
        time.sleep(1)


def acts(port, _):
    flood(port, [json.dumps({"act": {"set": {"web.speed": f"{50 + i % 20} m/min"}}}) for i in range(100)])


def slips(port, _):
    flood(port, [json.dumps({"act": {"set": {f"no.such{i}.{k}": 1 for k in range(1000)}}}) for i in range(4)])


def restarts(port, _):
    flood(port, ['{"restart":true}'] * 1000, 1)


def steers(port, _):
    flood(port, ['{"run":true}', '{"advance":"1 ms"}', '{"pace":1}', '{"run":true}'] * 50, 4)


def looks(port, _):
    """Four clients that look back all over the run, at programs too, and at what it has not come to yet."""
    flood(port, [json.dumps({"look": f"{(i * 37) % 60 / 10} s", "programs": i % 2 == 0}) for i in range(100)])


def returns(port, _):
    """Goes on from the moments of the first second, again and again."""
    flood(port, [json.dumps({"go_on": f"{i % 10 / 10} s"}) for i in range(100)], 1)


def samples(port, _):
    """Sixty clients that want 250 channels each, and again and again other ones."""
    first = Socket(port)
    channels = [channel["name"] for channel in first.message()["line"]["channels"]]
    clients = [Socket(port).socket for _ in range(60)]
    drain = selectors.DefaultSelector()
    for one in clients:
        drain.register(one, selectors.EVENT_READ)
    begun, asked = time.monotonic(), 0
    while True:
        for key, _ in drain.select(0.01):
            key.fileobj.recv(1 << 20)
        if time.monotonic() - begun > 0.2 * asked:
            asked += 1
            for number, one in enumerate(clients):
                own = [channels[(7 * asked + 11 * number + i) % len(channels)] for i in range(min(250, len(channels)))]
                one.setblocking(True)
                one.sendall(Socket.frame(json.dumps({"sample": own})))
                one.setblocking(False)


def half_open(port, _):
    """Three hundred connections that begin a request and never end it, opened anew as they are closed."""
    held = []
    while True:
        held = [one for one in held if is_open(one)]
        while len(held) < 300:
            one = socket.create_connection((HOST, port))
            one.sendall(b"GET / HTTP/1.1\r\nHost: ")
            one.setblocking(False)
            held.append(one)
        time.sleep(0.05)


def is_open(one):
    try:
        return one.recv(1) != b""
    except BlockingIOError:
        return True
    except OSError:
        return False


def modbus(_, port):
    """Sixty masters that write 123 registers as fast as they are answered, other values each time."""
    def master(number):
        one = socket.create_connection((HOST, port))
        one.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        count = 0
        while True:
            count += 1
            values = [(number + count + i) & 0x7FFF for i in range(123)]
            pdu = struct.pack(">BHHB123H", 16, 1000, 123, 246, *values)
            one.sendall(struct.pack(">HHHB", count & 0xFFFF, 0, len(pdu) + 1, 1) + pdu)
            if not one.recv(260):
                return

    for number in range(60):
        threading.Thread(target=master, args=(number,), daemon=True).start()
    while True:
        time.sleep(1)


def nobody(_, __):
    while True:
        time.sleep(1)


# by name: who attacks, the scene, options of the line, whether machine time is to keep up with the clock meanwhile
ATTACKS = {
    "nobody": (nobody, KNIFE, [], True),
    "acts": (acts, KNIFE, [], True),
    "slips": (slips, KNIFE, [], True),
    "restarts": (restarts, KNIFE, [], False),
    "steers": (steers, KNIFE, [], False),
    "looks": (looks, KNIFE, [], True),
    "returns": (returns, KNIFE, [], False),
    "samples": (samples, KNIFE, [], True),
    "half_open": (half_open, KNIFE, [], True),
    "modbus": (modbus, SAW, [], True),
    "too_fast": (nobody, KNIFE, ["--pace", "10000"], False),
}


class Operator(threading.Thread):
    """Presses the emergency stop five times a second, each time on a page that is opened for it."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.port, self.going = port, True
        self.waits, self.opens, self.failures = [], [], []

    def run(self):
        on = False
        while self.going:
            try:
                begun = time.monotonic()
                page = Socket(self.port)
                targets = page.message()["line"]["targets"]
                self.opens.append(time.monotonic() - begun)
                switches = [target["name"] for target in targets if target["panel"]]
                stop = next((name for name in switches if "emergency" in name), switches[0])
                on = not on
                begun = time.monotonic()
                page.send({"id": 1, "act": {"set": {stop: int(on)}}})
                answer = page.message()
                while "done" not in answer:
                    answer = page.message()
                self.waits.append(time.monotonic() - begun)
                if answer["problems"]:
                    self.failures.append(answer["problems"][0]["what"])
                page.socket.close()
            except OSError as error:
                if self.going:
                    self.failures.append(str(error))
            time.sleep(0.2)


class Clock(threading.Thread):
    """What the line tells of its time."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.page = Socket(port)
        self.seen = []  # (here, machine time)

    def run(self):
        try:
            while True:
                message = self.page.message()
                if "news" in message:
                    self.seen.append((time.monotonic(), message["news"]["time"]))
        except OSError:
            pass

    def pace(self, begin, end):
        """By the news that were under way for the shortest time: what this program is late itself does not count."""
        part = (end - begin) / 5

        def behind(since):
            return min((here - there for here, there in self.seen if since <= here <= since + part), default=None)

        first, last = behind(begin), behind(end - part)
        return 0 if first is None or last is None else 1 - (last - first) / (end - begin - part)


def begin_attack(name, port, modbus_port):
    return subprocess.Popen([sys.executable, __file__, "--be", name, str(port), str(modbus_port)],
                            stderr=subprocess.DEVNULL)


def begin_line(options, folder, scene, words):
    line = subprocess.Popen([options.program, "live", options.scenes / scene, "--port", "0", "--record", folder, *words],
                            stdout=subprocess.PIPE, text=True)
    port = int(re.search(r":(\d+)/", line.stdout.readline())[1])
    modbus_port = int(re.search(r"port (\d+)", line.stdout.readline())[1]) if "--modbus" in words else 0
    threading.Thread(target=line.stdout.read, daemon=True).start()
    return line, port, modbus_port


def replays(options, session, out):
    begun = time.monotonic()
    subprocess.run([options.program, "replay", session, "--no-pictures", "--out", out], stdout=subprocess.DEVNULL)
    same = all(filecmp.cmp(session / name, out / "session" / name, shallow=False) for name in ("trace.csv", "events.csv"))
    return same, time.monotonic() - begun


def attack(options, name, folder):
    who, scene, words, keeps_up = ATTACKS[name]
    words = words + (["--modbus", "0"] if who is modbus else [])
    line, port, modbus_port = begin_line(options, folder / "record", scene, words)
    if name == "too_fast":
        os.sched_setaffinity(line.pid, {0})
        for task in os.listdir(f"/proc/{line.pid}/task"):
            os.sched_setaffinity(int(task), {0})
    clock, operator = Clock(port), Operator(port)
    clock.start()
    attackers = begin_attack(name, port, modbus_port)
    time.sleep(1)
    operator.start()
    begun = time.monotonic()
    time.sleep(options.seconds)
    attacked = time.monotonic()
    attackers.kill()
    time.sleep(0.5)
    after = time.monotonic()
    time.sleep(2)
    calm = time.monotonic()
    attackers = begin_attack(name, port, modbus_port)
    time.sleep(1)
    operator.going = False
    line.send_signal(signal.SIGINT)
    told = time.monotonic()
    status = line.wait(120)
    ended = time.monotonic() - told
    attackers.kill()
    sessions = sorted((folder / "record").iterdir(), key=lambda path: int(path.name))
    same, took = replays(options, sessions[-1], folder / "again")
    pace, pace_after = clock.pace(begun, attacked), clock.pace(after, calm)
    worst = max(operator.waits, default=float("inf"))
    failures = []
    if keeps_up and pace < 0.99:
        failures.append("pace")
    if name != "too_fast" and pace_after < 0.99:
        failures.append("pace when they had gone")
    if worst > 0.1 or not operator.waits:
        failures.append("emergency stop")
    if operator.failures:
        failures.append(f"{len(operator.failures)} refused: {operator.failures[0]}")
    if ended > 1 or status != 130:
        failures.append(f"Ctrl-C, status {status}")
    if not same:
        failures.append("replay")
    print(f"{name:10} pace {f'{pace:.4f}' if keeps_up else '-':>6}, then {pace_after:8.4f}; emergency stop {1e3 * worst:6.1f} ms "
          f"(median {1e3 * statistics.median(operator.waits or [0]):.1f}, {len(operator.waits)} times), page {1e3 * max(operator.opens, default=0):.0f} ms; "
          f"Ctrl-C {1e3 * ended:4.0f} ms; {len(sessions)} sessions, the last replays to {'the same' if same else 'OTHER'} bytes in {took:.1f} s"
          + "".join("; MISSED " + what for what in failures), flush=True)
    return not failures


def main():
    if sys.argv[1:2] == ["--be"]:
        return ATTACKS[sys.argv[2]][0](int(sys.argv[3]), int(sys.argv[4]))
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--scenes", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2] / "scenes")
    parser.add_argument("--seconds", type=float, default=5)
    parser.add_argument("--only", default=",".join(ATTACKS))
    parser.add_argument("--out", type=pathlib.Path, help="keep the sessions and their replays here")
    options = parser.parse_args()
    folder = options.out or pathlib.Path(tempfile.mkdtemp(prefix="drycut-attack-"))
    good = [attack(options, name, folder / name) for name in options.only.split(",")]
    if not options.out:
        shutil.rmtree(folder)
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())

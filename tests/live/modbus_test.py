"""A live line with an LX3VP under the Modbus programs of others: modbus_test.py PROGRAM mbpoll|pymodbus|tshark

mbpoll and pymodbus read and write the whole map; tshark dissects every frame that pymodbus and the line exchanged.
Exit status 77: what it needs is not installed.
"""
import os
import random
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import unittest

PROGRAM = os.path.abspath(sys.argv[1])
TOOL = sys.argv[2]

# First and last address, bits or words, and the value that stands there: C200 to C255 take two words each.
BITS = [("M", 0, 3071), ("M", 8000, 8255), ("S", 0xE000, 0xE3E7), ("T", 0xF000, 0xF0FF), ("C", 0xF400, 0xF4FF),
        ("X", 0xF800, 0xF8FF), ("Y", 0xFC00, 0xFCFF)]
WORDS = [("D", 0, 8255), ("T", 0xF000, 0xF0FF), ("C", 0xF400, 0xF4C7), ("C32", 0xF700, 0xF76F)]
# What the PLC and its program do not write themselves.
FREE_BITS = [(100, 3071), (0xE000, 0xE3E7), (0xF400, 0xF4FF), (0xFC10, 0xFCFF)]
FREE_WORDS = [(2, 7999), (0xF010, 0xF0FF), (0xF400, 0xF4C7), (0xF700, 0xF76F)]
OUTSIDE_BITS = [3072, 7999, 8256, 0xDFFF, 0xE3E8, 0xF100, 0xF500, 0xF900, 0xFBFF, 0xFD00, 0xFFFF]
OUTSIDE_WORDS = [8256, 0xEFFF, 0xF100, 0xF4C8, 0xF6FF, 0xF770, 0xFFFF]

SCENE = """scene: {title: Plc, step: 100 us, duration: 1000 h}
plants: {bench: {type: bench}}
controller: {lx3vp: {program: hmi.il, scan: 1 ms}}
wiring: {X0: bench.input1, Y10: bench.output1}
timeline: [{at: 1 ms, set: {bench.input1: 1}}]
record: {every: 100 ms, channels: [D0, D1]}
"""
LIST = "LD X0\nOUT Y10\nLD M8000\nADD D0 K1 D1\nEND\n"


class Line:
    """drycut live, until the end of a with block; its ports."""

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="drycut_modbus_")
        for name, text in (("line.yaml", SCENE), ("hmi.il", LIST)):
            with open(os.path.join(self.folder.name, name), "w", encoding="utf-8") as file:
                file.write(text)
        self.record = os.path.join(self.folder.name, "record")
        self.process = subprocess.Popen(
            [PROGRAM, "live", os.path.join(self.folder.name, "line.yaml"), "--port", "0", "--modbus", "0", "--record",
             self.record], stdout=subprocess.PIPE, text=True)
        for line in self.process.stdout:
            found = re.match(r"Modbus TCP: 127\.0\.0\.1 port (\d+)$", line)
            if found:
                self.port = int(found.group(1))
                return self
        raise RuntimeError("drycut live told no port of Modbus")

    def end(self):
        """Ends it and runs it again: the same bytes."""
        self.process.send_signal(signal.SIGINT)
        self.process.communicate(timeout=60)
        assert self.process.returncode == 130, self.process.returncode
        again = os.path.join(self.folder.name, "again")
        subprocess.run([PROGRAM, "replay", os.path.join(self.record, "1"), "--no-pictures", "--out", again], check=True,
                       stdout=subprocess.DEVNULL)
        for name in ("trace.csv", "events.csv"):
            with open(os.path.join(self.record, "1", name), "rb") as live:
                with open(os.path.join(again, "session", name), "rb") as replayed:
                    assert live.read() == replayed.read(), name + " differs"

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
            self.process.communicate()
        self.folder.cleanup()


def parts(first, last, most):
    """(address, count) of requests for a range."""
    for address in range(first, last + 1, most):
        yield address, min(most, last + 1 - address)


class Mbpoll(unittest.TestCase):
    def poll(self, line, kind, address, count, values=()):
        """What mbpoll prints of the addresses, or False after an exception."""
        words = ["mbpoll", "-0", "-1", "-q", "-m", "tcp", "-p", str(line.port), "-a", "1", "-t", kind, "-r",
                 str(address), "-o", "10"]
        if not values:
            words += ["-c", str(count)]
        answer = subprocess.run(words + ["127.0.0.1"] + (["--"] + [str(v) for v in values] if values else []),
                                capture_output=True, text=True, timeout=60)
        if answer.returncode != 0 or "failed" in answer.stderr:
            return False
        return [int(v) for v in re.findall(r"^\[\d+\]:\s+(-?\d+)", answer.stdout, re.MULTILINE)]

    def test_reads_and_writes_the_whole_map(self):
        with Line() as line:
            for kinds, ranges, outside in ((("0", "1"), BITS, OUTSIDE_BITS), (("4", "3"), WORDS, OUTSIDE_WORDS)):
                for kind in kinds:
                    for _, first, last in ranges:
                        for address, count in parts(first, last, 120):
                            if address % 960 == first % 960 or address + count > last:
                                self.assertEqual(len(self.poll(line, kind, address, count) or ()), count,
                                                 f"-t {kind} {address}")
                    for address in outside:
                        self.assertFalse(self.poll(line, kind, address, 1), f"-t {kind} {address}")
            for kind, ranges in (("0", FREE_BITS), ("4", FREE_WORDS)):
                for first, last in ranges:
                    for address in (first, (first + last) // 2, last - 3):
                        values = [1, 0, 1, 1] if kind == "0" else [1, 22, 333, 4444]
                        self.assertNotEqual(self.poll(line, kind, address, 4, values), False)
                        self.assertEqual(self.poll(line, kind, address, 4), values)
            self.assertEqual(self.poll(line, "0", 0xF800, 1, [1]), False, "inputs are read only")
            self.assertEqual(self.poll(line, "4", 0xF011, 1, [40000]), False, "a timer goes to 32767")
            line.end()


class Session:
    """pymodbus over the whole map; what it wrote it must find."""

    def __init__(self, test, port):
        from pymodbus.client import ModbusTcpClient
        self.test = test
        self.random = random.Random(1)
        self.client = ModbusTcpClient("127.0.0.1", port=port, timeout=30)
        test.assertTrue(self.client.connect())

    def run(self):
        client = self.client
        for read in (client.read_coils, client.read_discrete_inputs):
            for _, first, last in BITS:
                for address, count in parts(first, last, 2000):
                    answer = read(address, count, slave=1)
                    self.test.assertFalse(answer.isError(), f"{address}: {answer}")
            self.refused(OUTSIDE_BITS, 2, lambda address, read=read: read(address, 1, slave=1))
        for read in (client.read_holding_registers, client.read_input_registers):
            for _, first, last in WORDS:
                for address, count in parts(first, last, 125):
                    answer = read(address, count, slave=1)
                    self.test.assertEqual(len(answer.registers), count)
            self.refused(OUTSIDE_WORDS, 2, lambda address, read=read: read(address, 1, slave=1))
        self.write(FREE_BITS, 1968, lambda: self.random.random() < 0.5, client.write_coils,
                   lambda address, count: client.read_coils(address, count, slave=1).bits[:count])
        self.write(FREE_WORDS, 123, lambda: self.random.randrange(0x8000), client.write_registers,
                   lambda address, count: client.read_holding_registers(address, count, slave=1).registers)
        self.single()
        self.client.close()

    def write(self, ranges, most, value, write, read):
        for first, last in ranges:
            for address, count in parts(first, last, most):
                values = [value() for _ in range(count)]
                answer = write(address, values, slave=1)
                self.test.assertFalse(answer.isError(), f"{address}: {answer}")
                self.test.assertEqual(read(address, count), values, address)

    def single(self):
        client = self.client
        self.test.assertFalse(client.write_coil(200, True, slave=1).isError())
        self.test.assertTrue(client.read_coils(200, 1, slave=1).bits[0])
        self.test.assertFalse(client.write_register(3, 0x1234, slave=1).isError())
        self.test.assertFalse(client.mask_write_register(3, and_mask=0xF0F0, or_mask=0x0005, slave=1).isError())
        self.test.assertEqual(client.read_holding_registers(3, 1, slave=1).registers, [0x1234 & 0xF0F0 | 0x05])
        answer = client.readwrite_registers(read_address=3, read_count=3, write_address=4, write_registers=[8, 9],
                                            slave=1)
        self.test.assertEqual(answer.registers[1:], [8, 9])
        self.refused(range(0xF800, 0xF804), 2, lambda address: client.write_coil(address, True, slave=1))
        self.refused([0xF012], 3, lambda address: client.write_register(address, 40000, slave=1))

    def refused(self, addresses, exception, ask):
        for address in addresses:
            answer = ask(address)
            self.test.assertTrue(answer.isError(), address)
            self.test.assertEqual(answer.exception_code, exception, address)


class Pymodbus(unittest.TestCase):
    def test_reads_and_writes_the_whole_map(self):
        with Line() as line:
            Session(self, line.port).run()
            line.end()


class Relay(threading.Thread):
    """Stands between a client and the line and keeps what goes over it: (to the line, bytes)."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        self.line = port
        self.kept = []

    def run(self):
        client, _ = self.listener.accept()
        line = socket.create_connection(("127.0.0.1", self.line))
        back = threading.Thread(target=self.copy, args=(line, client, False))
        back.start()
        self.copy(client, line, True)
        back.join()

    def copy(self, source, target, to_line):
        while data := source.recv(65536):
            self.kept.append((to_line, data))
            target.sendall(data)
        target.shutdown(socket.SHUT_WR)


def write_capture(path, packets):
    """A pcap of raw IPv4 (LINKTYPE_RAW) in which a TCP connection to port 502 carries the packets."""
    sequence = {True: 1, False: 1}

    def checksum(data):
        data += b"\0" * (len(data) % 2)
        total = sum(struct.unpack(f">{len(data) // 2}H", data))
        while total >> 16:
            total = (total & 0xFFFF) + (total >> 16)
        return ~total & 0xFFFF

    with open(path, "wb") as file:
        file.write(struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 101))
        for number, (to_line, data) in enumerate(packets):
            ends = [socket.inet_aton("10.0.0.1"), socket.inet_aton("10.0.0.2")]
            ports = (40000, 502)
            if not to_line:
                ends.reverse()
                ports = ports[::-1]
            tcp = struct.pack(">HHIIBBHHH", *ports, sequence[to_line], sequence[not to_line], 0x50, 0x18, 65535, 0, 0)
            pseudo = ends[0] + ends[1] + struct.pack(">BBH", 0, 6, len(tcp) + len(data))
            tcp = tcp[:16] + struct.pack(">H", checksum(pseudo + tcp + data)) + tcp[18:]
            ip = struct.pack(">BBHHHBBH", 0x45, 0, 20 + len(tcp) + len(data), 0, 0, 64, 6, 0) + ends[0] + ends[1]
            ip = ip[:10] + struct.pack(">H", checksum(ip)) + ip[12:]
            sequence[to_line] += len(data)
            frame = ip + tcp + data
            file.write(struct.pack("<IIII", number // 1000, number % 1000 * 1000, len(frame), len(frame)) + frame)


class Tshark(unittest.TestCase):
    def dissect(self, capture, shown, fields):
        words = ["tshark", "-r", capture, "-o", "tcp.check_checksum:TRUE", "-Y", shown, "-T", "fields"]
        for field in fields:
            words += ["-e", field]
        return subprocess.run(words, capture_output=True, text=True, check=True, timeout=120).stdout.splitlines()

    def test_finds_no_frame_that_is_wrong(self):
        with Line() as line:
            relay = Relay(line.port)
            relay.start()
            Session(self, relay.port).run()
            relay.join(timeout=60)
            capture = os.path.join(line.folder.name, "modbus.pcap")
            write_capture(capture, relay.kept)
            frames = self.dissect(capture, "mbtcp", ["mbtcp.len", "modbus.func_code", "modbus.exception_code"])
            self.assertEqual(len(frames), len(relay.kept), "each packet is a frame")
            self.assertGreater(len(frames), 500)
            self.assertEqual({row.split("\t")[1] for row in frames}, {"1", "2", "3", "4", "5", "6", "15", "16", "22", "23"})
            self.assertEqual({row.split("\t")[2] for row in frames}, {"", "2", "3"})
            self.assertEqual(self.dissect(capture, "_ws.malformed || _ws.expert.severity >= 0x600000",
                                          ["frame.number", "_ws.expert.message"]), [])
            # The dissector does see what is wrong: a request that ends behind its address.
            write_capture(capture, [(True, bytes([0, 1, 0, 0, 0, 4, 1, 3, 0, 0]))])
            self.assertNotEqual(self.dissect(capture, "_ws.malformed || _ws.expert.severity >= 0x600000",
                                             ["frame.number"]), [])


def missing():
    if TOOL in ("mbpoll", "tshark") and shutil.which(TOOL) is None:
        return TOOL
    if TOOL in ("pymodbus", "tshark"):
        try:
            import pymodbus.client  # noqa: F401
        except ImportError as error:
            return f"python3-pymodbus ({error})"
    return ""


if __name__ == "__main__":
    if missing():
        print(f"skipped without {missing()}")
        sys.exit(77)
    wanted = {"mbpoll": Mbpoll, "pymodbus": Pymodbus, "tshark": Tshark}[TOOL]
    result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromTestCase(wanted))
    sys.exit(0 if result.wasSuccessful() else 1)

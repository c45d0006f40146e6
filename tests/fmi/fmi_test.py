#!/usr/bin/env python3
"""The FMUs that drycut writes: fmi_test.py PROGRAM KIND. Both versions of the standard, by importers of our own."""
import csv
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

from importer import ERROR, OK, Folder, Instance, unpack, write_fmu

HERE = Path(__file__).resolve().parent
HOUSE = HERE.parents[1]
SCENES = HOUSE / "scenes"
H = 1e-4


def build_example(name, there):
    compiler = shutil.which("cc") or shutil.which("gcc")
    program = there / name
    subprocess.run([compiler, "-std=gnu11", "-Wall", "-Wextra", "-Werror", "-O1", HOUSE / "examples" / "fmi" / f"{name}.c", "-ldl",
                    "-o", program], check=True)
    return program


# Scenes, what their controllers drive, and what is compared; the web's speed is set in mid-run, too.
NATIVE = {
    "knife": ("rotary_knife.yaml", 4, "web", {"2.AN01": "real:knife.servo.reference"},
              "knife.angle.total knife.blade.speed knife.motor.torque knife.cut.length knife.cut.force knife.motor.temperature "
              "knife.drive.i2t web.speed web.position web.lead web.drive.force count:knife.encoder count:web.wheel "
              "switch:knife.home"),
    "saw": ("flying_saw.yaml", 6, "tube", {"2.AN01": "real:saw.servo.reference", "2.OUT02": "switch:saw.clamp",
                                           "2.OUT03": "switch:saw.head.plunge"},
            "saw.position saw.speed saw.clamp.force saw.clamp.slip saw.blade.pinch saw.cut.length saw.cut.slant saw.head.depth "
            "saw.motor.torque tube.position tube.speed count:saw.encoder switch:saw.clamp.closed"),
    "press": ("press_learning.yaml", 4, "", {"2.OUT01": "switch:press.drive.forward", "2.OUT02": "switch:press.drive.backward",
                                             "2.OUT03": "switch:press.drive.slow", "2.OUT04": "switch:press.brake.release"},
              "press.position press.speed press.motor.speed press.motor.torque count:press.encoder switch:press.home"),
    "axis": ("backlash_motor_encoder.yaml", 4, "", {"2.AN01": "real:axis.servo.reference"},
             "axis.position axis.speed axis.motor.speed axis.motor.torque axis.motor.energy count:axis.encoder"),
}


def channel_of(name):
    """By which name a run records what the FMU has as a count or a switch."""
    kind, _, rest = name.rpartition(":")
    return rest + ".count" if kind == "count" else rest


def native(program, there):
    """A run's trace, every step of it, and the FMU driven by the same inputs: each cell is the same double."""
    replay = build_example("replay", there)
    for line, (scene, seconds, web, inputs, outputs) in NATIVE.items():
        outputs = outputs.split()
        channels = list(inputs) + [channel_of(name) for name in outputs] + ([f"{web}.set_speed"] if web else [])
        change = f"  - {{at: {seconds / 2} s, set: {{{web}.speed: 45 m/min}}}}\n" if web else ""
        begin = {"knife": "gbPhase == 2, after: 100 ms", "saw": "gbPhase == 2, after: 100 ms", "press": "", "axis": None}[line]
        start = "" if begin is None else (f"  - {{when: {begin}, set: {{panel.start: 1}}}}\n" if begin else
                                          "  - {at: 0.5 s, set: {panel.start: 1}}\n")
        timeline = f"timeline:\n{start}{change}" if start else ""
        own = there / f"{line}.yaml"
        own.write_text(f"extends: {SCENES / scene}\nscene: {{duration: {seconds} s}}\n{timeline}"
                       f"record: {{every: 100 us, channels: [{', '.join(channels)}]}}\nchecks: []\n")
        run = subprocess.run([program, "run", own, "--no-pictures", "--out", there / "out"], capture_output=True, text=True)
        assert run.returncode in (0, 1), run.stdout + run.stderr
        with open(there / "out" / line / "trace.csv", newline="") as file:
            rows = list(csv.reader(file))[1:]
        columns = list(zip(*rows))[1:]  # without the time
        assert len(rows) == seconds / H + 1, len(rows)
        driven = columns[:len(inputs)]
        assert any(len(set(column)) > 1 for column in driven), f"{line}: the controller drives nothing"
        table = []
        for n in range(1, len(rows)):
            cells = [column[n] for column in driven]
            if web:  # the setting as the timeline has it, in m/s
                cells.append(repr(45 / 60) if n > seconds / 2 / H else "nan")
            table.append(cells)
        if web:
            first = re.search(r"speed: ([0-9.]+) m/min", (SCENES / scene).read_text())[1]
            for cells in table:
                cells[-1] = repr(float(first) / 60) if cells[-1] == "nan" else cells[-1]
        names = list(inputs.values()) + ([f"real:set.{web}.speed"] if web else [])
        wanted = [name if ":" in name else "real:" + name for name in outputs]
        for version in (2, 3):
            fmu = write_fmu(program, own, version, there / f"{line}{version}.fmu")
            done = subprocess.run([replay, fmu.path, str(H), str(len(names)), str(len(wanted)), *names, *wanted],
                                  input="\n".join(" ".join(cells) for cells in table), capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
            answer = [[float(cell) for cell in row.split()] for row in done.stdout.splitlines()]
            assert len(answer) == len(table)
            for place, name in enumerate(outputs):
                column = columns[len(inputs) + place]
                assert len(set(column)) > 1, f"{line}: {name} never changes: nothing is compared"
                for n, row in enumerate(answer):
                    assert row[place] == float(column[n + 1]), (line, version, name, n, row[place], column[n + 1])
        print(f"{line}: {len(table)} steps, {len(outputs)} outputs, both versions: the same")


def line(program, there):
    """The line with its controller: at steps of 1 ms the channels of a run, both versions; its state in another instance; a
    variable of the scenario as a parameter; nothing needed but what it carries."""
    replay = build_example("replay", there)
    outputs = ["AxisX.posit", "AxisX.follerr", "knife.angle", "knife.motor.torque", "web.speed", "panel.in_sync", "knife.cut.length"]
    own = there / "line.yaml"
    own.write_text(f"extends: {SCENES / 'rotary_knife.yaml'}\nscene: {{duration: 6 s}}\n"
                   "timeline:\n  - {at: 2 s, set: {panel.start: 1}}\n  - {at: 4.5 s, set: {web.speed: 45 m/min}}\n"
                   f"record: {{every: 1 ms, channels: [{', '.join(outputs)}]}}\nchecks: []\n")
    run = subprocess.run([program, "run", own, "--no-pictures", "--out", there / "out"], capture_output=True, text=True)
    assert run.returncode in (0, 1), run.stdout + run.stderr
    with open(there / "out" / "line" / "trace.csv", newline="") as file:
        rows = list(csv.reader(file))[1:]
    assert len(rows) == 6001
    table = [(1 if n >= 2000 else 0, repr(45 / 60) if n >= 4500 else repr(60.4 / 60)) for n in range(6000)]
    for version in (2, 3):
        fmu = write_fmu(program, own, version, there / f"line{version}.fmu", "--part", "line")
        shown = subprocess.run(["ldd", fmu.binary], check=True, capture_output=True, text=True).stdout
        for needed in shown.splitlines():
            name = needed.split()[0]
            system = re.match(r"(lib(c|m|stdc\+\+|gcc_s)\.so|linux-vdso|/lib64/ld-linux)", name)
            assert system or f"=> {fmu.binary.parent}/{name} " in needed, needed
            assert not re.search("GL|assimp|cairo", name), needed
        part = r"(?:[A-Za-z_]\w*|'[^']+')"
        for name in fmu.variables:
            assert re.fullmatch(rf"{part}(?:\.{part})*", name), f"{name} is no structured name"
        assert "'2.AN01'" in fmu.variables and "set.web.speed" in fmu.variables
        # What the tables of plants and devices say of them.
        for name, words in (("knife.angle", "angle"), ("AxisX.pgain", "proportional gain"), ("parameters.AxisX.pgain", "proportional gain"),
                            ("AxisX.st_sync", "syn"), ("panel.in_sync", "lamp"), ("gbPhase", "program"), ("'2.AN01'", "terminal")):
            assert words in fmu.variables[name]["description"], fmu.variables[name]
        assert all(row["description"] not in ("", "as a run records it") for row in fmu.variables.values())
        page = (fmu.path / "documentation" / "index.html").read_text()
        assert "your controller" not in page and "rotary_knife.mod" in page and "Drycut's own library" in page
        names = [output + ".channel" if output + ".channel" in fmu.variables else output for output in outputs]
        done = subprocess.run([replay, fmu.path, "1e-3", "2", str(len(names)), "switch:panel.start", "real:set.web.speed",
                               *("real:" + name for name in names)],
                              input="\n".join(f"{on} {speed}" for on, speed in table), capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        answer = [[float(cell) for cell in row.split()] for row in done.stdout.splitlines()]
        assert len(answer) == len(table)
        for place, name in enumerate(outputs):
            column = [float(row[place + 1]) for row in rows]
            assert len(set(column)) > 1, f"{name} never changes: nothing is compared"
            for n, row in enumerate(answer):
                assert row[place] == column[n + 1], (version, name, n, row[place], column[n + 1])

        def begun(**parameters):
            instance = Instance(fmu)
            assert instance.handle, instance.said
            for parameter, value in parameters.items():
                assert instance.set(f"parameters.{parameter}", value) == OK, instance.said
            assert instance.initialise() == OK, instance.said
            return instance

        def go_on(instance, first, last):
            for n in range(first, last):
                assert instance.set("panel.start", n >= 2000) == OK and instance.step(n * 1e-3, 1e-3) == OK, instance.said

        one, other, shorter = begun(), begun(), begun(length=0.5)
        for name, row in fmu.variables.items():
            if row["causality"] == "parameter" and row["type"] != "String":
                assert one.get(name) == float({"true": 1, "false": 0}.get(row["start"], row["start"])), (row, one.get(name))
        go_on(one, 0, 3000)
        kept = one.save()
        go_on(one, 3000, 3600)
        assert other.restore(kept) == OK, other.said
        go_on(other, 3000, 3600)
        for name in names:
            assert one.get(name) == other.get(name), name
        go_on(shorter, 0, 5600)
        assert abs(shorter.get("knife.cut.length") - 500) < 0.5 and shorter.get("knife.cut.count") > 2, shorter.get("knife.cut.length")
        assert shorter.get("alarms.count") == 0
        assert shorter.set("set.web.speed", 1e6) == ERROR and "out of range" in shorter.said[-1]
        assert shorter.step(5.6, 1.5e-4) == ERROR and "whole multiple" in shorter.said[-1]
        # As a timeline would be refused, and not cut down to the bits that the device has.
        assert shorter.set("parameters.AxisX.pgain", 1e9) == ERROR and "0 to 32767" in shorter.said[-1], shorter.said
        assert shorter.set("parameters.AxisX.pgain", 40.0) == OK and shorter.get("parameters.AxisX.pgain") == 40
        bad = Instance(fmu)
        assert bad.set("parameters.length", 1e9) == OK
        assert bad.initialise() == ERROR and bad.said, "no variable of the program holds that length"
        for instance in (one, other, shorter, bad):
            instance.free()
    commissioned = there / "commissioned.yaml"
    commissioned.write_text(f"extends: {own}\ncontroller: {{qmove: {{set: {{AxisX.pgain: 61}}}}}}\n")
    said = subprocess.run([program, "fmu", commissioned, "--part", "line", "--fmi", "3.0", "--out", there / "commissioned.fmu"], check=True,
                          capture_output=True, text=True).stdout
    listed = {Path(row.strip()).name for row in said.splitlines() if row.startswith("  ")}
    assert listed == {"commissioned.yaml", "line.yaml", "rotary_knife.yaml", "rotary_knife.mod", "rotary_knife.cnf"}, said
    assert float(unpack(there / "commissioned.fmu", there / "commissioned").variables["parameters.AxisX.pgain"]["start"]) == 61
    # Unpacked twice: libraries of their own that share what is loaded once, begun in two threads at the same time.
    for n in range(6):
        folders = [Folder(shutil.copytree(fmu.path, there / f"copy{n}{side}")) for side in "ab"]
        gate, handles = threading.Barrier(2), []

        def begin(folder):
            gate.wait()
            instance = Instance(folder)
            handles.append(bool(instance.handle) and instance.initialise() == OK)

        threads = [threading.Thread(target=begin, args=(folder,)) for folder in folders]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert handles == [True, True], handles
    print("line: 6000 steps of 1 ms, 7 outputs, both versions: the same")


def knife(program, there, version, *more):
    return write_fmu(program, SCENES / "rotary_knife.yaml", version, there / f"knife{version}.fmu", *more)


def functions(program, there):
    """All functions of both standards and nothing else; needs nothing but what it carries and the C and C++ libraries."""
    wanted = (HERE / "functions.txt").read_text().split()
    for version in (2, 3):
        odd = there / "ein Ordner für FMUs"
        odd.mkdir(exist_ok=True)
        fmu = write_fmu(program, SCENES / "rotary_knife.yaml", version, odd / f"knife{version}.fmu")
        shown = subprocess.run(["nm", "-D", "--defined-only", fmu.binary], check=True, capture_output=True, text=True).stdout
        assert sorted(line.split()[-1] for line in shown.splitlines()) == sorted(wanted)
        linked = subprocess.run(["ldd", fmu.binary], check=True, capture_output=True, text=True).stdout
        for line in linked.splitlines():
            name = line.split()[0]
            system = re.match(r"(lib(c|m|stdc\+\+|gcc_s)\.so|linux-vdso|/lib64/ld-linux)", name)
            assert system or f"=> {fmu.binary.parent}/{name} " in line, line
            assert not re.search("yaml|udunits|GL|assimp|cairo", name), line
        for resources in ([fmu.path.as_uri() + "/resources", "file://localhost" + (fmu.path / "resources").as_uri()[7:],
                           str(fmu.path) + "//resources"] if version == 2 else [str(fmu.path) + "//resources"]):
            instance = Instance(fmu, resources=resources)
            assert instance.handle and instance.initialise() == OK and instance.step(0, H) == OK, instance.said
            instance.free()
    # Those that cannot are refused with a reason, and the instance goes on.
    for version in (2, 3):
        instance = Instance(Folder(there / "ein Ordner für FMUs" / f"knife{version}"))
        instance.initialise()
        told = 0
        for name in wanted:
            short = name[4:]
            if not name.startswith(f"fmi{version}") or not re.match(
                    "(Enter(Event|Step|Continuous|Config)|ExitConfig|Cancel|NewDisc|Evaluate|Update|Activate|"
                    "(Get|Set)(Interval|Shift|Continuous|Directional|Adjoint|Derivatives|Nominals|Event|Time|RealInput|RealOutput|"
                    "OutputDer|NumberOf|VariableDep)|Completed)", short):
                continue
            assert instance.call(short) == ERROR and len(instance.said) == told + 1 and name in instance.said[-1], name
            told += 1
        assert told == {2: 14, 3: 30}[version], told
        assert instance.step(0, H) == OK
    print("all functions")


def description(program, there):
    """What it says holds together: names, references, units, ranges, structure; the same FMU has the same bytes anywhere."""
    for version in (2, 3):
        fmu = knife(program, there, version)
        again = dict(os.environ, TZ="Asia/Tokyo", LC_ALL="C")
        other = there / "again.fmu"
        subprocess.run([program, "fmu", SCENES / "rotary_knife.yaml", "--fmi", str(version), "--out", other], check=True, env=again,
                       capture_output=True)
        assert other.read_bytes() == (there / f"knife{version}.fmu").read_bytes()
        rows = list(fmu.variables.values())
        references = [row["valueReference"] for row in rows]
        assert len(set(references)) == len(rows) == len(fmu.root.find("ModelVariables")) > 200
        units = {unit.get("name"): [shown.get("name") for shown in unit.findall("DisplayUnit")]
                 for unit in fmu.root.find("UnitDefinitions")}
        for row in rows:
            assert re.fullmatch(r"[A-Za-z_]\w*(\.\w+)*", row["name"]), row
            assert row["description"], row
            assert "unit" not in row or row["unit"] in units, row
            assert "displayUnit" not in row or row["displayUnit"] in units[row["unit"]], row
            assert ("start" in row) == (row["causality"] in ("parameter", "input")), row
            if "min" in row:
                assert float(row["min"]) <= float(row["start"]) <= float(row["max"]), row
        outputs = {row["valueReference"] for row in rows if row["causality"] == "output"}
        structure = fmu.root.find("ModelStructure")
        if version == 2:
            listed = [{rows[int(unknown.get("index")) - 1]["valueReference"] for unknown in structure.find(part)}
                      for part in ("Outputs", "InitialUnknowns")]
        else:
            listed = [{unknown.get("valueReference") for unknown in structure.findall(part)}
                      for part in ("Output", "InitialUnknown")]
        assert listed == [outputs, outputs]
        instance = Instance(fmu)
        assert instance.initialise() == OK
        for row in rows:  # each can be got, and starts where the description says
            value = instance.get(row["name"])
            assert instance.status == OK, (row, instance.said)
            if "start" in row and row["type"] != "String":
                start = {"true": 1, "false": 0}.get(row["start"])
                assert value == (float(row["start"]) if start is None else start), (row, value)
        circumference = fmu.variables["parameters.knife.circumference"]
        assert (float(circumference["start"]), circumference["unit"], circumference["displayUnit"]) == (0.6, "m", "mm")
        page = (fmu.path / "documentation" / "index.html").read_text()
        assert page.count("<tr>") == len(rows) + 1 and "your controller" in page and "None of the files" in page
        own, carried = HOUSE / "LICENSE", fmu.path / "documentation" / "licenses" / "drycut.txt"
        assert carried.read_text() == own.read_text() if own.exists() else not carried.exists() and "under no licence" in page
        assert "zlib" in (fmu.path / "documentation" / "licenses" / "libbullet3.24.txt").read_text().lower()
    print("the descriptions")


def scenes(program, there):
    """Every scene's machine: each variable starts where the description says; a state in the middle, and the same from there."""
    types = set()
    for scene in sorted(SCENES.glob("*.yaml")):
        text = scene.read_text()
        if re.search("^compare:", text, re.MULTILINE):
            continue
        fmu = write_fmu(program, scene, 2 + len(types) % 2, there / f"{scene.stem}.fmu")
        types.update(re.findall(r'"type": "(\w+)"', (fmu.path / "resources" / "machine.json").read_text()))
        instance = Instance(fmu)
        assert instance.initialise() == OK, instance.said
        for row in fmu.variables.values():
            value = instance.get(row["name"])
            assert instance.status == OK, (scene.name, row, instance.said)
            if "start" in row:
                start = {"true": 1, "false": 0}.get(row["start"], row["start"])
                assert value == (start if row["type"] == "String" else float(start)), (scene.name, row, value)
        step = float(fmu.root.find("DefaultExperiment").get("stepSize"))

        def steps():
            for row in fmu.variables.values():
                if row["causality"] == "input" and row["type"] == "Boolean" and not re.search("fault|backward", row["name"]):
                    instance.set(row["name"], 1)
                elif row["causality"] == "input" and row.get("unit") == "V" and "fault" not in row["name"]:
                    instance.set(row["name"], 1.5)
                elif row["name"].endswith(".pulses") and row["causality"] == "input":
                    instance.set(row["name"], int(instance.get(row["name"])) + 200)
            for _ in range(200):
                assert instance.step(instance.get("time"), step) == OK, (scene.name, instance.said)
            return [instance.get(name) for name, row in fmu.variables.items() if row["causality"] == "output"]

        begin = steps()
        kept = instance.save()
        end = steps()
        assert instance.restore(kept) == OK and steps() == end != begin, scene.name
        instance.free()
        shutil.rmtree(fmu.path)
    print(f"scenes with {', '.join(sorted(types))}")
    assert len(types) >= 7, types


def drive(instance, begin, steps):
    """A reference that moves; what comes of it."""
    seen = []
    for n in range(begin, begin + steps):
        instance.set("knife.servo.reference", 4 + 3 * math.sin(n * 0.003))
        assert instance.step(n * H, H) == OK, instance.said
        if n % 10 == 0:
            seen.append([instance.get(name) for name in WATCHED])
    return seen


WATCHED = ["knife.angle.total", "knife.motor.torque", "knife.encoder", "web.position", "knife.cut.count", "knife.encoder.index.latch",
           "knife.encoder.index.rise_time", "fault.knife.encoder.jitter", "parameters.web.mass"]


def state(program, there):
    """Kept in a file, restored in another process: the same from there on; gone back to in the same process, too."""
    if len(sys.argv) > 3:  # the other process
        instance = Instance(Folder(sys.argv[3]))
        assert instance.restore(Path(sys.argv[4]).read_bytes()) == OK, instance.said
        print(drive(instance, 3000, 5000))
        return
    for version in (2, 3):
        fmu = knife(program, there, version)
        instance = Instance(fmu)
        for name, value in (("parameters.knife.circumference", 0.5), ("parameters.web.mass", 22.0)):
            assert instance.set(name, value) == OK
        assert instance.initialise() == OK
        drive(instance, 0, 1500)
        assert instance.set("fault.knife.encoder.jitter", 3.0) == OK and instance.set("parameters.web.mass", 25.0) == OK
        drive(instance, 1500, 1500)
        kept = instance.save()
        assert kept == instance.save()
        (there / "state").write_bytes(kept)
        first = drive(instance, 3000, 5000)
        assert first[-1][4] > 0 and first[-1][5] != 0 and first[-1][7:] == [3.0, 25.0], first[-1]
        assert instance.restore(kept) == OK and drive(instance, 3000, 5000) == first
        other = subprocess.run([sys.executable, __file__, program, "state", fmu.path, there / "state"], capture_output=True, text=True)
        assert other.returncode == 0, other.stderr
        assert other.stdout.strip() == str(first)
        # Bytes of anything else are refused, and nothing has changed.
        before = instance.save()
        for bad in (kept[:-1], kept[:100] + bytes([kept[100] ^ 1]) + kept[101:], b"", b"x" * 1000):
            assert instance.restore(bad) == ERROR and instance.said, bad[:10]
        assert instance.save() == before
        slower = write_fmu(program, SCENES / "rotary_knife.yaml", version, there / "slower.fmu", "--set", "plants.web.speed=50 m/min")
        assert Instance(slower).restore(kept) == ERROR
    print("the states")


def refusals(program, there):
    """What cannot be is a status and a message; the instance goes on, and nothing exits."""
    for version in (2, 3):
        fmu = knife(program, there, version)
        stranger = Instance(fmu, token="{another}")
        assert not stranger.handle and "token" in stranger.said[0]
        if version == 2:  # as importers give it
            os.chdir(fmu.path)
            for where in ("file:resources", "file://resources", "resources", f"file://localhost{fmu.path}/resources"):
                instance = Instance(fmu, resources=where)
                assert instance.handle, (where, instance.said)
                instance.free()
        nowhere = Instance(fmu, resources="/nowhere")
        assert not nowhere.handle and "/nowhere/machine.json" in nowhere.said[0]

        def refused(instance, status, *words):
            assert status == ERROR and instance.said and all(word in instance.said[-1] for word in words), (status, instance.said)

        instance = Instance(fmu)
        refused(instance, instance.step(0, H), "out of their order")
        refused(instance, instance.set("parameters.knife.circumference", -1.0), "parameters.knife.circumference", "50 to 10000 mm")
        refused(instance, instance.set("parameters.knife.circumference", math.nan), "finite")
        refused(instance, instance.set("parameters.knife.drive", "best"), "none of", "pulses")
        refused(instance, instance.set("knife.angle", 1.0), "output")
        instance.folder.variables["missing"] = {"valueReference": "100000", "type": "Real" if version == 2 else "Float64"}
        refused(instance, instance.set("missing", 1.0), "100000")
        instance.folder.variables["wrong"] = dict(fmu.variables["knife.angle"], type="Boolean")
        instance.get("wrong")
        refused(instance, instance.status, "knife.angle", "real number")
        # Each is in its range, and together they are no machine: the plant objects as the scenario would.
        assert instance.set("parameters.knife.gear.stiffness", 1e7) == OK
        refused(instance, instance.initialise(), "knife.gear.stiffness", "[plant.")
        assert instance.call("Reset") == OK and instance.initialise() == OK, instance.said
        for size in (0.5 * H, 1.5 * H, 0.0, -H, math.nan, math.inf):
            refused(instance, instance.step(0, size), "whole multiple")
        refused(instance, instance.step(1, H), "asked for")
        refused(instance, instance.set("parameters.knife.circumference", 0.5), "fixed")
        assert instance.step(0, 20 * H) == OK and instance.step(20 * H, H * (1 + 1e-9)) == OK, instance.said
        instance.free()
        # A machine that leaves all bounds ends with an error, not with the process.
        wild = Instance(fmu)
        for name, value in (("speed_at_10v", 1e4), ("max_speed", 1e4), ("rated_speed", 9e3), ("peak_torque", 9e4),
                            ("torque_at_max_speed", 8e4), ("rated_torque", 9e3)):
            assert wild.set(f"parameters.knife.servo.{name}", value) == OK
        wild.initialise()
        wild.set("knife.servo.reference", 10.0)
        status = OK
        for n in range(2000):
            status = wild.step(n * H, H)
            if status != OK:
                break
        refused(wild, status, "knife motor", "cannot be followed")
        refused(wild, wild.step(wild.get("time"), H), "cannot be followed")
        assert wild.call("Reset") == OK and wild.initialise() == OK and wild.step(0, H) == OK
    print("refusals")


def instances(program, there):
    """Several at once, in threads, of both versions: each as if it were alone. Early return, the example of a PI controller."""
    folders = [knife(program, there, version) for version in (2, 3)]
    alone = None
    for fmu in folders:
        instance = Instance(fmu)
        instance.initialise()
        seen = drive(instance, 0, 4000)
        assert alone is None or seen == alone
        alone = seen
    answers = {}

    def one(n):
        instance = Instance(folders[n % 2])
        if n >= 4:
            instance.set("parameters.web.speed", 0.5)
        instance.initialise()
        answers[n] = drive(instance, 0, 4000)

    threads = [threading.Thread(target=one, args=(n,)) for n in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(answers[n] == alone for n in range(4)) and answers[4] == answers[5] != alone

    for early in (False, True):
        instance = Instance(folders[1], early=early)
        instance.initialise()
        instance.set("knife.servo.reference", 8.0)
        returns = 0
        while instance.get("time") < 1:
            begin = instance.get("time")
            assert instance.step(begin, round((1 - begin) / H) * H) == OK, instance.said
            returns += instance.early.value
            assert instance.reached.value == instance.get("time")
            if instance.early.value and instance.get("knife.cut.count") == 1:
                assert begin < instance.get("time") - H <= instance.get("knife.cut.time") <= instance.get("time"), "not at the cut"
                break
        assert (returns > 1) == early, returns  # the drive at its torque limit, and the cut
        assert early or (instance.reached.value == 1 and instance.get("knife.cut.count") > 1)

    pi = build_example("pi", there)
    single = Path("/usr/lib/x86_64-linux-gnu")
    for fmu in folders:
        # An importer with Bullet in single precision would get other results: it gets none.
        for library in ("libBulletDynamics.so", "libBulletCollision.so"):
            others = dict(os.environ, LD_PRELOAD=str(single / library))
            done = subprocess.run([pi, fmu.path], env=others, capture_output=True, text=True)
            assert done.returncode == 3 and library in done.stderr and "single precision" in done.stderr, done
        said = subprocess.run([pi, fmu.path], check=True, capture_output=True, text=True).stdout
        count = int(re.search(r"at rest: (-?\d+) counts", said)[1])
        assert abs(count - 4096) <= 2, said
    print("instances")


def bode(program, there):
    """The margins behind an FMI step are those of a loop whose controller computes for so long, which a run measures."""
    def margins(*more):
        said = subprocess.run([program, "bode", SCENES / "rotary_knife.yaml", *more], capture_output=True, text=True)
        assert said.returncode == 0, said.stdout + said.stderr
        found = {}
        for line in said.stdout.splitlines():
            number = re.match(r"(phase|gain) margin( behind an FMI step of 1 ms:)? +(-?[0-9.]+) (deg|dB) at", line)
            if number:
                found[number[1], bool(number[2])] = float(number[3])
        return found

    told = margins("--fmi-step", "1 ms", "--out", there / "bode")
    report = (there / "bode" / "report.html").read_text()
    assert report.count("behind an FMI step of 1 ms") >= 2, "the report does not say it"
    measured = margins("--set", "controller.qmove.compute_time=1 ms")
    assert len(told) == 4 and len(measured) == 2, (told, measured)
    for margin in ("phase", "gain"):
        lost = told[margin, False] - measured[margin, False]
        assert lost > 0.5 and abs(told[margin, True] - measured[margin, False]) < 0.1 * lost, (margin, told, measured)
    # Its crossover is near 4 Hz, and its phase margin less than a quarter of a turn: 100 ms are too long, and 300 ms no turn better.
    for step in ("100 ms", "300 ms"):
        slow = subprocess.run([program, "bode", SCENES / "rotary_knife.yaml", "--fmi-step", step], capture_output=True, text=True)
        assert f"unstable behind an FMI step of {step}" in slow.stdout and "margin behind" not in slow.stdout, slow.stdout
    for step in ("1 mm", "1"):
        bad = subprocess.run([program, "bode", SCENES / "rotary_knife.yaml", "--fmi-step", step], capture_output=True, text=True)
        assert bad.returncode == 2 and "[option.out-of-range]" in bad.stderr
    print("margins:", told)


def main():
    program, kind = sys.argv[1:3]
    kinds = {"native": native, "functions": functions, "description": description, "scenes": scenes, "state": state,
             "refusals": refusals, "instances": instances, "bode": bode, "line": line}
    with tempfile.TemporaryDirectory() as there:
        kinds[kind](program, Path(there))


main()

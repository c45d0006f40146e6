#!/usr/bin/env python3
"""Foreign FMUs in a line: guest_test.py PROGRAM KIND. The FMU is guest.c, in both versions of the standard."""
import csv
import json
import os
import re
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
HOUSE = HERE.parents[1]
SKIPPED = 77
U, ENABLE, STEP_BY, GAIN, T, FAIL, FAIL_AT, LABEL, X, ON, COUNT, RPM = range(12)
CRASH, HANG, EAT, REFUSE, LEAVE, NOT_A_NUMBER, REFUSE_BEGIN = range(1, 8)

UNITS = """<UnitDefinitions>
  <Unit name="V"><BaseUnit kg="1" m="2" s="-3" A="-1"/></Unit>
  <Unit name="turns a minute"><BaseUnit rad="1" s="-1" factor="0.10471975511965977"/></Unit>
</UnitDefinitions>"""

# name, reference, causality, type, start, unit
VARIABLES = [("u", U, "input", "real", "0", "V"), ("enable", ENABLE, "input", "flag", "true", ""),
             ("step_by", STEP_BY, "input", "whole", "1", ""), ("gain", GAIN, "parameter", "real", "1", ""),
             ("time.constant", T, "parameter", "real", "1", "s"), ("fail", FAIL, "parameter", "whole", "0", ""),
             ("fail_at", FAIL_AT, "parameter", "real", "0", "s"), ("label", LABEL, "parameter", "text", "plain", ""),
             ("x", X, "output", "real", "", "V"), ("on", ON, "output", "flag", "", ""),
             ("count", COUNT, "output", "whole", "", ""), ("shaft", RPM, "output", "real", "", "turns a minute")]
TYPES = {2: {"real": "Real", "flag": "Boolean", "whole": "Integer", "text": "String"},
         3: {"real": "Float64", "flag": "Boolean", "whole": "Int64", "text": "String"}}


def description(version, state=True, more=""):
    flags = (' canGetAndSetFMUstate="true" canSerializeFMUstate="true"' if version == 2 else
             ' canGetAndSetFMUState="true" canSerializeFMUState="true"') if state else ""
    rows, outputs = "", ""
    for place, (name, reference, causality, kind, start, unit) in enumerate(VARIABLES):
        if version == 3 and kind == "whole" and causality == "parameter":
            kind_name = "Int64"
        else:
            kind_name = TYPES[version][kind]
        discrete = ' variability="discrete"' if kind != "real" else ""
        fixed = ' variability="fixed"' if causality == "parameter" else discrete
        typed = (f' unit="{unit}"' if unit else "") + (f' start="{start}"' if start and not (version == 3 and kind == "text") else "")
        if version == 2:
            rows += (f'<ScalarVariable name="{name}" valueReference="{reference}" causality="{causality}"{fixed}>'
                     f'<{kind_name}{typed}/></ScalarVariable>\n')
        elif kind == "text":
            rows += (f'<String name="{name}" valueReference="{reference}" causality="{causality}"{fixed}>'
                     f'<Start value="{start}"/></String>\n')
        else:
            rows += f'<{kind_name} name="{name}" valueReference="{reference}" causality="{causality}"{fixed}{typed}/>\n'
        if causality == "output":
            outputs += f'<Unknown index="{place + 1}"/>' if version == 2 else f'<Output valueReference="{reference}"/>'
    structure = f"<Outputs>{outputs}</Outputs>" if version == 2 else outputs
    return (f'<?xml version="1.0" encoding="UTF-8"?>\n<fmiModelDescription fmiVersion="{version}.0" modelName="lag" '
            f'{"guid" if version == 2 else "instantiationToken"}="{{lag}}">\n'
            f'<CoSimulation modelIdentifier="lag"{flags} canHandleVariableCommunicationStepSize="true"{more}/>\n{UNITS}\n'
            f"<ModelVariables>\n{rows}</ModelVariables>\n<ModelStructure>{structure}</ModelStructure>\n</fmiModelDescription>\n")


def folder_of(version):
    return "binaries/linux64" if version == 2 else "binaries/x86_64-linux"


class Place:
    """A folder with FMUs and scenarios."""

    def __init__(self, program, there):
        self.program, self.there, self.libraries = program, Path(there), {}
        self.temporary = self.there / "tmp"
        self.temporary.mkdir()

    def library(self, version, *defined):
        if (version, defined) not in self.libraries:
            out = self.there / f"lag{version}{''.join(defined)}.so"
            subprocess.run([shutil.which("cc") or "gcc", "-std=gnu11", "-Wall", "-Wextra", "-Wno-unused-parameter", "-Wno-unused-function", "-Werror", "-O1",
                            "-shared", "-fPIC", "-fvisibility=hidden", f"-DFMI={version}", *(f"-D{d}" for d in defined),
                            HERE / "guest.c", "-o", out], check=True)
            self.libraries[version, defined] = out.read_bytes()
        return self.libraries[version, defined]

    def fmu(self, name, version, xml=None, defined=(), library=None, files=()):
        with zipfile.ZipFile(self.there / name, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("modelDescription.xml", description(version) if xml is None else xml)
            bytes_ = self.library(version, *defined) if library is None else library
            if bytes_:
                archive.writestr(f"{folder_of(version)}/lag.so", bytes_)
            for inside, content in files:
                archive.writestr(inside, content)
        return name

    def scenario(self, name, text):
        file = self.there / f"{name}.yaml"
        file.write_text(text)
        return file

    def run(self, name, text, *options, verb="run"):
        file = self.scenario(name, text)
        more = ["--no-pictures", "--out", self.there / "out"] if verb == "run" else []
        done = subprocess.run([self.program, verb, file, *more, *options], capture_output=True, text=True, timeout=300,
                              env={**os.environ, "TMPDIR": str(self.temporary)})
        done.folder = self.there / "out" / name
        return done

    def rows(self, name):
        """Of a trace, by the channels' names, without units."""
        with open(self.there / "out" / name / "trace.csv", newline="") as file:
            return [{key.rsplit(" [", 1)[0]: cell for key, cell in row.items()} for row in csv.DictReader(file)]


def line(fmu, parameters="", more="", channels="lag.x, lag.on, lag.count, lag.shaft", every="1 ms", duration="50 ms", rest=""):
    return f"""scene: {{step: 100 us, duration: {duration}}}
plants:
  lag: {{type: fmu, file: {fmu}, every: {every}, parameters: {{{parameters}}}{more}}}
record: {{every: 100 us, channels: [{channels}]}}
{rest}"""


def runs(place):
    """The closed form of the lag; units, parameters of every type, arrays of plugs, inputs held over a step."""
    for version in (2, 3):
        fmu = place.fmu(f"lag{version}.fmu", version)
        text = line(fmu, "gain: 2, time: {constant: 10 ms}, label: other", rest="""timeline:
  - {at: 3.4 ms, set: {lag.u: 500 mV}}
  - {at: 20 ms, set: {lag.step_by: 3}}
  - {at: 30 ms, set: {lag.enable: 0}}
checks:
  - {name: turns, always: "abs(lag.shaft - 60 * lag.x / 1 V * 0.10471975511965977 rad/s) < 1e-9 rad/s"}
""")
        done = place.run(f"runs{version}", text)
        assert done.returncode == 0, done.stdout + done.stderr
        rows = place.rows(f"runs{version}")
        assert len(rows) == 501
        x, count, wanted = 0.0, 0, {}
        for step in range(50):
            wanted[step + 1] = None
            u = 0.5 if step >= 4 else 0.0  # from 3.4 ms on: its step that begins at 4 ms is the first
            if step < 30:
                x += 1e-3 / 10e-3 * (2 * u - x)
            count += 3 if step >= 20 else 1
            wanted[step + 1] = (x, count)
        for n, row in enumerate(rows):
            x, count = wanted.get(n // 10, (0.0, 0))
            assert abs(float(row["lag.x"]) - x) < 1e-12, (version, n, row, x)
            assert float(row["lag.count"]) == count and float(row["lag.on"]) == (x > 0.5), (version, n, row)
        assert wanted[30][0] > 0.9
        assert "[fmu.guest]" in done.stdout and f"FMI {version}.0" in done.stdout, done.stdout
        again = place.run(f"again{version}", text)
        assert again.returncode == 0
        trace = [(place.there / "out" / f"{name}{version}" / "trace.csv").read_bytes() for name in ("runs", "again")]
        assert trace[0] == trace[1]
    print("runs: as the closed form, both versions")


def wires(place):
    """From plant to plant, with units; an FMU as the controller of an axis: a loop as on paper."""
    fmu = place.fmu("lag.fmu", 3)
    text = f"""scene: {{step: 1 ms, duration: 100 ms}}
plants:
  one: {{type: fmu, file: {fmu}, parameters: {{time: {{constant: 10 ms}}}}}}
  two: {{type: fmu, file: {fmu}, parameters: {{time: {{constant: 20 ms}}}}}}
wiring: {{two.u: one.x, two.enable: one.on}}
timeline:
  - {{at: 0 ms, set: {{one.u: 1 V}}}}
record: {{every: 1 ms, channels: [one.x, two.x, one.on]}}
"""
    done = place.run("wires", text)
    assert done.returncode == 0, done.stdout + done.stderr
    one = two = 0.0
    for n, row in enumerate(place.rows("wires")):
        assert abs(float(row["one.x"]) - one) < 1e-12 and abs(float(row["two.x"]) - two) < 1e-12, (n, row, one, two)
        taken, on = one, one > 0.5  # what the first had at the end of the step before
        one += 0.1 * (1 - one)
        if on:
            two += 0.05 * (taken - two)
    assert two > 0.5
    for wiring, code in (("two.u: one.count", "scenario.wrong-unit"), ("two.u: one.y", "wiring.no-plug"),
                         ("two.v: one.x", "wiring.no-plug"), ("one.x: two.x", "wiring.no-plug"),
                         ("2.INP01: one.on", "wiring.no-terminal"), ("one.on: two.on", "wiring.kinds-differ")):
        wrong = place.run("wrong", text.replace("two.u: one.x, two.enable: one.on", wiring), verb="check")
        assert wrong.returncode == 2 and f"[{code}]" in wrong.stderr, (wiring, wrong.stderr)
    line_fmu = place.there / "line.fmu"
    written = subprocess.run([place.program, "fmu", place.there / "wires.yaml", "--part", "line", "--out", line_fmu], capture_output=True, text=True)
    with zipfile.ZipFile(line_fmu) as archive:
        xml_text = archive.read("modelDescription.xml").decode()
    assert written.returncode == 0 and "lag.fmu" in written.stdout, written
    assert 'name="set.one.u"' in xml_text and 'name="set.two.step_by"' in xml_text
    assert 'name="set.two.u"' not in xml_text and 'name="set.two.enable"' not in xml_text, "a wire drives it"
    itself = place.run("itself", text.replace("two.u: one.x", "two.u: two.x"), verb="check")
    assert itself.returncode == 0 and "two.u takes what two.x was at the end of the step before" in itself.stdout + itself.stderr, itself
    machine = place.run("machine", "scene: {duration: 1 s}\nplants: {a: {type: rotary_axis}, b: {type: rotary_axis}}\n"
                        "wiring: {a.servo.reference: b.servo.reference}\n", verb="fmu")
    assert machine.returncode == 2 and "[scenario.does-not-go-together]" in machine.stderr, machine
    twice = place.run("twice", text.replace("one.u: 1 V", "two.u: 1 V"), verb="check")
    assert twice.returncode == 2 and "[input.driven-twice]" in twice.stderr, twice.stderr
    print("wires: two lags in a row, as on paper")


def refused(place):
    """What cannot be loaded or lies in its description is told at its file, with status 2."""
    good = description(2)
    bomb = [("resources/zeros", b"\0" * 120_000_000)]
    cases = {
        "no-zip": (None, "fmu.archive"),
        "missing": ("", "file.missing"),
        "no-description": (dict(xml=""), "fmu.description"),
        "bad-xml": (dict(xml=good.replace("</ModelVariables>", "</Model>")), "fmu.description"),
        "fmi1": (dict(xml=good.replace('fmiVersion="2.0"', 'fmiVersion="1.0"')), "fmu.description"),
        "exchange": (dict(xml=good.replace("CoSimulation", "ModelExchange")), "fmu.description"),
        "twice": (dict(xml=good.replace('name="gain"', 'name="u"')), "fmu.description"),
        "no-reference": (dict(xml=good.replace('valueReference="3"', 'valueReference="three"')), "fmu.description"),
        "structure": (dict(xml=good.replace('index="9"', 'index="1"')), "fmu.description"),
        "start": (dict(xml=good.replace('start="1"', 'start="one"')), "fmu.description"),
        "exponents": (dict(xml=good.replace('m="2"', 'm="300"')), "fmu.description"),
        "whole-start": (dict(xml=good.replace('<Integer start="0"/>', '<Integer start="3000000000"/>')), "fmu.description"),
        "half-start": (dict(xml=good.replace('<Integer start="0"/>', '<Integer start="0.5"/>')), "fmu.description"),
        "outside": (dict(files=[("../outside", b"x")]), "fmu.archive"),
        "absolute": (dict(files=[("/tmp/outside", b"x")]), "fmu.archive"),
        "bomb": (dict(files=bomb), "fmu.archive"),
        "platform": (dict(library=b"", files=[("binaries/win64/lag.dll", b"MZ")]), "fmu.refused"),
        "identifier": (dict(xml=good.replace('modelIdentifier="lag"', 'modelIdentifier="drag"')), "fmu.refused"),
        "no-library": (dict(library=b"MZ no library of this system"), "fmu.refused"),
        "lacks": (dict(defined=("LACKS_STEP",)), "fmu.refused"),
        "version": (dict(defined=("OTHER_VERSION",)), "fmu.refused"),
        "unknown": (dict(defined=("UNKNOWN",)), "fmu.refused"),
        "token": (dict(xml=good.replace("{lag}", "{other}")), "fmu.refused"),
    }
    for name, (made, code) in cases.items():
        if made is None:
            (place.there / f"{name}.fmu").write_text("no zip")
        elif made != "":
            place.fmu(f"{name}.fmu", 2, **made)
        done = place.run(name, line(f"{name}.fmu"))
        assert done.returncode == 2 and f"[{code}]" in done.stderr, (name, done.returncode, done.stderr)
        assert re.match(rf".*{name}\.yaml:3:\d+: ", done.stderr), (name, done.stderr)
        assert not (done.folder / "trace.csv").exists()
        told = {"platform": "it has binaries/win64", "identifier": "drag.so; there it has lag.so"}.get(name, "")
        assert told in done.stderr, (name, done.stderr)
    place.fmu("good.fmu", 2)
    for parameters, more, code in (("gian: 2", "", "scenario.unknown-key"), ("time: {constant: 3 V}", "", "scenario.wrong-unit"),
                                   ("gain: much", "", "scenario.not-a-number"), ("fail: 7", "", "fmu.refused"),
                                   ("", ", every: 150 us", "scenario.time-grid"), ("", ", limits: {memory: 1}", "scenario.out-of-range")):
        text = line("good.fmu", parameters, more).replace(", every: 1 ms", "", 1 if "every" in more else 0)
        done = place.run("parameters", text, verb="check")
        assert done.returncode == 2 and f"[{code}]" in done.stderr, (parameters, more, done.stderr)
    many = "".join(f'<Float64 name="a{n}" valueReference="{100 + n}" causality="input" start="0"><Dimension start="10000"/></Float64>' for n in range(11))
    place.fmu("many.fmu", 3, xml=description(3).replace("</ModelVariables>", many + "</ModelVariables>"))
    assert "more than 100000 variables [fmu.description]" in re.sub("; [^;]* \\[", " [", place.run("many", line("many.fmu"), verb="check").stderr)
    place.fmu("fixed.fmu", 3, xml=description(3, more=' fixedInternalStepSize="0.003"'))
    assert "[scenario.time-grid]" in place.run("fixed", line("fixed.fmu"), verb="check").stderr
    assert place.run("fixed", line("fixed.fmu", every="6 ms", duration="60 ms"), verb="check").returncode == 0
    for file, code in (("", "scenario.missing-key"), (", file: [good.fmu]", "scenario.wrong-kind"), (", file: good.fmu, quite: 1", "scenario.unknown-key")):
        none = place.run("none", f"scene: {{duration: 1 s}}\nplants: {{lag: {{type: fmu{file}}}}}\n", verb="check")
        assert none.returncode == 2 and f"[{code}]" in none.stderr, none.stderr
        assert "[fmu.guest]" not in none.stdout + none.stderr, none.stdout  # beside what is wrong it is of no use
    assert "drycut plants good.fmu" in none.stderr, none.stderr
    print(f"refused: {len(cases)} files, all told at their place")


def failures(place):
    """What fails in the run ends it with status 3, by its plant, time and code; what was recorded is there, and what held until then
    is no verdict. Nothing of the FMU is left."""
    checks = """checks:
  - {name: early, always: lag.count < 30, until: 10 ms}
  - {name: late, always: lag.count < 30}
  - {name: never, never: lag.failed}
  - {name: once, eventually: lag.count > 5}
"""
    for version in (2, 3):
        fmu = place.fmu(f"lag{version}.fmu", version)
        for name, how, said in (("crash", CRASH, "crashed"), ("hang", HANG, "limits.time"), ("eat", EAT, "limits.memory"),
                                ("refuse", REFUSE, "cannot go on"), ("leave", LEAVE, "status 7"),
                                ("nan", NOT_A_NUMBER, "finite")):
            text = line(fmu, f"fail: {how}, fail_at: 20 ms", f", limits: {{time: {3 if how == HANG else 200} s, memory: 200}}", rest="timeline: [{at: 0 s, set: {lag.u: 1 V}}]\n" + checks)
            done = place.run(f"{name}{version}", text)
            assert done.returncode == 3, (name, done.returncode, done.stdout, done.stderr)
            told = done.stdout + done.stderr
            assert said in told and "lag at 0.021 s: " in told and "[fmu.failed]" in told, (name, told)
            assert {"fmu.failed", "run.failed"} <= set(json.loads((done.folder / "verdict.json").read_text())["codes"])
            came = {check["name"]: (check["passed"], check["so_far"]) for check in json.loads((done.folder / "checks.json").read_text())["checks"]}
            assert came == {"early": (True, False), "late": (True, True), "never": (False, False), "once": (True, False)}, came
            assert re.search("held so far late", told) and re.search("ok +early", told) and re.search("FAIL never", told), told
            assert re.search(r"^0\.0210*,lag,failed", (done.folder / "events.csv").read_text(), re.MULTILINE)
            rows = place.rows(f"{name}{version}")
            assert 200 <= len(rows) <= 212, (name, len(rows))
            assert float(rows[199]["lag.count"]) == 19
    why = subprocess.run([place.program, "why", place.there / "out" / "crash2", "--no-pictures", "--out", place.there / "why"], capture_output=True,
                         text=True)
    found = json.loads((place.there / "why" / "why.json").read_text())
    assert why.returncode == 0 and found["failed_at"] == 0.021 and "lag at 0.021 s: lag2.fmu crashed" in found["because"], (why, found)
    assert "lag2.fmu crashed" in why.stdout, why.stdout
    again = place.run("crash2", (place.there / "crash2.yaml").read_text())
    assert again.returncode == 3 and (place.there / "out" / "junit.xml").read_text().count("<skipped ") == 1
    drawn = subprocess.run([place.program, "run", place.there / "crash2.yaml", "--out", place.there / "drawn"], capture_output=True, text=True,
                           env={**os.environ, "TMPDIR": str(place.temporary)})
    page = (place.there / "drawn" / "crash2" / "report.html").read_text()
    assert drawn.returncode == 3 and page.count(">HELD SO FAR<") == 1 and page.count(">PASS<") == 2, drawn
    assert not list((place.there / "tmp").iterdir()), "folders of FMUs are left"
    print("failures: six ways, both versions, status 3, rows kept")


def ended(place):
    """A run that is killed leaves nothing of an FMU: neither its process nor its folder. A folder that is named relatively is one, too."""
    pipe = place.there / "pipe"
    os.mkfifo(pipe)
    for version, signals in ((2, (signal.SIGKILL,)), (3, (signal.SIGINT, signal.SIGTERM)), (2, (signal.SIGTERM, signal.SIGINT))):
        fmu = place.fmu(f"lag{version}.fmu", version)
        file = place.scenario("ended", line(fmu, f"fail: {HANG}, fail_at: 20 ms, label: \"{pipe}\"", ", limits: {time: 1000 s}"))
        run = subprocess.Popen([place.program, "run", file, "--no-pictures", "--out", place.there / "out"], cwd=place.there,
                               env={**os.environ, "TMPDIR": "tmp"}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        guest = os.pidfd_open(int(pipe.read_text()))  # when it hangs
        assert len(list(place.temporary.iterdir())) == 1
        for one in signals:
            run.send_signal(one)
        assert -run.wait() in signals, run.returncode
        assert select.select([guest], [], [], 60)[0], "the FMU's process lives on"
        os.close(guest)
        assert not list(place.temporary.iterdir()), (version, signals, "its folder is left")
    print("ended: by three signals, nothing is left")


def units(place):
    """A scenario gives units to variables that declare none: they are wired, recorded and set in them."""
    for version in (2, 3):
        bare = description(version).replace(UNITS, "").replace(' unit="V"', "").replace(' unit="turns a minute"', "").replace(' unit="s"', "")
        place.fmu("bare.fmu", version, xml=bare)
        text = line("bare.fmu", "time: {constant: 20 ms}", ', units: {u: "rad/s", x: mV, time.constant: ms, shaft: mm/s}',
                    channels="lag.x, lag.on, lag.count, lag.shaft, lag.u, axis.speed, axis.servo.reference",
                    rest="wiring: {lag.u: axis.speed, axis.servo.reference: lag.x}\n")
        text = text.replace("plants:\n", "plants:\n  axis: {type: rotary_axis}\n")
        without = place.run("without", text.replace('u: "rad/s", x: mV, ', ""), verb="check")
        assert without.returncode == 2 and without.stderr.count("[scenario.wrong-unit]") == 2, without.stderr
        done = place.run("units", text)
        assert done.returncode == 0, done.stdout + done.stderr
        assert re.search(r"scenario's word.* u in rad/s, x in mV, time.constant in ms", done.stdout), done.stdout
        head = (done.folder / "trace.csv").read_text().splitlines()[0]
        assert "lag.x [mV]" in head and "lag.u [rad/s]" in head and "lag.shaft [mm/s]" in head, head
        # By itself: its number of a time constant is in ms, its number of u in rad/s.
        alone = line("bare.fmu", "time: {constant: 20 ms}", ", units: {u: km/h, x: mV, time.constant: ms}",
                     rest="timeline: [{at: 0 s, set: {lag.u: 10 m/s}}]\n")
        done = place.run("alone", alone)
        assert done.returncode == 0, done.stdout + done.stderr
        x = 0.0
        for row in place.rows("alone")[10::10]:
            x += 1e-3 / 20 * (36 - x)
            assert abs(float(row["lag.x"]) - x) < 1e-12 * 36, (row, x)
        expanded = place.run("alone", alone, "--expand", verb="check")
        assert expanded.returncode == 0, expanded.stderr
        again = place.run("again", expanded.stdout)
        assert again.returncode == 0 and (again.folder / "trace.csv").read_bytes() == (done.folder / "trace.csv").read_bytes(), again.stderr
        # Declared as V, recorded as mV.
        fmu = place.fmu(f"lag{version}.fmu", version)
        text = line(fmu, "time: {constant: 10 ms}", "UNITS", rest="timeline: [{at: 0 s, set: {lag.u: 1 V}}]\n")
        assert place.run("plain", text.replace("UNITS", "")).returncode == 0
        assert place.run("milli", text.replace("UNITS", ", units: {x: mV}")).returncode == 0
        for row, other in zip(place.rows("plain"), place.rows("milli"), strict=True):
            assert abs(float(row["lag.x"]) * 1000 - float(other["lag.x"])) < 1e-9
        for given, code in (("{shaft_: mm/s}", "scenario.unknown-name"), ("{x: mm/s}", "scenario.wrong-unit"), ("{x: parsecs per lightyears}", "scenario.unknown-unit"),
                            ("{count: V}", "scenario.wrong-unit"), ("{on: V}", "scenario.wrong-unit"), ("[x]", "scenario.wrong-kind"), ("{x: [V]}", "scenario.wrong-kind"),
                            ("{x: V, x: mV}", "scenario.twice")):
            wrong = place.run("wrong", text.replace("UNITS", f", units: {given}"), verb="check")
            assert wrong.returncode == 2 and f"[{code}]" in wrong.stderr and "wrong.yaml:3:" in wrong.stderr, (given, wrong.stderr)
            assert "shaft_" not in given or "did you mean shaft?" in wrong.stderr, wrong.stderr
    web = place.run("web", "scene: {duration: 1 ms}\nplants: {web: {type: web, units: {speed: V}}}\n", verb="check")
    assert web.returncode == 2 and "[scenario.unknown-key]" in web.stderr
    print("units: given, converted, refused")


def listed(place):
    """drycut plants FILE.fmu: what an FMU has; other verbs say who takes it."""
    for version in (2, 3):
        place.fmu("lag.fmu", version, xml=description(version).replace('name="u"', 'name="u" description="what it follows"'))
        done = subprocess.run([place.program, "plants", place.there / "lag.fmu", "--json"], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        shown = json.loads(done.stdout)
        itself = {row["name"]: row["value"] for row in shown["fmu"]}
        assert itself["is"].startswith(f"FMI {version}.0, model lag") and itself["state"] == "can be kept", itself
        rows = {row["name"]: row for row in shown["variables"]}
        assert list(rows) == [row[0] for row in VARIABLES]
        for name, reference, causality, kind, start, unit in VARIABLES:
            row = rows[name]
            assert row["causality"] == causality, row
            assert row["type"] == {"real": "real", "flag": "Boolean", "whole": "whole", "text": "text"}[kind] or (kind, version) == ("whole", 3), row
            wanted = start if kind == "text" else start == "true" if kind == "flag" else float(start or 0)
            assert row.get("start") == (None if causality == "output" else wanted), row
        assert rows["u"]["unit"] == "V" and rows["u"]["meaning"] == "what it follows" and rows["time.constant"]["unit"] == "s", rows
    text = subprocess.run([place.program, "plants", place.there / "lag.fmu"], capture_output=True, text=True).stdout
    assert all(re.search(rf"^ *{re.escape(row[0])} ", text, re.MULTILINE) for row in VARIABLES), text
    (place.there / "bad.fmu").write_text("no zip")
    for file, code in (("bad.fmu", "fmu.archive"), ("none.fmu", "file.missing")):
        bad = subprocess.run([place.program, "plants", place.there / file], capture_output=True, text=True)
        assert bad.returncode == 2 and f"[{code}]" in bad.stderr, bad
    for verb in ("run", "fmu", "check", "live"):
        other = subprocess.run([place.program, verb, place.there / "lag.fmu"], capture_output=True, text=True)
        assert other.returncode == 2 and "[file.other-kind]" in other.stderr and "drycut plants" in other.stderr, (verb, other)
    print("listed: both versions")


def state(place):
    """Kept, gone on with in another process, the same bytes; refused where the FMU has none."""
    for version in (2, 3):
        fmu = place.fmu(f"lag{version}.fmu", version)
        text = line(fmu, "time: {constant: 10 ms}", rest="timeline: [{at: 1.3 ms, set: {lag.u: 1 V}}, {at: 31 ms, set: {lag.u: 2 V}}]\n", every="2 ms")
        whole = place.run(f"whole{version}", text)
        kept = place.run(f"kept{version}", text, "--states", "4.3 ms")
        assert whole.returncode == kept.returncode == 0, kept.stdout + kept.stderr
        trace = (whole.folder / "trace.csv").read_bytes()
        assert trace == (kept.folder / "trace.csv").read_bytes()
        done = subprocess.run([place.program, "run", place.there / f"kept{version}.yaml", "--from", f"{kept.folder}@0.0172 s",
                               "--no-pictures", "--out", place.there / "again"], capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
        found = list((place.there / "again").glob("*/trace.csv"))
        assert len(found) == 1 and found[0].read_bytes() == trace, found
        shutil.rmtree(place.there / "again")
        place.fmu(f"none{version}.fmu", version, xml=description(version, state=False))
        text = line(f"none{version}.fmu")
        assert place.run(f"none{version}", text).returncode == 0
        refused_ = place.run(f"none{version}", text, "--states", "10 ms")
        assert refused_.returncode == 2 and "[fmu.no-state]" in refused_.stderr and "without --states" in refused_.stderr, refused_.stderr
        refused_ = place.run(f"none{version}", text, verb="faults")
        assert refused_.returncode == 2 and "[fmu.no-state]" in refused_.stderr and "--states" not in refused_.stderr, refused_.stderr
    print("state: kept and gone on with in another process, the same bytes")


def own(place):
    """Our own machine as an FMU under the QMOVE: what the controller and the machine do is the same to the last bit."""
    example = (HOUSE / "examples" / "fmi" / "own_fmu.yaml").read_text().replace("../../scenes", str(HOUSE / "scenes"))
    channels = ["AxisX.posit", "AxisX.positm", "AxisX.follerr", "2.AN01", "knife.angle", "knife.motor.torque", "web.speed"]
    native = place.scenario("native", f"extends: {HOUSE / 'scenes' / 'rotary_knife.yaml'}\nscene: {{duration: 5 s}}\n"
                            f"record: {{every: 2 ms, channels: [{', '.join(channels)}]}}\nchecks: []\n")
    done = subprocess.run([place.program, "run", native, "--no-pictures", "--out", place.there / "out"], capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stdout + done.stderr
    wanted = place.rows("native")
    for version in (2, 3):
        subprocess.run([place.program, "fmu", native, "--fmi", str(version), "--out", place.there / "knife.fmu"], check=True,
                       capture_output=True)
        done = place.run(f"own{version}", example.replace("duration: 12 s", "duration: 5 s"))
        assert done.returncode == 0, done.stdout + done.stderr
        rows = place.rows(f"own{version}")
        assert len(rows) == len(wanted) == 2501
        for row, other in zip(rows, wanted):
            for name in channels:
                mine = name if name in row else f"machine.{name}"
                assert row[mine] == other[name], (version, other["time"], name, row[mine], other[name])
        assert float(rows[-1]["machine.knife.cut.count"]) > 2
    print("own: the knife as an FMU under the QMOVE is the knife, both versions")


def outputs_of(fmu):
    """Their types, by their names."""
    with zipfile.ZipFile(fmu) as archive:
        root = xml.fromstring(archive.read("modelDescription.xml"))
    two = root.get("fmiVersion").startswith("2")
    return {row.get("name"): (row[0] if two else row).tag for row in root.find("ModelVariables") if row.get("causality") == "output"}


def foreign(place):
    """The public reference FMUs, where DRYCUT_REFERENCE_FMUS names a folder with 2.0/*.fmu, 3.0/*.fmu, and NAME_out.csv, their
    published results."""
    folder = os.environ.get("DRYCUT_REFERENCE_FMUS")
    if not folder:
        print("DRYCUT_REFERENCE_FMUS names no folder")
        sys.exit(SKIPPED)
    for fmu in sorted(Path(folder).glob("?.0/*.fmu")):
        results = Path(folder) / f"{fmu.stem}_out.csv"
        if not results.exists():
            continue
        with open(results, newline="") as file:
            wanted = list(csv.DictReader(file))
        times = [float(row["time"]) for row in wanted]
        outputs = outputs_of(fmu)
        # Inputs, local values and texts are published, too.
        names = [name for name in wanted[0] if outputs.get(name, "String") not in ("String", "Binary", "Clock")]
        if not names:
            print(f"{fmu.stem} {fmu.parent.name}: no numbers are published")
            continue
        step = min(b - a for a, b in zip(times, times[1:]) if b > a)
        name = f"{fmu.stem}{fmu.parent.name[0]}"
        shutil.copy(fmu, place.there / f"{name}.fmu")
        text = f"""scene: {{step: {step:g} s, duration: {times[-1]:g} s}}
plants: {{m: {{type: fmu, file: {name}.fmu}}}}
record: {{every: {step:g} s, channels: [CHANNELS]}}
"""
        elements = [f"{one}[{n + 1}]" for one in names for n in range(len(wanted[0][one].split()))]  # of lists
        shown = elements if len(elements) > len(names) else names
        done = place.run(name, text.replace("CHANNELS", ", ".join(f'"m.{one}"' for one in shown)))
        assert done.returncode == 0, done.stdout + done.stderr
        rows = {round(float(row["time"]), 9): row for row in place.rows(name)}
        compared, worst = 0, 0.0
        for row in wanted:
            mine = rows.get(round(float(row["time"]), 9))
            if mine is None:
                continue
            numbers = [float({"true": 1, "false": 0}.get(cell, cell))
                       for one in names for cell in row[one].split()]
            for one, number in zip(shown, numbers, strict=True):
                worst = max(worst, abs(float(mine[f"m.{one}"]) - number) / max(1.0, abs(number)))
            compared += 1
        print(f"{fmu.stem} {fmu.parent.name}: {compared} rows of {len(wanted)}, furthest from the published ones {worst:g}")
        assert compared > 1 and worst < 1e-9, (name, compared, worst)


def main():
    program, kind = Path(sys.argv[1]).resolve(), sys.argv[2]
    with tempfile.TemporaryDirectory(prefix="guests ") as there:
        globals()[kind](Place(program, there))


if __name__ == "__main__":
    main()

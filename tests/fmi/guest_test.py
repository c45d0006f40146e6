#!/usr/bin/env python3
"""Foreign FMUs in a line: guest_test.py PROGRAM KIND. The FMU is guest.c, in both versions of the standard."""
import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile
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
        "outside": (dict(files=[("../outside", b"x")]), "fmu.archive"),
        "absolute": (dict(files=[("/tmp/outside", b"x")]), "fmu.archive"),
        "bomb": (dict(files=bomb), "fmu.archive"),
        "platform": (dict(library=b""), "fmu.refused"),
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
    place.fmu("good.fmu", 2)
    for parameters, more, code in (("gian: 2", "", "scenario.unknown-key"), ("time: {constant: 3 V}", "", "scenario.wrong-unit"),
                                   ("gain: much", "", "scenario.not-a-number"), ("fail: 7", "", "fmu.refused"),
                                   ("", ", every: 150 us", "scenario.time-grid"), ("", ", limits: {memory: 1}", "scenario.out-of-range")):
        text = line("good.fmu", parameters, more).replace(", every: 1 ms", "", 1 if "every" in more else 0)
        done = place.run("parameters", text, verb="check")
        assert done.returncode == 2 and f"[{code}]" in done.stderr, (parameters, more, done.stderr)
    place.fmu("fixed.fmu", 3, xml=description(3, more=' fixedInternalStepSize="0.003"'))
    assert "[scenario.time-grid]" in place.run("fixed", line("fixed.fmu"), verb="check").stderr
    assert place.run("fixed", line("fixed.fmu", every="6 ms", duration="60 ms"), verb="check").returncode == 0
    none = place.run("none", "scene: {duration: 1 s}\nplants: {lag: {type: fmu}}\n", verb="check")
    assert none.returncode == 2 and "[scenario.missing-key]" in none.stderr
    print(f"refused: {len(cases)} files, all told at their place")


def failures(place):
    """What fails in the run ends it with status 3; what was recorded is there. Nothing of the FMU is left."""
    for version in (2, 3):
        fmu = place.fmu(f"lag{version}.fmu", version)
        for name, how, said in (("crash", CRASH, "crashed"), ("hang", HANG, "limits.time"), ("eat", EAT, "limits.memory"),
                                ("refuse", REFUSE, "cannot go on"), ("leave", LEAVE, "status 7"),
                                ("nan", NOT_A_NUMBER, "finite")):
            text = line(fmu, f"fail: {how}, fail_at: 20 ms", f", limits: {{time: {3 if how == HANG else 200} s, memory: 200}}", rest="timeline: [{at: 0 s, set: {lag.u: 1 V}}]\n")
            done = place.run(f"{name}{version}", text)
            assert done.returncode == 3, (name, done.returncode, done.stdout, done.stderr)
            told = done.stdout + done.stderr
            assert said in told, (name, told)
            rows = place.rows(f"{name}{version}")
            assert 200 <= len(rows) <= 212, (name, len(rows))
            assert float(rows[199]["lag.count"]) == 19
    assert not list((place.there / "tmp").iterdir()), "folders of FMUs are left"
    print("failures: six ways, both versions, status 3, rows kept")


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
        assert refused_.returncode == 2 and "[fmu.no-state]" in refused_.stderr, refused_.stderr
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
        names = [name for name in wanted[0] if name != "time"]
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
            numbers = [float(cell) for one in names for cell in row[one].split()]
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

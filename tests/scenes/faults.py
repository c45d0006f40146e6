"""Every fault at every moment: what `drycut faults` finds.

Of three lines a supervision of the program is taken away: a limit of the following error (QMOVE), a watchdog (LX3VP), a
check of an encoder (PLCopen). Exactly the cells turn red that it guarded. Besides: the same bytes at any --jobs, a cell's
scenario that repeats what the cell says, cells that are accepted, what is refused.

faults.py DRYCUT [NAME...]"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"
RED = {"wrong", "damage"}


def call(drycut, folder, *arguments):
    return subprocess.run([drycut, *map(str, arguments)], cwd=folder, capture_output=True, text=True, errors="replace")


def cells_of(folder):
    with open(folder / "faults.csv", encoding="utf-8", newline="") as file:
        return {(row["fault"], row["when"]): row for row in csv.DictReader(file)}


def replaced(text, old, new):
    assert text.count(old) == 1, f"{text.count(old)} x {old!r}"
    return text.replace(old, new)


def knife_mod(watched):
    """QMOVE: an alarm where the axis follows its cam no more."""
    task = (SCENES / "programs/rotary_knife.mod").read_text(encoding="utf-8")
    configuration = (SCENES / "programs/rotary_knife.cnf").read_text(encoding="utf-8")
    configuration = replaced(configuration, "OUTPUT\n", "OUTPUT\nofAlarm     F 2.OUT03\n")
    watch = "IF gbPhase EQ 3 AND (AxisX:follerr GT 300 OR AxisX:follerr LT -300)\n    ofAlarm = 1\nENDIF\n"
    if watched:
        task = replaced(task, "WAIT 1\nJUMP MAIN", watch + "WAIT 1\nJUMP MAIN")
    return {"knife.cnf": configuration, "knife.mod": task, "line.yaml": f"""extends: {SCENES}/rotary_knife.yaml
controller: {{qmove: {{configuration: knife.cnf, tasks: [knife.mod]}}}}
wiring: {{2.OUT03: panel.alarm}}
faults: {{told: panel.alarm == 1}}
"""}


def knife_il(watched):
    """LX3VP: a watchdog, which the home switch of the drum sets back once a turn."""
    program = (SCENES / "programs/rotary_knife.il").read_text(encoding="utf-8")
    watch = "LD M12\nANI X10\nOUT T0 K20\nLD M12\nAND X10\nOUT T1 K20\nLD T0\nOR T1\nSET Y21\n"
    if watched:
        program = replaced(program, "\nEND\n", f"\n{watch}END\n")
    return {"knife.il": program, "line.yaml": f"""extends: {SCENES}/rotary_knife_lx3vp.yaml
controller: {{lx3vp: {{program: knife.il}}}}
wiring: {{X10: knife.home, Y21: panel.alarm}}
faults: {{told: panel.alarm == 1, within: 2.5 s}}
"""}


def knife_st(watched):
    """PLCopen: a web that ran and seems to stand is an encoder that is broken."""
    program = (SCENES / "programs/rotary_knife.st").read_text(encoding="utf-8")
    program = replaced(program, "  couple : BOOL; ", "  runs : BOOL;\n  couple : BOOL; ")
    watch = "runs := state = Running AND (runs OR ABS(WebSpeed.Velocity) > 1_000_000.0);\nIF runs AND web_stands THEN failure := 1; END_IF\n"
    if watched:
        program = replaced(program, "failure := Register.failure;\n", "failure := Register.failure;\n" + watch)
    return {"knife.st": program, "line.yaml": f"""extends: {SCENES}/rotary_knife_mc_camin.yaml
controller: {{plcopen: {{program: knife.st}}}}
faults: {{told: panel.fault == 1}}
"""}


# What each guards, wholly or in part.
LINES = {
    "following_error_limit": (knife_mod, {"knife.servo.disabled", "wire.2.AN01.cut"}),
    "watchdog": (knife_il, {"knife.servo.disabled"}),
    "encoder_check": (knife_st, {"web.wheel.stuck", "wire.Web.encoder.cut"}),
}


def supervision(drycut, place, name):
    """What is wrong, a line each."""
    write, wanted = LINES[name]
    came = {}
    for watched in (True, False):
        folder = place / f"{name}_{watched}"
        folder.mkdir()
        for file, text in write(watched).items():
            (folder / file).write_text(text, encoding="utf-8")
        done = call(drycut, folder, "faults", "line.yaml", "--moments", 5, "--jobs", 2)
        if done.returncode not in (0, 1):
            return [f"{name}: status {done.returncode}: {done.stdout}{done.stderr}"]
        came[watched] = cells_of(folder / "out/faults")
    with_it, without = came[True], came[False]
    wrong = []
    if with_it.keys() != without.keys():
        wrong.append(f"{name}: other cells")
    guarded = {key for key in without if without[key]["cell"] in RED and with_it[key]["cell"] not in RED}
    for key, cell in with_it.items():
        other = without[key]
        if key in guarded:
            if cell["cell"] != "told":
                wrong.append(f"{name}: {key} is {cell['cell']} though nobody tells")
        elif cell["cell"] != other["cell"] and (cell["cell"], other["cell"]) != ("told", "unharmed"):
            wrong.append(f"{name}: {key} is {cell['cell']} with the supervision, {other['cell']} without")
    faults = {fault for fault, _ in guarded}
    print(f"{name}: {len(without)} cells, {len(guarded)} guarded: {', '.join(sorted(faults))}", flush=True)
    if not wanted <= faults:
        wrong.append(f"{name}: it does not guard {wanted - faults}")
    return wrong


def same_bytes(drycut, place, name="same_bytes"):
    """At any --jobs, and where it goes on; a worker's line has nothing left of the cells before."""
    wrong = []
    scene = SCENES / "rotary_knife.yaml"
    options = ["--moments", 3, "--only", "knife.encoder.*", "--only", "wire.*", "--at-events"]
    for jobs in (1, 3):
        call(drycut, place, "faults", scene, *options, "--jobs", jobs, "--out", f"jobs_{jobs}")
    for file in ("faults.csv", "junit.xml", "verdict.json", "report.html"):
        if (place / "jobs_1" / file).read_bytes() != (place / "jobs_3" / file).read_bytes():
            wrong.append(f"{name}: {file} depends on --jobs")
    before = (place / "jobs_1/faults.csv").read_bytes()
    again = call(drycut, place, "faults", scene, *options, "--out", "jobs_1")
    if "\n0 cells simulated now" not in again.stdout or (place / "jobs_1/faults.csv").read_bytes() != before:
        wrong.append(f"{name}: what was there is tried again: {again.stdout}")
    verdict = json.loads((place / "jobs_1/verdict.json").read_text(encoding="utf-8"))
    if verdict["counts"]["cells"] != len(cells_of(place / "jobs_1")) or verdict["kind"] != "faults":
        wrong.append(f"{name}: {verdict}")
    return wrong


def repeated(drycut, place, name="repeated"):
    """A red cell's scenario does from zero what its branch did: the same check fails, as many pieces are cut."""
    wrong = []
    for scene, options in (("rotary_knife", ["--set", "plants.web.thickness=0.4 mm"]), ("flying_saw", [])):
        out = place / scene
        call(drycut, place, "faults", SCENES / f"{scene}.yaml", "--moments", 2, "--only", "*.encoder.lose_counts", "--out", out,
             *options)
        cells = cells_of(out)
        files = sorted((out / "cells").glob("*.yaml"))
        if not files:
            wrong.append(f"{name}: no cell's scenario of {scene}")
        for file in files:
            fault, when = file.stem.rsplit("_", 1)
            cell = cells[fault, when + " %"]
            done = call(drycut, place, "run", file, "--no-pictures", "--out", "again")
            if done.returncode != 1 or f"FAIL {cell['harm']}" not in done.stdout:
                wrong.append(f"{name}: {file.name} does not fail {cell['harm']}: {done.stdout}{done.stderr}")
                continue
            with open(place / "again" / file.stem / "events.csv", encoding="utf-8", newline="") as events:
                cuts = [row for row in csv.DictReader(events)
                        if row["event"] == "cut" and float(row["time [s]"]) > float(cell["at [s]"])]
            if len(cuts) != int(cell["cuts"]):
                wrong.append(f"{name}: {len(cuts)} cuts of {file.name}, the cell has {cell['cuts']}")
    return wrong


def accepted(drycut, place, name="accepted"):
    wrong = []
    options = ["faults", SCENES / "rotary_knife.yaml", "--moments", 2, "--only", "knife.encoder.lose_counts"]
    first = call(drycut, place, *options, "--out", "open")
    if first.returncode != 1:
        wrong.append(f"{name}: status {first.returncode}: {first.stdout}{first.stderr}")
    (place / "cells.yaml").write_text("- {fault: knife.encoder.lose_counts, when: 0..100 %, cell: wrong, why: known}\n"
                                      "- {fault: none, when: \"*\", cell: wrong, why: gone}\n", encoding="utf-8")
    second = call(drycut, place, *options, "--out", "open", "--accept", "cells.yaml")
    if second.returncode != 0 or "[faults.accepts-nothing]" not in second.stdout:
        wrong.append(f"{name}: status {second.returncode}: {second.stdout}{second.stderr}")
    if {row["accepted"] for row in cells_of(place / "open").values()} != {"known"}:
        wrong.append(f"{name}: not told in faults.csv")
    for arguments, code in ((["--only", "nothing.*"], "study.unknown-name"), (["--moments", 9999999], ""),
                            (["--set", "faults.product=[no such]"], "scenario.unknown-name"),
                            (["--set", "faults.told=panel.nothing == 1"], "expression.unknown-name")):
        bad = call(drycut, place, "faults", SCENES / "rotary_knife.yaml", *arguments, "--out", "bad")
        if bad.returncode != 2 or code not in bad.stderr or (place / "bad").exists():
            wrong.append(f"{name}: {arguments}: status {bad.returncode}: {bad.stderr}")
    none = call(drycut, place, "faults", SCENES / "press_learning.yaml", "--out", "bad")
    if none.returncode != 2 or "faults.no-product" not in none.stderr:
        wrong.append(f"{name}: no product: status {none.returncode}: {none.stderr}")
    return wrong


def main():
    drycut = str(pathlib.Path(sys.argv[1]).resolve())
    parts = {**{name: supervision for name in LINES}, "same_bytes": same_bytes, "repeated": repeated, "accepted": accepted}
    wrong = []
    for name in sys.argv[2:] or parts:
        with tempfile.TemporaryDirectory() as folder:
            wrong += parts[name](drycut, pathlib.Path(folder), name)
    for line in wrong:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

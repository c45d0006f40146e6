"""Every line that `drycut new` makes, through the commands that its user comes to: new, check, run, design and the
designed scenario, cam, envelope, size. What drycut writes, it takes; what it prints as a command runs as it stands.

new_lines_matrix.py DRYCUT [MACHINE/CONTROLLER...]: all lines unless some are named."""

import html
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

DRYCUT = str(pathlib.Path(sys.argv[1]).resolve())
DEVICES = {"qmove": "camming4", "lx3vp": "lx3vp", "plcopen": "mc_camin"}
KNIFE = ["rotary_knife", "--circumference", "600 mm", "--speed", "60 m/min"]
CUT = ("rotary_knife", "flying_saw")  # by a cam; the others are positioned
SAW = ["flying_saw", "--speed", "34 m/min"]
COMMAND = re.compile(r"drycut (?:run|cam|check|design|envelope|size|sweep|tune|bode|edit) [^\n]*")


def call(folder, arguments, codes=(0,)):
    """What it prints; a status that is not among `codes` ends the test."""
    done = subprocess.run(
        [DRYCUT, *arguments], cwd=folder, capture_output=True, text=True, errors="replace",
        env={**os.environ, "COLUMNS": "200"},
    )
    if done.returncode not in codes:
        sys.exit(f"{folder}: drycut {shlex.join(arguments)}: status {done.returncode}, not {codes}\n{done.stdout}{done.stderr}")
    return done.stdout


def run_again(folder, text, codes=(0,)):
    """Runs the commands that a text names, as they stand."""
    commands = sorted(set(COMMAND.findall(text)))
    for command in commands:
        words = shlex.split(command)[1:]
        call(folder, words + (["--no-pictures"] if words[0] == "run" else []), codes)
    return commands


def jobs(machine, controller):
    """A name, the job's options, and the ending of its table."""
    endings = [".csv", ".tab"] if controller == "plcopen" else [".csv"]
    if machine == "rotary_knife":
        for ending in endings:
            yield "same" + ending[1:], [*KNIFE, "--length", "800 mm", "--sync", "120 mm"], ending
        for goal in ["peak", "jerk"]:
            yield goal, [*KNIFE, "--length", "800 mm", "--sync", "120 mm", "--minimise", goal], ".csv"
        yield "longer", [*KNIFE, "--length", "1.2 m", "--sync", "100 mm"], ".csv"
        yield "shorter", [*KNIFE, "--length", "700 mm", "--sync", "80 mm"], ".csv"
        yield "turn", [*KNIFE, "--length", "600 mm", "--sync", "120 mm"], ".csv"
        yield "limits", [*KNIFE, "--length", "800 mm", "--sync", "120 mm", "--max-acceleration", "5 m/s2"], ".csv"
        if controller != "qmove":
            slow = ["rotary_knife", "--circumference", "600 mm", "--speed", "40 m/min"]
            yield "swing", [*slow, "--length", "800 mm", "--thickness", "0.5 mm"], endings[-1]
    else:
        for ending in endings:
            yield "same" + ending[1:], [*SAW, "--length", "1 m", "--sync", "270 mm"], ending
        for goal in ["peak", "jerk"]:
            yield goal, [*SAW, "--length", "1 m", "--sync", "270 mm", "--minimise", goal], ".csv"
        yield "longer", [*SAW, "--length", "1.2 m", "--sync", "300 mm"], ".csv"
        yield "travel", [*SAW, "--length", "1 m", "--sync", "270 mm", "--max-travel", "365 mm"], ".csv"


def design(folder, machine, controller):
    for name, job, ending in jobs(machine, controller):
        wanted = ["design", *job, "--device", DEVICES[controller], "--table", name + ending, "--scene", "line.yaml"]
        printed = call(folder, wanted)
        assert run_again(folder, printed), printed
        call(folder, ["cam", name + ending])
        call(folder, ["check", name + ending, name + ".yaml"])
        call(folder, ["run", name + ".yaml", "--no-pictures"])


def refuses_cams(folder):
    """A positioner plays no cam: design says so, whichever device is asked for, and writes nothing."""
    for device in DEVICES.values():
        wanted = ["design", *SAW, "--length", "1 m", "--sync", "270 mm", "--device", device, "--table", "cam.csv"]
        done = subprocess.run([DRYCUT, *wanted, "--scene", "line.yaml"], cwd=folder, capture_output=True, text=True)
        assert done.returncode == 2 and "plays no cam" in done.stderr, done.stderr
        assert not (folder / "cam.csv").exists()


def pages(folder):
    return "\n".join(html.unescape(page.read_text(encoding="utf-8")) for page in sorted(folder.glob("out/*/report.html")))


def commands_of(page):
    """Those that a page shows to be copied."""
    return "\n".join(re.findall(r"<pre>(drycut [^<]*)</pre>", page))


def studies(folder, machine, controller):
    cuts = machine in CUT
    if machine == "length_stop":
        over, find = "variables.length=200..400 mm:2", "variables.step=40..60 mm:10"
    elif not cuts:
        over, find = "variables.tours=1..2:2", "variables.load=0..200 kg:100"
    else:
        over, find = "variables.length=900..1100 mm:2", "variables.speed=20..60 m/min:20"
    printed = call(folder, ["envelope", "line.yaml", "--over", over, "--find-max", find])
    run_again(folder, printed)
    if machine == "length_stop":
        choice = ["--motors", "IEC*" if controller == "lx3vp" else "HG-SR[12]*"]
    elif not cuts:
        choice = ["--motors", "IEC*", "--set", "drives.cycle=12 s"]
    else:
        choice = ["--motors", "HG-SR[12]*", "--gears", "4,5"]
    printed = call(folder, ["size", "line.yaml", *choice], (0, 1))
    run_again(folder, printed)
    run_again(folder, commands_of(pages(folder)), (0, 1))  # the envelope's is the first that fails


def walk(root, machine, controller):
    printed = call(root, ["new", f"{machine}_{controller}", "--from", machine, "--controller", controller])
    folder = root / f"{machine}_{controller}"
    call(folder, ["check", "line.yaml"])
    command = shlex.split(printed.split("Run it: ")[1])
    subprocess.run([*command, "--no-pictures"], cwd=root, check=True, stdout=subprocess.DEVNULL)
    for table in sorted(folder.glob("cams/*")):
        for where, name in [(folder, table.relative_to(folder)), (table.parent, table.name), (root, table)]:
            assert "with the values of" in call(where, ["cam", str(name)])
        call(folder, ["check", str(table.relative_to(folder))])
    if machine in CUT:
        design(folder, machine, controller)
    else:
        refuses_cams(folder)
    studies(folder, machine, controller)


def main():
    lines = ["/".join(line.split()[:2]) for line in call(".", ["new", "--list"]).splitlines()]
    chosen = sys.argv[2:] or lines
    assert lines and set(chosen) <= set(lines), lines
    with tempfile.TemporaryDirectory() as root:
        for line in chosen:
            walk(pathlib.Path(root), *line.split("/"))
            print(f"{line}: all that is written runs", flush=True)


if __name__ == "__main__":
    main()

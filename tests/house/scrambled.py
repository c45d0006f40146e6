#!/usr/bin/env python3
"""No word steers: a build whose texts for people have lost their words (DRYCUT_SCRAMBLE) comes to the same as the
plain one: exit statuses, codes and places of problems, verdicts, margins and codes of findings in checks.json, channels and
numbers of the traces, the columns of studies and their rows, the entries of the index.

scrambled.py DRYCUT --build FOLDER [SCENE...]: builds it into FOLDER first; all of scenes/ unless some are named, files
that are refused, and a study of each kind. scrambled.py DRYCUT --against SCRAMBLED: it is built already."""

import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HOUSE = pathlib.Path(__file__).resolve().parents[2]
SCENES = HOUSE / "scenes"
BAD = HOUSE / "tests/scenes/bad"
CODE = re.compile(r"\[([a-z0-9]+\.[a-z0-9-]+)\]$")
# Of checks.json: what is data. The rest is for people.
CHECK = ["name", "passed", "margin", "unit", "at", "failed_at", "used", "tolerances", "names", "idle", "too_few", "deadline"]

STUDIES = {
    "sweep": ["sweep", "scenes/rotary_knife_mc_camin.yaml", "--over", "plants.web.speed=40..60 m/min:2", "--out"],
    "envelope": ["envelope", "scenes/envelope/rotary_knife_camming4.yaml", "--over", "variables.length=800..1000 mm:2",
                 "--find-max", "variables.speed=20..200 m/min:40", "--out"],
    "tune": ["tune", "scenes/rotary_knife.yaml", "--minimise", "rms(AxisX.follerr)", "--vary",
             "controller.qmove.set.AxisX.pgain=1..100", "--budget", "12", "--out"],
    "bode": ["bode", "scenes/rotary_knife.yaml", "--min-phase-margin", "45", "--points", "4", "--out"],
    "design": ["design", "rotary_knife", "--length", "800 mm", "--circumference", "600 mm", "--out"],
}


def build(folder):
    """The scrambled program, without what it is not asked for."""
    subprocess.run(["cmake", "-S", HOUSE, "-B", folder, "-DDRYCUT_SCRAMBLE=ON", "-DCMAKE_BUILD_TYPE=Release",
                    "-DBUILD_TESTING=OFF", "-DDRYCUT_PYTHON=OFF"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder, "--target", "drycut", "--parallel",
                    str(os.cpu_count())], check=True, stdout=subprocess.DEVNULL)
    return folder / "drycut"


def call(drycut, arguments):
    done = subprocess.run([drycut, *map(str, arguments)], cwd=HOUSE, capture_output=True, text=True, errors="replace",
                          env={**os.environ, "COLUMNS": "200"})
    codes = [found.group(1) for line in (done.stdout + done.stderr).splitlines() if (found := CODE.search(line))]
    return {"status": done.returncode, "codes": codes}


def of_checks(file):
    got = json.loads(file.read_text(encoding="utf-8"))
    return {"passed": got.get("passed"),
            "checks": [{key: check.get(key) for key in CHECK} for check in got.get("checks", [])],
            "findings": [[one["role"], one["code"]] for one in got.get("findings", [])],
            "drives": [[drive["name"], drive["holds"], drive["figures"]] for drive in got.get("drives", [])]}


def facts(folder):
    """What a folder says, without what is said to people."""
    found = {}
    for file in sorted(folder.rglob("*")):
        name = str(file.relative_to(folder))
        if file.name == "checks.json":
            found[name] = of_checks(file)
        elif file.name == "trace.csv":
            found[name] = file.read_bytes()
        elif file.name == "verdict.json":
            got = json.loads(file.read_text(encoding="utf-8"))
            found[name] = {key: got.get(key) for key in ("format", "kind", "verdict", "exit", "codes", "counts", "files")}
        elif file.suffix == ".csv" and file.name != "events.csv":
            with file.open(encoding="utf-8", newline="") as lines:
                found[name] = [len(row) for row in csv.reader(lines)]
        elif file.name == "index.html":  # one link an entry, in its order
            found[name] = re.findall(r'href="([^"]+\.html)"', file.read_text(encoding="utf-8"))
        elif file.is_file():
            found[name] = "there"
    return found


def compare(name, arguments, programs, place):
    """What is not the same of a command; its last argument is --out, if it writes."""
    results = []
    for number, program in enumerate(programs):
        out = place / f"{name}_{number}"
        writes = arguments[-1] == "--out"
        told = call(program, [*arguments, *([out] if writes else [])])
        if writes and out.is_dir():
            told["index"] = call(program, ["index", out])["status"]
            told["files"] = facts(out)
        results.append(told)
    plain, scrambled = results
    wrong = [f"{key}: {plain[key]} and {scrambled.get(key)}" for key in plain if key != "files" and plain[key] != scrambled.get(key)]
    files = plain.get("files", {}), scrambled.get("files", {})
    wrong += [f"{file}: {str(files[0].get(file))[:300]} and {str(files[1].get(file))[:300]}"
              for file in sorted(files[0].keys() | files[1].keys()) if files[0].get(file) != files[1].get(file)]
    return [f"{name}: {line}" for line in wrong]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drycut", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--build", type=pathlib.Path)
    parser.add_argument("--against", type=pathlib.Path)
    asked = parser.parse_args()
    programs = (asked.drycut.resolve(), (asked.against or build(asked.build)).resolve())

    scenes = asked.scenes or [str(file.relative_to(SCENES).with_suffix("")) for file in sorted(SCENES.glob("**/*.yaml"))
                              if "catalogue" not in file.parts]
    jobs = {f"run_{scene.replace('/', '_')}": ["run", SCENES / f"{scene}.yaml", "--no-pictures", "--out"] for scene in scenes}
    if not asked.scenes:
        jobs |= STUDIES
        jobs |= {f"check_{file.name}": ["check", *([BAD / "good.cnf"] if file.suffix == ".mod" else []), file]
                 for file in sorted(BAD.iterdir()) if file.suffix != ".expect"}
        jobs |= {f"cam_{file.name}": ["cam", file] for file in sorted((SCENES / "cams").glob("*.csv"))}
    with tempfile.TemporaryDirectory() as place, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        told = pool.map(lambda job: compare(*job, programs, pathlib.Path(place)), jobs.items())
        wrong = [line for lines in told for line in lines]
    for line in wrong:
        print(line)
    print(f"{len(jobs)} commands, {len(wrong)} differences")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()

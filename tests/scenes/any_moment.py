"""Any moment again: a run that was kept, stopped and resumed in another process leaves the same folder as the run in one
piece, whatever it was doing at that moment.

any_moment.py DRYCUT [--moments N] [--pictures] [--format csv|hdf5] [SCENE...]: all of scenes/ unless some are named. Of
each, moments drawn by its name; a moment every 37 ms is kept, so that they lie anywhere in the cycles of machines and
tasks. Scenes that compare have no folder of their own to resume."""

import argparse
import concurrent.futures
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"


def call(drycut, place, *arguments):
    # From a folder of its own, below which no scene lies: who resumes a run tells its scenario by the whole path, as
    # `check` does.
    done = subprocess.run([drycut, *map(str, arguments)], capture_output=True, text=True, errors="replace", cwd=place)
    if done.returncode not in (0, 1, 3):
        raise RuntimeError(f"status {done.returncode} of {' '.join(map(str, arguments))}: {done.stdout}{done.stderr}")
    return done


def content(folder):
    """The files but the states themselves; verdict.json, which lists files, without those."""
    files = {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*")
             if file.is_file() and file.parent.name != "states" and not file.name.startswith(".drycut")}
    verdict = json.loads(files["verdict.json"])
    verdict["files"] = [name for name in verdict["files"] if not name.startswith("states/")]
    files["verdict.json"] = json.dumps(verdict)
    return files


def check(drycut, scene, options):
    """What is wrong, a line each, and the sizes of states."""
    file = SCENES / f"{scene}.yaml"
    name = file.stem
    run = [*(() if options.pictures else ("--no-pictures",))]
    wrong, sizes = [], []
    with tempfile.TemporaryDirectory() as place:
        place = pathlib.Path(place)
        try:
            begun = ["run", file, "--set", f"record.format={options.format}", *run]
            call(drycut, place, *begun, "--out", place / "alone")
            wanted = content(place / "alone" / name)
            whole = call(drycut, place, *begun, "--states", "37 ms", "--keep", "100000", "--out", place / "whole")
            if content(place / "whole" / name) != wanted:
                wrong.append(f"{scene}: to keep states changes the run")
            states = sorted((place / "whole" / name / "states").glob("*.state"))
            if not states:
                return [f"{scene}: no state: {whole.stdout}"], []
            sizes = [state.stat().st_size for state in states]
            draw = random.Random(scene)
            for state in draw.sample(states, min(options.moments, len(states))):
                again = place / "again"
                shutil.copytree(place / "whole", again)
                for later in states:
                    if later.name > state.name:
                        (again / name / "states" / later.name).unlink()
                call(drycut, place, "run", "--resume", again / name, *run)
                got = content(again / name)
                other = sorted(key for key in wanted.keys() | got.keys() if wanted.get(key) != got.get(key))
                if other:
                    wrong.append(f"{scene}: from {state.stem} s on another {', '.join(other)}")
                shutil.rmtree(again)
        except RuntimeError as why:
            wrong.append(f"{scene}: {why}")
    return wrong, sizes


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("drycut")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--moments", type=int, default=3)
    parser.add_argument("--pictures", action="store_true")
    parser.add_argument("--format", default="csv")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_intermixed_args()
    drycut = pathlib.Path(options.drycut).resolve()
    scenes = options.scenes or sorted(
        file.stem for file in SCENES.glob("*.yaml")
        if "compare:" not in file.read_text(encoding="utf-8").split("\n"))
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for scene, (wrong, sizes) in zip(scenes, pool.map(lambda scene: check(drycut, scene, options), scenes)):
            for line in wrong:
                print(line)
            failed += bool(wrong)
            if sizes:
                print(f"{scene}: states of {min(sizes)} to {max(sizes)} bytes", flush=True)
    print(f"{len(scenes) - failed} of {len(scenes)} scenes go on from any moment as if nothing had been between")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

"""Whoever runs a scenario leaves the same folder: the command line, a hit of its cache, a session that is replayed, Python.
The folders have the same files with the same bytes.

same_folder.py DRYCUT [--pictures] [SCENE...]: in both formats of records; all of scenes/ unless some are named; with
--pictures they are drawn, too. Scenes that compare have no session, and Python does not run them."""

import argparse
import concurrent.futures
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import drycut as package
except ImportError as why:
    print(f"skipped: the Python package is not built ({why})")
    sys.exit(77)

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"


def call(drycut, *arguments):
    done = subprocess.run([drycut, *map(str, arguments)], capture_output=True, text=True, errors="replace",
                          env={**os.environ, "COLUMNS": "200"})
    if done.returncode not in (0, 1, 3):  # passed, a check failed, it stopped
        raise RuntimeError(f"status {done.returncode} of {' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


def content(folder):
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def difference(wanted, got):
    """What a reader should know of two folders that are not equal; "" where they are."""
    lines = [f"no {name}" for name in sorted(wanted.keys() - got.keys())]
    lines += [f"{name} that the command line did not leave" for name in sorted(got.keys() - wanted.keys())]
    lines += [f"another {name}" for name in sorted(wanted.keys() & got.keys()) if wanted[name] != got[name]]
    return ", ".join(lines)


def fronts(drycut, scene, form, pictures, place):
    """The folders that they leave, and what is wrong besides."""
    file, name = SCENES / f"{scene}.yaml", pathlib.Path(scene).name
    options = ["--set", f"record.format={form}", *([] if pictures else ["--no-pictures"])]
    told = call(drycut, "run", file, *options, "--out", place / "line")
    yield "the command line", place / "line" / name
    call(drycut, "run", file, *options, "--cache", place / "cache", "--out", place / "filled")
    yield "the run that the cache keeps", place / "filled" / name
    kept = call(drycut, "run", file, *options, "--cache", place / "cache", "--out", place / "kept")
    if "STOPPED" not in told and "unchanged" not in kept:
        raise RuntimeError(f"the cache has not kept it: {kept}")
    yield "the cache", place / "kept" / name
    if "compare:" in file.read_text(encoding="utf-8").split("\n"):
        return
    ran = package.run(file, {"record.format": form}, out=place / "python" / name, pictures=pictures)
    yield "Python", place / "python" / name
    if "STOPPED" in told:
        return  # a session of it ends where it stopped
    session = place / f"{name}.yaml"
    session.write_text(f"- {{scenario: {file}, set: [record.format={form}], fingerprint: 0}}\n"
                       f"- {{reached: {round(ran.outcome['end'] * 1e9)} ns}}\n", encoding="utf-8")
    call(drycut, "replay", session, *options[2:], "--out", place / "replay")
    yield "the replay", place / "replay" / name


def check(drycut, scene, form, pictures):
    with tempfile.TemporaryDirectory() as place:
        wanted, wrong = None, []
        try:
            for front, folder in fronts(drycut, scene, form, pictures, pathlib.Path(place)):
                got = content(folder)
                wanted = wanted or got
                if got != wanted:
                    wrong.append(f"{scene}, {form}: {front} left {difference(wanted, got)}")
            if not any(file.endswith("trace.h5" if form == "hdf5" else "trace.csv") for file in wanted):
                wrong.append(f"{scene}, {form}: the command line left only {', '.join(wanted)}")
        except (RuntimeError, package.BadInput) as why:
            wrong.append(f"{scene}, {form}: {why}")
        return wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("drycut")
    parser.add_argument("--pictures", action="store_true")
    parser.add_argument("scenes", nargs="*")
    asked = parser.parse_intermixed_args()
    scenes = asked.scenes or sorted(file.stem for file in SCENES.glob("*.yaml"))
    cases = [(scene, form) for scene in scenes for form in ("csv", "hdf5")]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        wrong = [line for lines in pool.map(lambda case: check(asked.drycut, *case, asked.pictures), cases) for line in lines]
    print("\n".join(wrong) or f"{len(scenes)} scenes in both formats: the same folder from every front")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

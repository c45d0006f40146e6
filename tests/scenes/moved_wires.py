"""What the checks of a line see: each of its wires cut, each swapped with another of its kind, each fault of its machines
(an encoder that counts the other way among them) in mid-run or, where that is not seen, from the start. A variation is seen
where the run fails, warns, is refused or stops. What is not seen is listed; it has to stand in docs/faults.md with its
reason, or the test fails; so it does where a reason there is one for nothing.

moved_wires.py DRYCUT [--some N] [SCENE...]: all scenes that have a controller and all lines of `drycut new` unless some
are named (flying_saw, new/flying_saw_lx3vp); --some: every Nth variation only."""

import argparse
import concurrent.futures
import fnmatch
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
REFUSED, FAILED, WARNED, SILENT = "refused", "failed", "warned", "silent"


def call(drycut, arguments, folder):
    return subprocess.run([drycut, *arguments], cwd=folder, capture_output=True, text=True, errors="replace",
                          env={**os.environ, "COLUMNS": "200"})


def block(text, key):
    """Lines of a section of an expanded scenario, and where they begin and end."""
    lines = text.split("\n")
    begin = next((i for i, line in enumerate(lines) if line.startswith(key + ":")), None)
    if begin is None:
        return lines, 0, 0
    end = begin + 1
    while end < len(lines) and lines[end].startswith(" "):
        end += 1
    return lines, begin + 1, end


def kind_of(terminal):
    return re.sub(r"\d+$", "", terminal.split(".")[-1] if "." in terminal else terminal).upper()


def wires_of(text):
    lines, begin, end = block(text, "wiring")
    return [tuple(part.strip() for part in line.split(": ", 1)) for line in lines[begin:end] if ": " in line]


def with_wires(text, wires):
    lines, begin, end = block(text, "wiring")
    return "\n".join(lines[:begin] + [f"  {terminal}: {plug}" for terminal, plug in wires] + lines[end:])


def with_fault(text, at, where, what, value):
    lines, begin, _ = block(text, "timeline")
    entry = f"  - {{at: {at} s, fault: {{{where}: {{{what}: {value}}}}}}}"
    if begin == 0:
        return text + "\ntimeline:\n" + entry + "\n"
    lines[begin - 1] = "timeline:"
    return "\n".join(lines[:begin] + [entry] + lines[begin:])


def machines_of(text):
    """Names of plants and their types."""
    lines, begin, end = block(text, "plants")
    name = None
    for line in lines[begin:end]:
        if match := re.match(r"  (\w+):$", line):
            name = match[1]
        elif match := re.match(r"    type: (\w+)$", line):
            yield name, match[1]


def duration_of(text):
    number, unit = re.search(r"^  duration: ([\d.e+-]+) (\w+)$", text, re.M).groups()
    return float(number) * {"s": 1, "ms": 1e-3}[unit]


def variations(drycut, text):
    wires = wires_of(text)
    for i, (terminal, plug) in enumerate(wires):
        yield f"cut {terminal}", [with_wires(text, wires[:i] + wires[i + 1:])]
        for j in range(i + 1, len(wires)):
            if kind_of(wires[j][0]) != kind_of(terminal):
                continue
            moved = list(wires)
            moved[i], moved[j] = (terminal, wires[j][1]), (wires[j][0], plug)
            yield f"swapped {terminal}, {wires[j][0]}", [with_wires(text, moved)]
    moments = [round(0.55 * duration_of(text), 3), 0]
    wired = [plug for _, plug in wires]
    for name, kind in machines_of(text):
        machine = json.loads(call(drycut, ["plants", kind, "--json"], SOURCE).stdout)
        plugs = [plug["name"] for plug in machine.get("ports", [])]
        for fault in machine.get("faults", []):
            where, what = f"{name}.{fault['component']}", fault["name"]
            value = f"{fault['strong']} {fault['unit']}".strip() if fault["strong"] else None  # alone it does nothing
            # What nothing is wired to may do what it likes.
            is_open = fault["component"] in plugs and not any(plug == where or plug.startswith(where + ".") for plug in wired)
            if value is not None and not is_open:
                yield f"{where} {what}", [with_fault(text, at, where, what, value) for at in moments]


def judged(done):
    """How a run saw it; None where the machine does not have such a fault."""
    if done.returncode == 2:
        return None if "offers no fault" in done.stderr else REFUSED
    if done.returncode:
        return FAILED
    return WARNED if "\n  warning " in done.stdout else SILENT


def expected_silent():
    """The rows of docs/faults.md: patterns of scenes and of variations."""
    rows = []
    inside = False
    for line in (SOURCE / "docs/faults.md").read_text(encoding="utf-8").split("\n"):
        if line.startswith("## "):
            inside = line == "## What the shipped lines do not see"
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if inside and len(cells) == 3 and cells[0].startswith("`"):
            rows.append([[part.strip(" `") for part in cell.split("`, `")] for cell in cells[:2]])
    return rows


def is_expected(rows, scene, what, used):
    """Whether a row explains it; used gathers the patterns that did, each with the number of its row."""
    found = set()
    for row, kinds in enumerate(rows):
        matching = [[one for one in patterns if fnmatch.fnmatch(name, one)] for name, patterns in zip((scene, what), kinds)]
        if all(matching):
            found |= {(row, one) for patterns in matching for one in patterns}
    used |= found
    return bool(found)


def stand(drycut, root):
    """Folders in which changed scenarios find their files: scene and file by name."""
    scenes = {}
    shipped = root / "scenes"
    shipped.mkdir()
    for entry in (SOURCE / "scenes").iterdir():
        (shipped / entry.name).symlink_to(entry)
        if entry.suffix == ".yaml":
            scenes[entry.stem] = shipped / entry.name
    for line in call(drycut, ["new", "--list"], root).stdout.splitlines():
        machine, controller = line.split()[:2]
        made = root / f"{machine}_{controller}"
        call(drycut, ["new", str(made), "--from", machine, "--controller", controller], root)
        scenes[f"new/{machine}_{controller}"] = made / "line.yaml"
    return scenes


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("drycut")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--some", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--least", type=float, default=95)
    options = parser.parse_intermixed_args()
    drycut = str(pathlib.Path(options.drycut).resolve())
    rows = expected_silent()
    used = set()
    bad = []
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        root = pathlib.Path(folder)
        found = stand(drycut, root)
        unknown = set(options.scenes) - set(found)
        if unknown:
            sys.exit(f"no scene {', '.join(sorted(unknown))}")
        for scene in options.scenes or sorted(found):
            file = found[scene]
            text = call(drycut, ["check", "--expand", str(file)], root).stdout
            if "\nwiring:\n" not in text or "\ncontroller:\n" not in text:
                continue

            def play(variation, file=file, scene=scene):
                number, (what, texts) = variation
                own = file.parent / f"changed_{number}.yaml"
                seen = SILENT
                for changed in texts:
                    own.write_text(changed, encoding="utf-8")
                    seen = judged(call(drycut, ["run", str(own), "--no-pictures", "--out", str(root / f"out_{number}")], root))
                    own.unlink()
                    if seen != SILENT:
                        break
                return what, seen

            _, sound = play((0, ("nothing", [text])))
            if sound != SILENT:
                bad.append(f"{scene}: unchanged it is {sound}")
            tried = list(enumerate(variations(drycut, text), 1))[:: options.some]
            results = [(what, seen) for what, seen in pool.map(play, tried) if seen]
            silent = [what for what, seen in results if seen == SILENT]
            share = 100 * (1 - len(silent) / len(results)) if results else 100
            counts = {seen: sum(1 for _, one in results if one == seen) for seen in (FAILED, WARNED, REFUSED)}
            print(f"{scene}: {len(results)} tried, {share:.1f} % seen {counts}" + ("; silent: " + ", ".join(silent) if silent else ""),
                  flush=True)
            unexplained = [what for what in silent if not is_expected(rows, scene, what, used)]
            bad += [f"{scene}: {what} is not seen and not explained" for what in unexplained]
            if options.some == 1 and share < options.least and unexplained:
                bad.append(f"{scene}: {share:.1f} % seen")
    if options.some == 1 and not options.scenes:
        bad += [f"docs/faults.md: {one} explains nothing" for row, kinds in enumerate(rows) for patterns in kinds for one in patterns
                if (row, one) not in used]
    print("\n".join(bad))
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Which room includes which: those of the loop's library draw nothing and know nothing of what stands on them."""
import re
import sys
from pathlib import Path

HOUSE = Path(__file__).resolve().parents[2]

# A room, and what its files may include besides its own. Of sim/ its loose files are a room, too: "sim".
LOOP = ["sim/controllers", "sim/loop", "sim/record", "sim/scenario", "sim"]
MAY = {
    "base": [],
    "devices": ["base"],
    "plants": ["base"],
    "renders": ["base"],
    **{room: ["base", "devices", "plants", *LOOP] for room in LOOP},
}


def room_of(file):
    parts = file.split("/")
    return "/".join(parts[:2]) if parts[0] == "sim" and len(parts) > 2 else parts[0]


def included(path):
    return re.findall(r'^#include "([^"]+)"', path.read_text(), re.MULTILINE)


def main():
    read, faults = {room: 0 for room in MAY}, []
    for path in sorted(HOUSE.glob("*/**/*.[ch]pp")):
        file = path.relative_to(HOUSE).as_posix()
        room = room_of(file)
        if room not in MAY:
            continue
        read[room] += 1
        for to in included(path):
            if room_of(to) not in (room, *MAY[room]):
                faults.append(f"{file}: includes {to}; {room} may include {', '.join(MAY[room]) or 'nothing'}")
    faults += [f"{room}: no files; mend MAY here" for room, files in read.items() if files == 0]
    print("\n".join(faults) or f"{sum(read.values())} files")
    return 1 if faults else 0


sys.exit(main())

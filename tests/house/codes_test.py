#!/usr/bin/env python3
"""The table of codes: every row is used where something is told, has its three sentences, and stands in the reference. (That
a code that is used has a row, and that none stands twice, the compiler sees.)"""
import re
import sys
from pathlib import Path

HOUSE = Path(__file__).resolve().parents[2]
ROOMS = ["base", "devices", "plants", "renders", "sim", "python"]
ROW = re.compile(r'\{"([a-z0-9]+\.[a-z0-9-]+)",\s*((?:"(?:[^"\\]|\\.)*",?\s*)+)\}')


def main():
    rows = {code: re.findall(r'"((?:[^"\\]|\\.)*)"', rest) for code, rest in ROW.findall((HOUSE / "base/problem.hpp").read_text())}
    used = set()
    for room in ROOMS:
        for path in (HOUSE / room).glob("**/*.?pp"):
            used |= set(re.findall(r'["[]([a-z0-9]+\.[a-z0-9-]+)(?:"_code|\](?:\\n)?")', path.read_text()))
        for path in (HOUSE / room).glob("**/*.py"):
            used |= set(re.findall(r'refuse\("([a-z0-9]+\.[a-z0-9-]+)"', path.read_text()))
    page = (HOUSE / "docs/reference/codes.md").read_text()
    faults = [f"{code}: nothing tells it; take it out of base/problem.hpp" for code in sorted(rows.keys() - used)]
    faults += [f"{code}: it has no row in base/problem.hpp" for code in sorted(used - rows.keys())]
    faults += [f"{code}: it is not in docs/reference/codes.md: make reference" for code in rows if f"`{code}`" not in page]
    if len(rows) < 100:
        faults.append(f"only {len(rows)} rows were found: is base/problem.hpp written in another way?")
    for fault in faults:
        print(fault)
    print(f"{len(rows)} codes in {len(set(code.split('.')[0] for code in rows))} rooms")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()

"""The JSON Schema of `drycut check --schema` against the scenes: what is shipped validates, and of the files in
tests/scenes/bad those that are wrong in structure do not.

Usage: json_schema_test.py DRYCUT. Ends with 77 where python3-jsonschema or python3-yaml is missing."""
import json
import pathlib
import subprocess
import sys

try:
    import jsonschema
    import yaml
    from jsonschema import Draft202012Validator
except ImportError as missing:
    print(f"skipped: {missing}; install python3-jsonschema and python3-yaml")
    sys.exit(77)

root = pathlib.Path(__file__).resolve().parents[2]

# A bad file says itself what drycut finds in it ("# expect: LINE:COLUMN: code"). It is wrong in structure if one of these faults
# is of keys and their kinds of value, or if it says so itself ("# structure"): that much a schema can say.
STRUCTURE = ("controller.unknown-kind", "plant.unknown-type", "scenario.missing-key", "scenario.unknown-choice",
             "scenario.unknown-key", "scenario.wrong-kind")
# These are of YAML itself, where readers differ, and come before any schema.
TEXT = ("scenario.yaml-not-taken", "scenario.yaml-syntax", "scenario.twice")
# Everything else is wrong in meaning only: names, units, ranges, what does not fit together.


def kind_of(file):
    faults = [line for line in file.read_text(errors="replace").splitlines() if line.startswith("# expect: ")]
    if any(fault.endswith(code) for fault in faults for code in STRUCTURE) or "# structure\n" in file.read_text(errors="replace"):
        return "structure"
    if not faults or any(fault.endswith(code) for fault in faults for code in TEXT):
        return "text"
    return "meaning"


def main():
    schema = json.loads(subprocess.run([sys.argv[1], "check", "--schema"], check=True,
                                       capture_output=True).stdout)
    Draft202012Validator.check_schema(schema)
    validator = Draft202012Validator(schema)
    wrong = 0

    def expect(file, valid):
        nonlocal wrong
        errors = list(validator.iter_errors(yaml.safe_load(file.read_text())))
        if valid != (not errors):
            wrong += 1
            why = jsonschema.exceptions.best_match(errors)
            print(f"{file}: {'refused: ' + why.json_path + ': ' + why.message[:300] if why else 'taken'}")

    shipped = sorted((root / "scenes").glob("*.yaml"))
    for file in shipped:
        expect(file, True)
    counts = {"structure": 0, "text": 0, "meaning": 0}
    for file in sorted((root / "tests/scenes/bad").glob("*.yaml")):
        kind = kind_of(file)
        counts[kind] += 1
        if kind != "text":
            expect(file, kind == "meaning")
    print(f"{len(shipped)} scenes; bad files: {counts}; {wrong} not as expected")
    return 1 if wrong or not shipped or not counts["structure"] or not counts["meaning"] else 0


sys.exit(main())

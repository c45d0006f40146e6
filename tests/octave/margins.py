"""Margins of a servo's speed loop: what `drycut bode --advise` measures beside what Octave's margin() says.

Octave gets the loop as transfer functions. The machine is one of continuous time, its torque held over a step: two
masses on spring and damper, or one. Around it stands what the drive computes in every step, with its delays: PI
controller, low-pass, notches by the bilinear transform that is right at their frequencies, current lag. Gain margins
agree to 0.1 dB, phase margins to 0.5 deg, as they are printed. Each filter, left out of Octave's loop, is noticed.

margins.py DRYCUT; 77 where Octave or its package control is missing."""

import collections
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

STEP = 100e-6  # [s]
# [kg m2], [N m s/rad], [rad/s], [s]
MOTOR = {"inertia": 5e-3, "viscous": 0.02, "gain": 800, "integral": 20e-3, "lag": 0.5e-3}
LOAD = {"inertia": 3e-3, "stiffness": 3000, "damping": 0.3}  # seen at the motor [kg m2], [N m/rad], [N m s/rad]
RIGID = {"inertia": 1.2e-8, "stiffness": 0.1, "damping": 0}
LEAD = 20e-3  # [m]
LOWEST, HIGHEST = 10, 0.45 / STEP  # [Hz]
GAIN, PHASE = 0.1, 0.5  # [dB], [deg]

Margins = collections.namedtuple("Margins", "gain gain_at phase phase_at")

NOTCH = {"frequency": 400, "depth": 0.1, "width": 1}
SECOND = {"frequency": 700, "depth": 0.3, "width": 0.7}
CASES = {
    "rigid": (RIGID, {}),
    "rigid, low-pass and notch": (RIGID, {"low": 0.3e-3, "notches": [NOTCH]}),
    "no filter": (LOAD, {}),
    "low-pass": (LOAD, {"low": 0.3e-3}),
    "one notch": (LOAD, {"notches": [NOTCH]}),
    "two notches": (LOAD, {"notches": [NOTCH, SECOND]}),
    "all": (LOAD, {"low": 0.3e-3, "notches": [NOTCH, SECOND]}),
}


def scenario(load, filters):
    notches = "".join(
        f"\n      notch{i}: {{frequency: {notch['frequency']} Hz, depth: {notch['depth']}, width: {notch['width']}}}"
        for i, notch in enumerate(filters.get("notches", []), 1))
    mass = load["inertia"] * (2 * math.pi / LEAD) ** 2
    return f"""scene: {{step: {STEP * 1e6} us, duration: 10 ms}}
plants:
  axis:
    type: linear_axis
    mass: {mass} kg
    lead: {LEAD * 1e3} mm
    screw_inertia: 0 kg m2
    gear: {{ratio: 1, stiffness: {load['stiffness']} N m/rad, damping: {load['damping']} N m s/rad}}
    motor_friction: {{coulomb: 0 N m, viscous: {MOTOR['viscous']} N m s/rad}}
    carriage_friction: {{coulomb: 0 N, viscous: 0 N s/m}}
    stop: {{stiffness: 1 N/m, damping: 0 N s/m}}
    servo:
      rotor_inertia: {MOTOR['inertia']} kg m2
      inertia_ratio: 0
      speed_gain: {MOTOR['gain']} rad/s
      integral_time: {MOTOR['integral'] * 1e3} ms
      current_lag: {MOTOR['lag'] * 1e3} ms
      torque_filter: {filters.get('low', 0) * 1e3} ms{notches}
"""


def lag(time):
    """A lag as a step has it: it goes on by its share of what is missing."""
    share = -math.expm1(-STEP / time)
    return f"tf({share!r} * [1 0], [1 {share - 1!r}], h)"


def loop(load, filters):
    """Octave's lines for the open loop L."""
    gain = MOTOR["inertia"] * MOTOR["gain"]
    lines = [f"h = {STEP!r};",
             # The integral has the error of the steps before.
             f"L = tf({gain!r} * [1 {STEP / MOTOR['integral'] - 1!r}], [1 -1], h) * {lag(MOTOR['lag'])};"]
    if filters.get("low"):
        lines.append(f"L = L * {lag(filters['low'])};")
    for notch in filters.get("notches", []):
        w = 2 * math.pi * notch["frequency"]
        middle = notch["width"] * w
        notch = f"tf([1 {notch['depth'] * middle!r} {w * w!r}], [1 {middle!r} {w * w!r}])"
        lines.append(f"L = L * c2d({notch}, h, 'prewarp', {w!r});")
    j, b = MOTOR["inertia"], MOTOR["viscous"]
    if load is RIGID:
        machine = f"tf(1, [{j!r} {b!r}])"
    else:
        m, k, d = load["inertia"], load["stiffness"], load["damping"]
        poles = [j * m, j * d + m * (b + d), (j + m) * k + b * d, b * k]
        machine = f"tf([{m!r} {d!r} {k!r}], {poles!r})"
    return lines + [f"L = L * c2d({machine}, h, 'zoh');"]


def octave(lines):
    script = "\n".join(["pkg load control", *lines])
    return subprocess.run(["octave-cli", "-q", "--eval", script], capture_output=True, text=True,
                          env={"PATH": "/usr/bin:/bin", "LC_ALL": "C", "HOME": tempfile.gettempdir()})


def margins_by_octave(loops):
    """Of each: [dB], where [Hz], [deg], where [Hz]. The roots that margin() looks for lie close together in the plane
    of z, where it misses some. Tustin's plane has the same response, at frequencies that are bent."""
    lines = []
    for one in loops:
        lines += loop(*one) + ["[g, p, wg, wp] = margin(d2c(L, 'tustin'));",
                               "hz = atan([wg, wp] * h / 2) / pi / h;",
                               "printf('%.6f %.6f %.6f %.6f\\n', 20 * log10(g), hz(1), p, hz(2));"]
    said = octave(lines)
    assert said.returncode == 0, said.stderr
    return [Margins(*map(float, line.split())) for line in said.stdout.splitlines()]


def margins_by_drycut(drycut, folder, load, filters):
    file = folder / "axis.yaml"
    file.write_text(scenario(load, filters), encoding="utf-8")
    said = subprocess.run([drycut, "bode", file, "--advise", "--from", str(LOWEST), "--to", str(HIGHEST)],
                          capture_output=True, text=True)
    assert said.returncode == 0, said.stdout + said.stderr
    row = next(line for line in said.stdout.splitlines() if "(present)" in line)
    number = r"(-?[0-9.]+) "
    gain = re.search(rf"{number}dB at {number}Hz|none", row)
    phase = re.search(rf"{number}deg at {number}Hz", row)
    assert gain and phase, row
    return Margins(*map(float, (gain[1] or "inf", gain[2] or "nan", phase[1], phase[2])))


def agree(measured, truth):
    """A gain margin outside of what was measured is none there."""
    beyond = not LOWEST <= truth.gain_at <= HIGHEST
    gain = beyond if math.isinf(measured.gain) else abs(measured.gain - truth.gain) <= GAIN
    return gain and abs(measured.phase - truth.phase) <= PHASE


def text(margins):
    return f"{margins.gain:.2f} dB at {margins.gain_at:.1f} Hz, {margins.phase:.2f} deg at {margins.phase_at:.1f} Hz"


def without_one(filters):
    """The filters with each of them left out."""
    if "low" in filters:
        yield "low-pass", {"notches": filters.get("notches", [])}
    for i, notch in enumerate(filters.get("notches", [])):
        others = [other for other in filters["notches"] if other is not notch]
        yield f"notch at {notch['frequency']} Hz", filters | {"notches": others}


def main():
    if shutil.which("octave-cli") is None or octave([]).returncode != 0:
        print("skipped without octave and octave-control")
        return 77
    asked = []  # case, what is left out of it, loop
    for name, (load, filters) in CASES.items():
        asked.append((name, "", (load, filters)))
        asked += [(name, what, (load, fewer)) for what, fewer in without_one(filters)]
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        for (name, missing, one), truth in zip(asked, margins_by_octave([one for _, _, one in asked]), strict=True):
            if not missing:
                measured = margins_by_drycut(sys.argv[1], pathlib.Path(folder), *one)
                print(f"{name}: drycut {text(measured)}; Octave {text(truth)}")
            else:
                print(f"  without {missing}: Octave {text(truth)}")
            if agree(measured, truth) == bool(missing):
                failed = True
                print("  NOT NOTICED" if missing else "  THEY DIFFER")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

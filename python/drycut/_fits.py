"""Machines learnt from recordings."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, NamedTuple, Sequence

from . import _core
from ._problems import Path, Settings, check_folder, refuse, settings
from ._tables import Numbers


class Channel(NamedTuple):
    """A recorded channel; each sample has its own time.

    time     [s], shape (samples,)
    value    in `unit`, shape (samples,)
    unit     SI: "N m", "rad/s"; "" = a pure number
    clipped  indices of samples that could not be recorded: not to be used
    """

    time: Numbers
    value: Numbers
    unit: str
    clipped: Numbers


@dataclass
class Recording:
    """What drycut.read_recording() gives.

    channels  by their names in the scenario: "axis.motor.torque"
    file      the export that the YAML names
    checksum  of its bytes, FNV-1a
    rows      of data that were taken
    notes     what is doubtful, with the export's line
    """

    channels: dict[str, Channel]
    file: os.PathLike[str]
    checksum: int
    rows: int
    notes: list[str]


@dataclass
class FitValue:
    """A value that a fit looked for, in the unit of its row.

    path             "plants.axis.mass"
    value            None where it is not known
    low              it lies between low and high with 95 %
    high             None likewise
    unit             "" = a pure number
    known            "yes", "joined" (known only together with others) or "no"
    why              it is not known, and which move to record would tell; "" where it is
    before           in the scenario
    alone            as each recording alone would have it
    at_half_cutoff   at half the cutoff; None: not tried
    at_twice_cutoff  at twice
    """

    path: str
    value: float | None
    low: float | None
    high: float | None
    unit: str
    known: str
    why: str
    before: float
    alone: list[float]
    at_half_cutoff: float | None
    at_twice_cutoff: float | None


@dataclass
class Replay:
    """A recording replayed with the values found. All arrays have the shape (instants,).

    name           of the recording
    times          in the recording [s]
    torque         recorded, of the motor, filtered [N m]
    torque_left    what the model has more than that: unexplained [N m]
    speed          of the motor [rpm]
    position       what is followed, in `position_unit`
    position_unit  of `position`
    """

    name: str
    times: Numbers
    torque: Numbers
    torque_left: Numbers
    speed: Numbers
    position: Numbers
    position_unit: str


@dataclass
class Fit:
    """What drycut.fit() gives: the facts of fit.json.

    passed          all values are known, two thirds of the torque are explained, and the cross test keeps its limit
    parameters      FitValue of each path
    torque_offset   FitValue: what the recorded torque has too much
    inputs          FitValue of each recorded force or torque: the share of it that acts
    delays          of channels against the motion, positive: late [s]
    relative_error  torque that is left unexplained, over the recorded one, both rms
    cross_error     the same of the cross test; None without
    condition       above 30 values cannot be told apart
    cutoff          of the filter, chosen from the data [Hz]
    inertia_at_motor  of all that it moves, with the values found [kg m2]; None with closed=True
    ladder          other models and what they gain, a dict each
    codes           of what was found
    notes           the same in words
    replays         Replay of each recording
    tests           Replay of each recording of the cross test
    format          of fit.json
    """

    passed: bool
    parameters: dict[str, FitValue]
    torque_offset: FitValue
    inputs: dict[str, FitValue]
    delays: dict[str, float]
    relative_error: float
    cross_error: float | None
    condition: float
    cutoff: float
    inertia_at_motor: float | None
    ladder: list[dict[str, Any]]
    codes: list[str]
    notes: list[str]
    replays: list[Replay]
    tests: list[Replay]
    format: int

    @property
    def settings(self) -> dict[str, str]:
        """The values that are known, with their units, for `set` of another call."""
        return {one.path: f"{one.value!r} {one.unit}".rstrip() for one in self.parameters.values()
                if one.value is not None}

    @property
    def limits(self) -> dict[str, str]:
        """LOW..HIGH UNIT of each value, for `spread` of tune() and `over` of sweep() with a `sample`. Raises BadInput
        where one is not known."""
        for one in self.parameters.values():
            if one.value is None:
                raise refuse("fit.not-known", one.path, f"the fit does not know {one.path}", "give its range yourself")
        return {one.path: f"{one.low!r}..{one.high!r} {one.unit}".rstrip() for one in self.parameters.values()}

    @property
    def corners(self) -> dict[str, str]:
        """Both limits of each value, for `over` of sweep() and envelope()."""
        return {path: f"{limits}:2" for path, limits in self.limits.items()}


def read_recording(file: Path) -> Recording:
    """Reads the recording of a real machine.

    file  its YAML, as `drycut import` writes it, which names the export

    Raises BadInput with all that is wrong in both.
    """
    got = _core.read_recording(file)
    got["channels"] = {name: Channel(*channel) for name, channel in got["channels"].items()}
    return Recording(**got)


def fit(scenario: Path, *, recordings: Sequence[Path], vary: Sequence[str], test: Sequence[Path] = (),
        limit: float | None = None, closed: bool = False, set: Settings | None = None, jobs: int = 1,
        out: Path | None = None) -> Fit:
    """Learns values of a machine from recordings of its motor's torque and its motion.

    scenario    file (.yaml) of the machine, as it is known before
    recordings  their YAML files, see read_recording()
    vary        paths of what is looked for, ["plants.axis.mass"]
    test        recordings that the values found must explain, too
    limit       of the torque that `test` may leave unexplained [%]
    closed      the whole scenario runs, with drive's loops, controller and inputs
    set         overrides of the scenario
    jobs        replays at the same time, 1 to 256; the result is the same
    out         folder for fit.json, fitted.yaml and report.html; else nothing is left

    The numbers are those of `drycut fit`. Raises BadInput with all problems.
    """
    check_folder(out)
    got = _core.fit(scenario, settings(set), list(recordings), list(vary), list(test), limit, closed, jobs, out)
    got["parameters"] = {one["path"]: FitValue(**one) for one in got["parameters"]}
    got["inputs"] = {one["path"]: FitValue(**one) for one in got["inputs"]}
    got["torque_offset"] = FitValue(**got["torque_offset"])
    for name in ("replays", "tests"):
        got[name] = [Replay(**one) for one in got[name]]
    return Fit(**got)

"""Studies of many runs."""

from __future__ import annotations

import contextlib
import os
import tempfile
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Sequence, Union

from . import _core
from ._problems import Path, Progress, Settings, check_folder, refuse, settings, text
from ._tables import Table, frame, read_csv

if TYPE_CHECKING:
    import pandas  # type: ignore[import]

#: {"variables.length": "500..3000 mm:26", "plants.web.speed": ["60 m/min", "80 m/min"]}
Axes = Mapping[str, Union[str, Sequence[object]]]


@dataclass
class Sweep:
    """What drycut.sweep() and drycut.envelope() give.

    points     numpy structured array, shape (points,), a row a point: a field an axis, `verdict` ("passed", "failed",
               "refused", "diverged"), `limit` (what failed first), `rating` (of a drive, where that is the limit),
               then figures as float64; NaN = there is none
    units      of the fields of `points`, "" = a pure number
    axes       fields of `points` that were gone over, the last one fastest
    shape      points[...].reshape(shape) is a map over the axes; (points,) of a sample
    csv        the text of the command's own sweep.csv or envelope.csv
    simulated  runs that were not kept in `out` already
    """

    points: Table
    units: dict[str, str]
    axes: list[str]
    shape: tuple[int, ...]
    csv: str
    simulated: int

    def frame(self) -> "pandas.DataFrame":
        """The points as a pandas DataFrame; units in its `attrs["units"]`. Needs pandas."""
        return frame(self.points, self.units)


@dataclass
class Tuning:
    """What drycut.tune() gives.

    passed         the best values keep all limits
    values         the best, by path, in `units`; empty where the present ones stay and the program sets them
    units          of `values`, "" = a pure number or the parameter's own
    settings       the best values with their units, for `set` of another call
    metric         with the best values; NaN = not measured
    metric_before  with the scenario's own
    trials         numpy structured array, a row a set of values that was tried, as evaluations.csv has them
    spread         the same of the best values on machines that differ, as spread.csv; None: nothing was spread
    summary        as `drycut tune` prints it
    patch          to paste into scenario or program
    simulated      sets of values that were not kept in `out` already
    """

    passed: bool
    values: dict[str, float]
    units: dict[str, str]
    settings: dict[str, str]
    metric: float
    metric_before: float
    trials: Table
    spread: Table | None
    summary: str
    patch: str
    simulated: int


def _words(values: Sequence[object], path: str) -> str:
    words = [text(value) for value in values]
    for word in words:
        if "," in word or ".." in word:
            raise refuse("study.argument", "over", f"'{word}' is no value of {path}", "one value an entry; a range is a text of its own")
    numbers, units = zip(*(word.partition(" ")[::2] for word in words)) if words else ((), ())
    if len(set(units)) == 1:  # of all of them, as the command has it
        return ",".join(numbers) + f" {units[0]}".rstrip()
    return ",".join(words)


def _axes(over: Axes) -> list[str]:
    return [path if values == "" and path.endswith(".json")  # of a fit, all of it
            else f"{path}={values if isinstance(values, str) else _words(values, path)}" for path, values in over.items()]


@contextlib.contextmanager
def _folder(out: Path | None) -> Iterator[str]:
    check_folder(out)
    if out is not None:
        yield os.fspath(out)
    else:
        with tempfile.TemporaryDirectory(prefix="drycut-") as folder:
            yield folder


def _sweep(got: dict[str, Any], sample: int | None) -> Sweep:
    points, units = read_csv(got["csv"], got["words"], got["figures"])
    names = list(units)[:len(got["axes"])]
    shape = tuple(got["shape"]) if sample is None else (len(points),)
    return Sweep(points=points, units=units, axes=names, shape=shape, csv=got["csv"], simulated=got["simulated"])


def sweep(file: Path, over: Axes, *, set: Settings | None = None, figures: Mapping[str, str] | None = None,
          sample: int | None = None, jobs: int = 1, out: Path | None = None, progress: Progress = None) -> Sweep:
    """Runs a scenario at every point of a grid or a sample.

    file      scenario (.yaml)
    over      axes by their path in the scenario: "500..3000 mm:26" is 26 values from end to end, "20..300 m/min:9:log"
              nine of which each is so many times the one before; or a list, ["60 m/min", "80 m/min"], [True, False].
              {"out/fit/fit.json": ""} goes over the limits of all values of a fit, as do Fit.corners and Fit.limits
    set       overrides, before the axes
    figures   columns more, {"peak": "max(abs(knife.motor.torque))"}; terms as of tune()
    sample    so many points that fill the ranges evenly (Sobol), in place of the grid; ranges need no :N
    jobs      runs at the same time, 1 to 256; the result is the same
    out       folder that is kept: sweep.csv, report.html and what has been run, so that an interrupted sweep goes on
              where it was; else nothing is left
    progress  called in this thread with how many of how many points are done

    The numbers are those of `drycut sweep`'s sweep.csv. A point that fails or cannot be built is a row that says so.
    Other threads run meanwhile. Ctrl-C ends it behind the runs under way. Raises BadInput with all problems.
    """
    if not over:
        raise refuse("option.missing", "over", "it is empty", 'give an axis, such as {"plants.web.speed": "20..120 m/min:11"}')
    with _folder(out) as folder:
        got = _core.sweep(file, settings(set), _axes(over), list((figures or {}).items()), sample, jobs, folder,
                          out is not None, progress)
    return _sweep(got, sample)


def envelope(file: Path, over: Axes, find_max: Mapping[str, str] | None = None, *,
             find_min: Mapping[str, str] | None = None, set: Settings | None = None,
             figures: Mapping[str, str] | None = None, jobs: int = 1, out: Path | None = None,
             progress: Progress = None) -> Sweep:
    """Finds the largest or the smallest value at which every check and every rating holds, at every point of a grid.

    find_max  what is sought, {"plants.web.speed": "20..300 m/min:1"}: between 20 and 300, to 1 m/min; a two-hundredth
              of the range unless given
    find_min  in its place, the smallest: {"variables.length": "300..1500 mm:5"}
    file, over, set, figures, jobs, out, progress as of sweep(); over may be empty, then there is one point

    The field of the sought path has the value found, `verdict` "found", "throughout" (it holds up to the end of the
    range) or "nowhere", `limit` what fails beyond it. The numbers are those of `drycut envelope`'s envelope.csv.
    Raises BadInput with all problems.
    """
    largest, smallest = dict(find_max or {}), dict(find_min or {})
    least = bool(smallest) and not largest
    if len(largest) + len(smallest) != 1:
        raise refuse("option.together", "find_min" if least else "find_max", f"{len(largest) + len(smallest)} values are sought", "seek one")
    (path, span), = (smallest or largest).items()
    with _folder(out) as folder:
        got = _core.envelope(file, settings(set), _axes(over), f"{path}={span}", least, list((figures or {}).items()),
                             jobs, folder, out is not None, progress)
    return _sweep(got, None)


def tune(files: Path | Sequence[Path], vary: Mapping[str, str], minimise: str, *, constraints: Sequence[str] = (),
         set: Settings | None = None, start: str = "0 s", ignore_checks: bool = False, wire: str = "",
         at: str | None = None, amplitude: float = 0.1, budget: int = 200, seed: int = 1,
         spread: Mapping[str, str] | None = None, spread_runs: int = 20, jobs: int = 1, out: Path | None = None,
         progress: Progress = None) -> Tuning:
    """Finds the values with the least metric that keep all limits.

    files          scenario (.yaml), or several: the worst one counts
    vary           ranges by path, {"controller.qmove.set.AxisX.pgain": "1..100"}
    minimise       metric, "rms(AxisX.follerr)"; terms are max, min, mean, rms, sd, count, p99 of a channel or of
                   EVENT.VALUE, and settling(CH, band)
    constraints    limits, "max(abs(knife.motor.torque)) <= 20", "phase_margin >= 45" [deg], "gain_margin >= 6" [dB]
    start          metric and constraints look from this time on
    ignore_checks  the scenarios' failed checks do not count
    wire, at, amplitude   how margins are measured, as of bode()
    budget         simulated runs of all parts together, as `drycut tune` splits them
    seed           of the search and the spread
    spread         the best values are tried on machines that differ, {"plants.knife.drum_inertia": "±30%"}; the
                   limits of a fit are Fit.limits, or {"out/fit/fit.json": ""}
    spread_runs    so many of them; fewer where the budget has no room
    set, jobs, out, progress as of sweep(); progress counts runs of the budget

    The numbers are those of `drycut tune`. Raises BadInput with all problems.
    """
    paths = [files] if isinstance(files, (str, os.PathLike)) else list(files)
    with _folder(out) as folder:
        got = _core.tune(paths, settings(set), [f"{path}={span}" for path, span in vary.items()], minimise,
                         list(constraints), start, ignore_checks, wire, at, amplitude, budget, seed,
                         _axes(spread or {}), spread_runs, jobs, folder,
                         out is not None, progress)
    words = ("phase", "note", "checksum")
    got["trials"] = read_csv(got.pop("evaluations"), words)[0]
    got["spread"] = read_csv(got["spread"], words)[0] if got["spread"] else None
    return Tuning(**got)

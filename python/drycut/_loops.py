"""Position loops measured."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from . import _core
from ._problems import Path, Settings, settings
from ._tables import Numbers


class Margin(NamedTuple):
    """A margin and where it is.

    value      in the unit that Bode tells
    frequency  [Hz]
    """

    value: float
    frequency: float


@dataclass
class Bode:
    """What drycut.bode() gives.

    wire              the analogue reference that was measured through
    loop              "closed"; "open", "restless", "runaway" or "unstable": then there are no points
    frequency         [Hz], shape (points,)
    open_loop         complex L, as the controller closes it, sampling and hold included; shape (points,)
    error             its relative standard error; shape (points,)
    phase_margin      Margin [deg]; None: not met between the first and the last frequency, as of those below
    gain_margin       Margin [dB]
    gain_margin_down  Margin of less gain, below 0 [dB]
    peak_sensitivity  Margin: largest |1 / (1 + L)|
    bandwidth         of the closed position loop at -3 dB [Hz]
    doubts            what keeps the measurement from being trusted
    """

    wire: str
    loop: str
    frequency: Numbers
    open_loop: Numbers
    error: Numbers
    phase_margin: Margin | None
    gain_margin: Margin | None
    gain_margin_down: Margin | None
    peak_sensitivity: Margin | None
    bandwidth: float | None
    doubts: list[str] = field(default_factory=list)

    @property
    def closed_loop(self) -> Numbers:
        """L / (1 + L), shape (points,)."""
        closed: Numbers = self.open_loop / (1 + self.open_loop)
        return closed


def bode(file: Path, set: Settings | None = None, *, wire: str = "", at: str | None = None,
         lowest: float | None = None, highest: float | None = None, points: int = 40, amplitude: float = 0.1,
         settle: float = 0.5) -> Bode:
    """Measures the frequency response of a closed position loop: a sine is added to the analogue reference.

    file       scenario (.yaml)
    set        overrides of it
    wire       analogue reference, "knife.servo.reference"; not needed where there is one
    at         "6 s": the scenario runs undisturbed until then; else to its end
    lowest     frequency [Hz], else 1, and lower to the crossover
    highest    frequency [Hz], else half the sampling frequency
    points     frequencies between them, evenly in decades
    amplitude  of the sine [V]
    settle     before each measurement [s]

    Raises BadInput if the request does not fit the scenario, Diverged if the simulation cannot go on.
    """
    got = _core.bode(file, settings(set), wire, at, lowest, highest, points, amplitude, settle)
    for name in ("phase_margin", "gain_margin", "gain_margin_down", "peak_sensitivity"):
        got[name] = Margin(*got[name]) if got[name] else None
    return Bode(**got)

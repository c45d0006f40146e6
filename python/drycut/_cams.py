"""Cams judged."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Sequence

from . import _core
from ._problems import Path
from ._tables import Table, table


class Finding(NamedTuple):
    """One thing found in a cam.

    grade   "error", "limit", "warning", "caution", "remark"
    number  of the device's error or warning, 0 = it has none
    where   "sector 4 (135 DZC)", "row 12"; "" = of the whole cam
    text    what was found
    remedy  what would be right
    code    its kind, the same in every release: "cam.jump"; `drycut help CODE` tells more
    """

    grade: str
    number: int
    where: str
    text: str
    remedy: str
    code: str


@dataclass
class Cam:
    """What drycut.cam() gives.

    device    "camming4", "lx3vp", "mc_camin"
    sound     neither an error nor a violated limit
    findings  a Finding each
    points    numpy structured array, shape (points,): master, slave, and its velocity, acceleration, jerk with respect to
              the master, all in the table's units; row of the table, from 1
    unit      of the table's master
    report    as `drycut cam` prints it
    """

    device: str
    sound: bool
    findings: list[Finding]
    points: Table
    unit: str
    report: str


def cam(file: Path, *, device: str = "", master_speed: float | None = None, max_velocity: float | None = None,
        max_acceleration: float | None = None, at: Sequence[float] = (), loops: int = 1) -> Cam:
    """Validates and samples a cam table without a machine.

    file              cam table (.csv, .tab)
    device            "camming4", "lx3vp" or "mc_camin"; else by the table's header
    master_speed      what depends on it is judged too, in the table's own unit (see `drycut cam --help`)
    max_velocity      limit of the slave, with master_speed
    max_acceleration  limit of the slave, with master_speed
    at                master positions to sample at, in the table's unit; else 1000 a pass and every boundary
    loops             times round, for a cam that comes back to its beginning

    Raises BadInput with all problems of the table.
    """
    got = _core.cam(file, device, master_speed, max_velocity, max_acceleration, list(at), loops)
    return Cam(device=got["device"], sound=got["sound"], findings=[Finding(*each) for each in got["findings"]],
               points=table(got["columns"]), unit=got["unit"], report=got["report"])

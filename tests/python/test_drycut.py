"""The Python package against the program: same numbers, same problems."""

import csv
import dataclasses
import inspect
import keyword
import json
import math
import os
import pathlib
import pickle
import pydoc
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import drycut

PROGRAM = os.environ["DRYCUT_PROGRAM"]
SCENES = os.path.join(os.environ["DRYCUT_SOURCE_DIR"], "scenes")
KNIFE = os.path.join(SCENES, "rotary_knife.yaml")
SHORT = {"scene.duration": "5 s"}


class RunTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = drycut.run(KNIFE, set=SHORT)

    def test_has_the_trace_and_the_events_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "run", KNIFE, "--no-pictures", "--set", "scene.duration=5 s", "--out", folder],
                           check=False, capture_output=True)
            with open(os.path.join(folder, "rotary_knife", "trace.csv"), encoding="utf-8") as file:
                rows = list(csv.reader(file))
            with open(os.path.join(folder, "rotary_knife", "events.csv"), encoding="utf-8") as file:
                events = list(csv.reader(file))[1:]
        names = [heading.split(" [")[0] for heading in rows[0]]
        units = [heading.split(" [")[1].rstrip("]").replace("-", "") for heading in rows[0]]
        self.assertEqual(list(self.run_.trace.dtype.names), names)
        self.assertEqual([self.run_.units[name] for name in names], units)
        written = np.array(rows[1:], dtype=float)
        self.assertEqual(len(self.run_.trace), len(written))
        for column, name in enumerate(names):
            np.testing.assert_allclose(self.run_.trace[name], written[:, column], rtol=1e-8, atol=1e-9, err_msg=name)
        self.assertEqual([(e.source, e.name) for e in self.run_.events], [(row[1], row[2]) for row in events])
        self.assertEqual([f"{e.time:.9f}" for e in self.run_.events], [row[0] for row in events])

    def test_fields_carry_their_units(self):
        self.assertEqual(self.run_.trace.dtype.fields["knife.motor.torque"][0].metadata["unit"], "N m")
        self.assertEqual(self.run_.units["time"], "s")

    def test_tells_checks_and_pieces(self):
        by_name = {check.name: check for check in self.run_.checks}
        self.assertTrue(by_name["cut length"].passed)
        self.assertEqual(by_name["cut length"].unit, "mm")
        lengths = [event.values["length"] for event in self.run_.events if event.name == "cut"][1:]
        self.assertTrue(all(abs(length - 800) < 0.1 for length in lengths))

    def test_fails_where_a_check_fails(self):
        run = drycut.run(KNIFE, set={**SHORT, "controller.qmove.set.slLength": 7900})
        self.assertFalse(run.passed)
        self.assertEqual(run.failure, "")

    def test_is_the_same_again(self):
        again = drycut.run(KNIFE, set=SHORT)
        self.assertEqual(again.trace.tobytes(), self.run_.trace.tobytes())
        self.assertEqual(again.events, self.run_.events)

    def test_writes_what_the_program_writes_where_it_is_asked_to(self):
        with tempfile.TemporaryDirectory() as folder:
            brief = {"scene.duration": "1 s", "pictures.frames.every": "500 ms", "pictures.video": "off"}
            ours, theirs = os.path.join(folder, "ours"), os.path.join(folder, "rotary_knife")
            subprocess.run([PROGRAM, "run", KNIFE, "--out", folder, *(f"--set={p}={v}" for p, v in brief.items())],
                           check=False, capture_output=True)
            with_files, without = drycut.run(KNIFE, set=brief, out=ours), drycut.run(KNIFE, set=brief)

            def contents(folder, kinds):
                files = [os.path.join(place, name) for place, _, names in os.walk(folder) for name in names
                         if name.endswith(kinds)]
                return {os.path.relpath(file, folder): pathlib.Path(file).read_bytes() for file in files}

            self.assertGreater(len(contents(ours, ".png")), 4)
            self.assertEqual(contents(ours, (".csv", ".json", ".png", ".html")).keys(),
                             contents(theirs, (".csv", ".json", ".png", ".html")).keys())
            self.assertEqual(contents(ours, (".csv", ".json")), contents(theirs, (".csv", ".json")))
            self.assertEqual((with_files.trace.tobytes(), with_files.events), (without.trace.tobytes(), without.events))
            with open(os.path.join(ours, "mine.txt"), "w", encoding="utf-8") as file:
                file.write("not Drycut's")
            drycut.run(KNIFE, set=brief, out=ours)
            self.assertTrue(os.path.exists(os.path.join(ours, "mine.txt")))
        for out in ("", KNIFE):
            with self.assertRaises(drycut.BadInput) as caught:
                drycut.run(KNIFE, set=brief, out=out)
            self.assertEqual([problem.file for problem in caught.exception.problems], ["out"])

    def test_heeds_the_format_of_the_record_and_keeps_retentive_values(self):
        with tempfile.TemporaryDirectory() as folder:
            kept = {name: pathlib.Path(folder, f"{name}.txt") for name in ("ours", "theirs")}
            brief = {"scene.duration": "1 s", "record.format": "hdf5"}
            ours, theirs = ({**brief, "controller.qmove.retentive": str(file)} for file in kept.values())
            drycut.run(KNIFE, set=ours, out=os.path.join(folder, "ours"), pictures=False)
            subprocess.run([PROGRAM, "run", KNIFE, "--no-pictures", "--out", os.path.join(folder, "theirs"),
                            *(f"--set={path}={value}" for path, value in theirs.items())], check=False, capture_output=True)
            self.assertEqual(sorted(os.listdir(os.path.join(folder, "ours"))),
                             sorted(os.listdir(os.path.join(folder, "theirs", "rotary_knife"))))
            self.assertIn("trace.h5", os.listdir(os.path.join(folder, "ours")))
            self.assertGreater(len(kept["ours"].read_text()), 1000)
            self.assertEqual(kept["ours"].read_text(), kept["theirs"].read_text())

    def test_a_check_is_a_tuple_of_seven_with_more_attributes(self):
        check = self.run_.checks[0]
        name, expectation, passed, margin, unit, at, detail = check
        self.assertEqual((name, expectation, passed, margin, unit, at, detail), check)
        self.assertLess(check.used, 1)
        self.assertIsNone(check.failed_at)
        again = pickle.loads(pickle.dumps(check))
        self.assertEqual((again, again.used), (check, check.used))
        drive = self.run_.outcome["drives"][0]
        self.assertGreater(drive["figures"][0]["share"], 0)
        speed, torque = drive["points"].T
        self.assertGreater(len(speed), 100)
        self.assertLessEqual(abs(torque).max(), drive["ratings"]["peak_torque"] * 1.001)
        self.assertTrue(np.isfinite(speed).all())

    def test_coverage_is_that_of_the_program(self):
        self.assertEqual(self.run_.coverage, {})
        with tempfile.TemporaryDirectory() as folder:
            short = {"scene.duration": "1 s"}
            run = drycut.run(KNIFE, set=short, coverage=True)
            subprocess.run([PROGRAM, "run", KNIFE, "--no-pictures", "--coverage", "--set", "scene.duration=1 s", "--out", folder],
                           check=False, capture_output=True)
            text = pathlib.Path(folder, "coverage.info").read_text(encoding="utf-8")
            drycut.run(KNIFE, set=short, coverage=True, pictures=False, out=os.path.join(folder, "out"))
            self.assertEqual(pathlib.Path(folder, "out", "coverage.info").read_text(encoding="utf-8"), text)
        (file, covered), = run.coverage.items()
        self.assertIn(f"SF:{file}\n", text)
        for line, count in covered.lines.items():
            self.assertIn(f"DA:{line},{count}\n", text)
        self.assertGreater(len(covered.lines), 10)
        self.assertTrue(set(covered.branches) <= set(covered.lines))
        self.assertIsInstance(covered.never, str)

    def test_gives_a_frame(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not installed")
        frame = self.run_.frame()
        self.assertEqual(frame.index.name, "time [s]")
        self.assertEqual(frame.attrs["units"]["knife.angle"], "deg")
        self.assertEqual(len(frame), len(self.run_.trace))


class BadInputTest(unittest.TestCase):
    def test_tells_all_problems_with_their_places(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write("scene: {step: 1 kg, duration: 2 s}\nplants:\n  web: {type: weeb}\n")
            file.flush()
            with self.assertRaises(drycut.BadInput) as caught:
                drycut.run(file.name)
            problems = caught.exception.problems
            self.assertEqual([(p.file, p.line) for p in problems], [(file.name, 1), (file.name, 3)])
            self.assertEqual(problems[0].column, 17)  # of the unit
            self.assertIn("web", problems[1].remedy)
            self.assertEqual(str(caught.exception).splitlines()[0].split(": ")[0], f"{file.name}:1:17")

    def test_is_a_value_error(self):
        for call in (lambda: drycut.run("missing.yaml"), lambda: drycut.Simulation("missing.yaml"),
                     lambda: drycut.cam("missing.csv"), lambda: drycut.bode("missing.yaml"),
                     lambda: drycut.run(KNIFE, set={"plants.web.sped": 1}), lambda: drycut.bode(KNIFE, wire="no.wire")):
            with self.assertRaises(ValueError) as caught:
                call()
            self.assertTrue(caught.exception.problems)


class SimulationTest(unittest.TestCase):
    def setUp(self):
        self.line = drycut.Simulation(KNIFE)

    def test_is_stepped_read_and_written(self):
        line = self.line
        self.assertEqual(line.step_length, 1e-4)
        self.assertEqual(line.duration, 12)
        line.step()
        self.assertEqual(line.time, 1e-4)
        line.advance(1.0)
        self.assertAlmostEqual(line.read("web.speed"), 60.4, places=6)
        self.assertEqual(line.unit("web.speed"), "m/min")
        line.write("web.speed", 30)
        line.advance(1.0)
        self.assertAlmostEqual(line.read("web.speed"), 30, places=2)
        self.assertIn("knife.motor.torque", line.names())

    def test_gives_the_run_s_own_events_and_checks(self):
        run = drycut.run(KNIFE, set=SHORT)
        line = drycut.Simulation(KNIFE, set=SHORT)
        line.advance(5.0)
        self.assertEqual(line.take_events(), run.events)
        self.assertEqual(line.take_events(), [])
        self.assertEqual(line.checks(), run.checks)
        self.assertTrue(all(check.expectation for check in line.checks()))

    def test_refuses_what_does_not_fit(self):
        for call in (lambda: self.line.read("web.sped"), lambda: self.line.write("knife.angle", 1),
                     lambda: self.line.write("AxisX.pgain", 1e9), lambda: self.line.advance(-1),
                     lambda: self.line.advance(math.nan), lambda: self.line.unit("nothing")):
            with self.assertRaises(drycut.BadInput) as caught:
                call()
            self.assertEqual(caught.exception.problems, [])

    def test_lets_other_threads_run(self):
        ticks = 0
        worker = threading.Thread(target=lambda: self.line.advance(20.0))
        worker.start()
        while worker.is_alive():
            ticks += 1
            time.sleep(0)
        self.assertGreater(ticks, 10)  # held, the lock would let this count once

    def test_is_of_one_thread_at_a_time(self):
        worker = threading.Thread(target=lambda: self.line.advance(200.0))
        worker.start()
        refused = False
        while worker.is_alive() and not refused:
            try:
                self.line.read("knife.angle")
            except RuntimeError as error:
                refused = "another thread" in str(error)
        worker.join()
        self.assertTrue(refused)
        self.assertAlmostEqual(self.line.time, 200)
        self.line.read("knife.angle")  # again

    def test_is_interrupted(self):
        with self.assertRaises(KeyboardInterrupt):
            threading.Thread(target=lambda: signal.raise_signal(signal.SIGINT)).start()
            self.line.advance(1e6)
        self.assertLess(self.line.time, 1e6)
        self.line.step()  # goes on

    def test_takes_arguments_by_place_or_name(self):
        line = self.line
        line.advance(seconds=0.5)
        self.assertEqual(line.time, 0.5)
        line.write("web.speed", value=np.float32(30))
        line.write(value=40, name="web.speed")
        line.advance(np.float64(0.5))
        self.assertAlmostEqual(line.read(name="web.speed"), 40, places=1)
        for call in (lambda: line.read(), lambda: line.read("web.speed", 1), lambda: line.read(7), lambda: line.step(1),
                     lambda: line.write("web.speed"), lambda: line.write("web.speed", "40"),
                     lambda: line.write("web.speed", name="web.speed"), lambda: line.write("web.speed", speed=40),
                     lambda: line.advance(None), lambda: drycut.Simulation.read(3, "web.speed")):
            self.assertRaises(TypeError, call)
        self.assertEqual(line.time, 1.0)

    def test_may_be_a_base(self):
        class Logged(drycut.Simulation):
            def read(self, name):
                return 2 * super().read(name)

        line = Logged(KNIFE)
        line.advance(1)
        self.assertAlmostEqual(line.read("web.speed"), 120.8, places=5)

        class Empty(drycut.Simulation):
            def __init__(self):
                pass

        self.assertRaises((RuntimeError, TypeError), lambda: Empty().read("web.speed"))

    def test_threads_do_not_disturb_each_other(self):
        traces = [b""] * 3

        def run(i):
            traces[i] = drycut.run(KNIFE, set=SHORT).trace.tobytes()

        threads = [threading.Thread(target=run, args=(i,)) for i in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(traces[0], traces[1])
        self.assertEqual(traces[0], traces[2])


class CamTest(unittest.TestCase):
    TABLE = os.path.join(SCENES, "cams", "ecam_rotary_saw.csv")

    def test_samples_what_the_program_samples(self):
        cam = drycut.cam(self.TABLE)
        text = subprocess.run([PROGRAM, "cam", self.TABLE, "--csv", "-"], capture_output=True, text=True,
                              check=False).stdout
        rows = np.array([row[:5] for row in list(csv.reader(text.splitlines()))[1:]], dtype=float)
        self.assertEqual(cam.device, "lx3vp")
        for column, name in enumerate(["master", "slave", "velocity", "acceleration", "jerk"]):
            np.testing.assert_array_equal(cam.points[name], rows[:, column], err_msg=name)

    def test_tells_findings(self):
        cam = drycut.cam(self.TABLE, master_speed=1000, max_velocity=1)
        self.assertFalse(cam.sound)
        self.assertIn("limit", [finding.grade for finding in cam.findings])

    def test_samples_where_it_is_asked_to(self):
        master = drycut.cam(self.TABLE).points["master"]
        cam = drycut.cam(self.TABLE, at=[master[0], master[-1] / 2])
        np.testing.assert_array_equal(cam.points["master"], [master[0], master[-1] / 2])


class BodeTest(unittest.TestCase):
    def test_measures_what_the_program_measures(self):
        bode = drycut.bode(KNIFE, points=6, lowest=2, highest=100)
        self.assertEqual(bode.loop, "closed")
        self.assertEqual(bode.wire, "knife.servo.reference")
        text = subprocess.run([PROGRAM, "bode", KNIFE, "--points", "6", "--from", "2", "--to", "100", "--csv", "-"],
                              capture_output=True, text=True, check=False).stdout
        rows = list(csv.reader(text.splitlines()))
        np.testing.assert_allclose(bode.frequency, [float(row[0]) for row in rows[1:]], rtol=1e-6)
        decibels = 20 * np.log10(abs(bode.open_loop))
        np.testing.assert_allclose(decibels, [float(row[1]) for row in rows[1:]], atol=1e-3)
        self.assertGreater(bode.phase_margin.value, 0)
        np.testing.assert_allclose(bode.closed_loop, bode.open_loop / (1 + bode.open_loop))


GRID = {"variables.length": "500..1000 mm:3", "plants.web.speed": "60..90 m/min:2"}


class SweepTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.figures = {"peak": "max(abs(knife.motor.torque))"}
        cls.told = []
        cls.sweep = drycut.sweep(KNIFE, GRID, set=SHORT, figures=cls.figures, jobs=2,
                                 progress=lambda done, of: cls.told.append((done, of)))

    def command(self, folder, *arguments):
        subprocess.run([PROGRAM, *arguments, "--set", "scene.duration=5 s", "--out", folder], check=True,
                       capture_output=True)

    def test_has_the_bytes_and_numbers_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            self.command(folder, "sweep", KNIFE, "--over", "variables.length=500..1000 mm:3", "--over",
                         "plants.web.speed=60..90 m/min:2", "--figure", "peak=max(abs(knife.motor.torque))")
            with open(os.path.join(folder, "sweep.csv"), encoding="utf-8") as file:
                written = file.read()
        self.assertEqual(self.sweep.csv, written)
        rows = list(csv.reader(written.splitlines()))
        points, units = self.sweep.points, self.sweep.units
        headings = [f"{name} [{units[name]}]" if units[name] else name for name in points.dtype.names]
        self.assertEqual(headings, rows[0])
        self.assertEqual(len(points), len(rows) - 1)
        for i, name in enumerate(points.dtype.names):
            cells = [row[i] for row in rows[1:]]
            if points.dtype[name].kind == "U":
                self.assertEqual(list(points[name]), cells)
            else:
                np.testing.assert_array_equal(points[name], [float(cell) if cell else math.nan for cell in cells])
        self.assertEqual({name for name in points.dtype.names if points.dtype[name].kind == "U"},
                         {"verdict", "limit", "rating"})

    def test_is_a_map_over_its_axes(self):
        self.assertEqual(self.sweep.axes, ["variables.length", "plants.web.speed"])
        self.assertEqual(self.sweep.shape, (3, 2))
        np.testing.assert_array_equal(self.sweep.points["variables.length"].reshape(self.sweep.shape)[:, 0],
                                      [500, 750, 1000])
        np.testing.assert_array_equal(self.sweep.points["plants.web.speed"].reshape(self.sweep.shape)[0], [60, 90])
        self.assertEqual(self.sweep.points.dtype.fields["knife.cut accuracy"][0].metadata["unit"], "mm")

    def test_tells_its_progress(self):
        self.assertEqual(self.told[-1], (6, 6))
        self.assertEqual(self.told, sorted(self.told))

    def test_is_kept_and_goes_on_where_it_was(self):
        with tempfile.TemporaryDirectory() as folder:
            drycut.sweep(KNIFE, {"variables.length": "500..1000 mm:2"}, set=SHORT, figures=self.figures, out=folder)
            swept = drycut.sweep(KNIFE, {"variables.length": "500..1000 mm:3"}, set=SHORT, figures=self.figures,
                                 out=folder)
            self.assertEqual(swept.simulated, 1)
            with open(os.path.join(folder, "sweep.csv"), encoding="utf-8") as file:
                self.assertEqual(file.read(), swept.csv)
            self.assertTrue(os.path.exists(os.path.join(folder, "report.html")))
            again = drycut.sweep(KNIFE, {"variables.length": "500..1000 mm:3"}, set=SHORT, figures=self.figures,
                                 out=folder)
            self.assertEqual((again.simulated, again.csv), (0, swept.csv))

    def test_leaves_nothing_unless_it_is_asked_to(self):
        with tempfile.TemporaryDirectory() as folder:
            code = ("import drycut, sys; drycut.sweep(sys.argv[1], {'variables.length': ['500 mm']}, "
                    "set={'scene.duration': '1 s'})")
            subprocess.run([sys.executable, "-c", code, KNIFE], check=True, cwd=folder,
                           env={**os.environ, "TMPDIR": folder})
            self.assertEqual(os.listdir(folder), [])

    def test_takes_values_as_a_list_and_words(self):
        swept = drycut.sweep(KNIFE, {"plants.web.speed": ["60 m/min", "80 m/min"], "plants.web.elastic": [True, False]},
                             set={"scene.duration": "1 s"})
        self.assertEqual(list(swept.points["plants.web.speed"]), [60, 60, 80, 80])
        self.assertEqual(list(swept.points["plants.web.elastic"]), ["true", "false"] * 2)
        self.assertEqual(swept.shape, (2, 2))

    def test_samples(self):
        with tempfile.TemporaryDirectory() as folder:
            self.command(folder, "sweep", KNIFE, "--over", "variables.length=500..1000 mm", "--sample", "sobol:5")
            with open(os.path.join(folder, "sweep.csv"), encoding="utf-8") as file:
                written = file.read()
        swept = drycut.sweep(KNIFE, {"variables.length": "500..1000 mm"}, set=SHORT, sample=5)
        self.assertEqual(swept.csv, written)
        self.assertEqual(swept.shape, (5,))

    def test_is_interrupted(self):
        def interrupt(done, of):
            signal.raise_signal(signal.SIGINT)

        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(KeyboardInterrupt):
                drycut.sweep(KNIFE, GRID, set=SHORT, out=folder, progress=interrupt)
            swept = drycut.sweep(KNIFE, GRID, set=SHORT, out=folder)
            self.assertEqual(swept.simulated, 5)  # one was kept

    def test_passes_on_what_a_callback_raises(self):
        with self.assertRaises(ZeroDivisionError):
            drycut.sweep(KNIFE, GRID, set=SHORT, jobs=2, progress=lambda done, of: 1 / 0)

    def test_tells_what_does_not_fit(self):
        length = {"variables.length": "500..1000 mm:3"}
        whole = {"variables.length": "500..1000 mm"}
        cases = [(lambda: drycut.sweep(KNIFE, {}), [("over", 1)]),
                 (lambda: drycut.sweep(KNIFE, {"variables.length": "500..1000 mm"}), [("over", 30)]),
                 (lambda: drycut.sweep(KNIFE, {"variables.length": ["1,2 mm"]}), [("over", 1)]),
                 (lambda: drycut.sweep(KNIFE, {"variables.length": ["1..2 mm"]}), [("over", 1)]),
                 (lambda: drycut.sweep(KNIFE, {"variables.lengt": "500..1000 mm:3"}), [("over", 17)]),
                 (lambda: drycut.sweep(KNIFE, length, set={"plants.web.sped": 1}), [("set plants.web.sped", 1)]),
                 (lambda: drycut.sweep(KNIFE, length, jobs=0), [("jobs", 1)]),
                 (lambda: drycut.sweep(KNIFE, length, jobs=257), [("jobs", 1)]),
                 (lambda: drycut.sweep(KNIFE, whole, sample=0), [("sample", 1)]),
                 (lambda: drycut.sweep(KNIFE, whole, sample=-1), [("sample", 1)]),
                 (lambda: drycut.sweep(KNIFE, whole, sample=1000001), [("sample", 1)]),
                 (lambda: drycut.sweep(KNIFE, length, figures={"": "max(knife.angle)"}), [("figures", 1)]),
                 (lambda: drycut.sweep(KNIFE, length, figures={"limit": "max(knife.angle)"}), [("figures", 1)]),
                 (lambda: drycut.sweep(KNIFE, length, figures={"knife.cut accuracy": "max(knife.angle)"}),
                  [("figures", 1)]),
                 (lambda: drycut.sweep(KNIFE, length, figures={"x": "max(knife.angl)"}), [("figures", 7)]),
                 (lambda: drycut.sweep(KNIFE, length, out=""), [("out", 1)]),
                 (lambda: drycut.sweep(KNIFE, length, out=KNIFE), [("out", 1)]),
                 (lambda: drycut.envelope(KNIFE, {}, {}), [("find_max", 1)]),
                 (lambda: drycut.envelope(KNIFE, {}), [("find_max", 1)]),
                 (lambda: drycut.envelope(KNIFE, {}, {"plants.web.speed": "20..40 m/min"},
                                          find_min={"plants.web.speed": "20..40 m/min"}), [("find_max", 1)]),
                 (lambda: drycut.envelope(KNIFE, {}, find_min={"plants.web.speed": "20 m/min"}), [("find_min", 18)]),
                 (lambda: drycut.envelope(KNIFE, {}, {"plants.web.speed": "20 m/min"}), [("find_max", 18)]),
                 (lambda: drycut.tune(KNIFE, {}, "rms(AxisX.follerr)"), [("vary", 1)]),
                 (lambda: drycut.tune([], {"a": "1..2"}, "rms(AxisX.follerr)"), [("files", 1)]),
                 (lambda: drycut.tune(KNIFE, {"controller.qmove.set.AxisX.pgain": "1..9"}, "rms(AxisX.follerr)",
                                      start="3 kg", budget=0, spread_runs=0),
                  [("budget", 1), ("spread_runs", 1), ("start", 1)])]
        for call, expected in cases:
            with self.assertRaises(drycut.BadInput) as caught:
                call()
            told = [(problem.file, problem.column) for problem in caught.exception.problems]
            self.assertEqual(told, expected, str(caught.exception))
            for problem in caught.exception.problems:
                self.assertIn(f"{problem.file}:1:{problem.column}: {problem.what}; {problem.remedy}",
                              str(caught.exception))


class EnvelopeTest(unittest.TestCase):
    def test_has_the_bytes_and_numbers_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "envelope", KNIFE, "--over", "variables.length=700..1000 mm:2", "--find-max",
                            "plants.web.speed=20..200 m/min:10", "--set", "scene.duration=5 s", "--out", folder],
                           check=True, capture_output=True)
            with open(os.path.join(folder, "envelope.csv"), encoding="utf-8") as file:
                written = file.read()
            found = drycut.envelope(KNIFE, {"variables.length": "700..1000 mm:2"},
                                    {"plants.web.speed": "20..200 m/min:10"}, set=SHORT, jobs=2)
            self.assertGreater(found.simulated, 0)
            kept = drycut.envelope(KNIFE, {"variables.length": "700..1000 mm:2"},
                                   {"plants.web.speed": "20..200 m/min:10"}, set=SHORT, out=folder)
            again = drycut.envelope(KNIFE, {"variables.length": "700..1000 mm:2"},
                                    {"plants.web.speed": "20..200 m/min:10"}, set=SHORT, out=folder)
            with open(os.path.join(folder, "envelope.csv"), encoding="utf-8") as file:
                self.assertEqual(file.read(), written)
        self.assertEqual((found.csv, kept.csv), (written, written))
        self.assertEqual((again.simulated, again.csv), (0, written))
        rows = list(csv.DictReader(written.splitlines()))
        np.testing.assert_array_equal(found.points["plants.web.speed"],
                                      [float(row["plants.web.speed [m/min]"]) for row in rows])
        self.assertEqual(list(found.points["verdict"]), [row["verdict"] for row in rows])
        self.assertEqual((found.axes, found.shape), (["variables.length"], (2,)))
        self.assertEqual(found.units["plants.web.speed"], "m/min")


    def test_finds_the_smallest_as_the_command_does(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "envelope", KNIFE, "--find-min", "variables.length=400..900 mm:100",
                            "--set", "scene.duration=5 s", "--out", folder], check=True, capture_output=True)
            with open(os.path.join(folder, "envelope.csv"), encoding="utf-8") as file:
                written = file.read()
        found = drycut.envelope(KNIFE, {}, find_min={"variables.length": "400..900 mm:100"}, set=SHORT)
        self.assertEqual(found.csv, written)
        self.assertEqual(found.points.dtype.names[:6],
                         ("variables.length", "verdict", "limit", "rating", "holds to", "fails at"))


class TuneTest(unittest.TestCase):
    def test_finds_what_the_program_finds(self):
        vary = {"controller.qmove.set.AxisX.pgain": "1..100", "controller.qmove.set.AxisX.feedfw": "900..1000"}
        spread = {"plants.knife.drum_inertia": "\N{PLUS-MINUS SIGN}30%"}
        told = []
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "tune", KNIFE, "--minimise", "rms(AxisX.follerr)", "--from", "3 s", "--budget",
                            "60", "--spread-runs", "3", "--spread", "plants.knife.drum_inertia=±30%", "--set",
                            "scene.duration=5 s", "--no-pictures", "--out", folder,
                            *(f"--vary={path}={span}" for path, span in vary.items())], check=False,
                           capture_output=True)
            tables = {}
            for name in ("evaluations.csv", "spread.csv", "patch.txt"):
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    tables[name] = file.read()
            tuning = drycut.tune(KNIFE, vary, "rms(AxisX.follerr)", start="3 s", budget=60, spread=spread, spread_runs=3,
                                 set=SHORT, jobs=2, progress=lambda done, of: told.append((done, of)))
            for simulated in (tuning.simulated, 0):
                kept = drycut.tune([KNIFE], vary, "rms(AxisX.follerr)", start="3 s", budget=60, spread=spread,
                                   spread_runs=3, set=SHORT, out=folder)
                self.assertEqual(kept.simulated, simulated)
                self.assertEqual((kept.patch, kept.summary), (tuning.patch, tuning.summary))
            self.assertTrue(os.path.exists(os.path.join(folder, "report.html")))
        self.assertEqual((kept.values, kept.metric), (tuning.values, tuning.metric))
        self.assertEqual(tuning.patch, tables["patch.txt"])
        for table, name in ((tuning.trials, "evaluations.csv"), (tuning.spread, "spread.csv")):
            rows = list(csv.DictReader(tables[name].splitlines()[1:]))
            self.assertEqual(len(table), len(rows))
            np.testing.assert_array_equal(table["rms(AxisX.follerr)"],
                                          [float(row["rms(AxisX.follerr)"]) for row in rows])
            self.assertEqual(list(table["phase"]), [row["phase"] for row in rows])
        self.assertTrue(tuning.passed)
        self.assertLessEqual(tuning.metric, tuning.metric_before)
        self.assertEqual(tuning.metric, min(row for row, bad in zip(tuning.trials["rms(AxisX.follerr)"],
                                                                    tuning.trials["violation"]) if bad == 0))
        self.assertEqual(set(tuning.settings), set(vary))
        self.assertEqual({path: float(value) for path, value in tuning.settings.items()}, tuning.values)
        self.assertIn("Before and after", tuning.summary)
        self.assertEqual(told[-1], (60, 60))
        # The settings are those of another call.
        run = drycut.run(KNIFE, set={**SHORT, **tuning.settings})
        later = run.trace["AxisX.follerr"][run.trace["time"] >= 3]
        self.assertAlmostEqual(np.sqrt(np.mean(later**2)) / tuning.metric, 1, delta=0.01)


class VerbsTest(unittest.TestCase):
    """Every verb of the program has a face, and it is the program's own: what it prints and writes has its bytes."""

    def program(self, *words):
        done = subprocess.run([PROGRAM, *words], check=False, capture_output=True, text=True)
        return done.returncode, done.stdout

    def same_files(self, one, other):
        for folder, _, files in os.walk(one):
            for name in files:
                path = pathlib.Path(folder, name)
                self.assertEqual(path.read_bytes(), pathlib.Path(other, path.relative_to(one)).read_bytes(), path)

    def test_all_are_there(self):
        _, text = self.program("--help")
        names = [line.split()[0] for line in text.split("\n\n")[2].splitlines() if line[2:3].strip()]
        self.assertGreater(len(names), 15)
        for name in names:
            name += "_" if keyword.iskeyword(name) else ""
            self.assertTrue(callable(getattr(drycut, name)), name)
            self.assertTrue(callable(getattr(drycut.verbs, name)), name)
            self.assertIn(name, drycut.__all__)

    def test_what_has_a_class_of_its_own_runs_as_the_program_does_too(self):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "out")
            ran = drycut.verbs.run([KNIFE], set=SHORT, out=out, no_pictures=True, jobs=1)
            kept = os.path.join(folder, "kept")
            os.rename(out, kept)
            status, text = self.program("run", KNIFE, "--set", "scene.duration=5 s", "--out", out, "--no-pictures")
            self.assertEqual((ran.status, ran.text), (status, text))
            self.same_files(out, kept)

    def test_prints_and_writes_what_the_program_does(self):
        with tempfile.TemporaryDirectory() as folder:
            runs = []
            for speed in ("60 m/min", "61 m/min"):
                runs.append(os.path.join(folder, speed[:2]))
                drycut.run(KNIFE, set={**SHORT, "plants.web.speed": speed}, out=runs[-1], pictures=False)
            out = os.path.join(folder, "out")
            ran = drycut.compare(runs, out=out, tolerance=["time=1e-6", "0.1%"])
            kept = os.path.join(folder, "kept")
            os.rename(out, kept)
            status, text = self.program("compare", *runs, "--out", out, "--tolerance", "time=1e-6", "--tolerance", "0.1%")
            self.assertEqual((ran.status, ran.text), (status, text))
            self.assertEqual((ran.passed, ran.verdict["verdict"], ran.verdict["exit"]), (False, "failed", 1))
            self.same_files(out, kept)

    def test_takes_flags_numbers_and_settings(self):
        _, text = self.program("plants", "rotary_knife", "--json")
        self.assertEqual(drycut.plants("rotary_knife", json=True).text, text)
        _, text = self.program("check", KNIFE, "--expand", "--set", "scene.duration=5 s")
        self.assertEqual(drycut.check([KNIFE], expand=True, set=SHORT).text, text)

    def test_runs_the_tests_of_programs(self):
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "sign_test.st")
            for value, status in ((1, 0), (2, 1)):
                pathlib.Path(program).write_text(
                    f"FUNCTION_BLOCK TEST_One\nAssertEquals(1, {value}, 'one');\nEND_FUNCTION_BLOCK\n", encoding="utf-8")
                ran = drycut.test([program])
                self.assertEqual(ran.status, status)
                self.assertEqual((ran.status, ran.text), self.program("test", program))
            self.assertIn("sign_test.st:2: expected 1, was 2: one", ran.text)
            with self.assertRaises(drycut.BadInput):
                drycut.test([KNIFE])

    def test_raises_what_the_program_refuses(self):
        with self.assertRaises(drycut.BadInput) as told:
            drycut.size(KNIFE, drive="knife.none")
        self.assertEqual(told.exception.problems[0].file, "drive")
        with self.assertRaises(TypeError):
            drycut.size(KNIFE, drives="knife.servo")
        with self.assertRaises(drycut.BadInput):
            drycut.convert("none", to="csv")


class FitTest(unittest.TestCase):
    """A belt axis and its recordings: what drycut fit says of them."""

    RECORDINGS = os.path.join(SCENES, "recordings")
    MASS = "plants.axis.mass"

    @classmethod
    def setUpClass(cls):
        cls.machine = os.path.join(cls.RECORDINGS, "belt_axis.yaml")
        cls.move = os.path.join(cls.RECORDINGS, "belt_axis_move.yaml")
        other = os.path.join(cls.RECORDINGS, "belt_axis_other_move.yaml")
        cls.vary = [cls.MASS, "plants.axis.carriage_friction.coulomb", "plants.axis.carriage_friction.viscous"]
        cls.folder = tempfile.TemporaryDirectory()
        cls.ours, cls.theirs = (os.path.join(cls.folder.name, name) for name in ("ours", "theirs"))
        cls.fit = drycut.fit(cls.machine, recordings=[cls.move], vary=cls.vary, test=[other], limit=5, jobs=2, out=cls.ours)
        drycut.verbs.fit(cls.machine, recording=[cls.move], vary=cls.vary, test=[other], limit=5, jobs=2, out=cls.theirs)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_has_the_facts_and_the_files_of_the_command(self):
        said = json.loads(pathlib.Path(self.theirs, "fit.json").read_text(encoding="utf-8"))
        self.assertEqual([vars(one) for one in self.fit.parameters.values()], said.pop("parameters"))
        self.assertEqual(vars(self.fit.torque_offset), said.pop("torque_offset"))
        self.assertEqual([vars(one) for one in self.fit.inputs.values()], said.pop("inputs"))
        for name, value in said.items():
            self.assertEqual(getattr(self.fit, name), value, name)
        for name in ("fit.json", "fitted.yaml", "report.html", "verdict.json"):
            self.assertEqual(pathlib.Path(self.ours, name).read_bytes(), pathlib.Path(self.theirs, name).read_bytes(), name)
        self.assertTrue(self.fit.passed)

    def test_limits_are_ranges_of_other_studies(self):
        mass = self.fit.parameters[self.MASS]
        self.assertEqual(self.fit.settings[self.MASS], f"{mass.value!r} kg")
        swept = drycut.sweep(self.machine, {self.MASS: self.fit.corners[self.MASS]})
        np.testing.assert_allclose(swept.points[self.MASS], [mass.low, mass.high], rtol=1e-14)
        again = drycut.sweep(self.machine, {os.path.join(self.ours, "fit.json"): ""})
        self.assertEqual((again.axes, again.shape), (self.vary, (2, 2, 2)))
        np.testing.assert_allclose(again.points[self.MASS][[0, -1]], [mass.low, mass.high], rtol=1e-14)
        sampled = drycut.sweep(self.machine, self.fit.limits, sample=4)
        hair = 1e-12 * mass.high  # of 15 digits
        self.assertGreater(min(sampled.points[self.MASS]), mass.low - hair)
        self.assertLess(max(sampled.points[self.MASS]), mass.high + hair)

    def test_a_value_that_is_not_known_has_no_limits(self):
        lost = dataclasses.replace(self.fit.parameters[self.MASS], value=None, low=None, high=None, known="joined")
        fit = dataclasses.replace(self.fit, parameters={**self.fit.parameters, self.MASS: lost})
        self.assertNotIn(self.MASS, fit.settings)
        with self.assertRaises(drycut.BadInput) as told:
            fit.limits
        self.assertEqual(told.exception.problems[0].code, "fit.not-known")

    def test_replays_are_arrays(self):
        replay, = self.fit.replays
        self.assertEqual(len(self.fit.tests), 1)
        self.assertEqual(len({len(getattr(replay, name)) for name in ("times", "torque", "torque_left", "speed", "position")}), 1)
        rms = np.sqrt(np.mean(replay.torque_left**2) / np.mean(replay.torque**2))
        self.assertLess(rms, 0.01)

    def test_reads_a_recording(self):
        recording = drycut.read_recording(self.move)
        with open(recording.file, encoding="utf-8") as file:
            rows = list(csv.reader(file, delimiter=";"))[1:]
        self.assertEqual(list(recording.channels), ["axis.motor.torque", "axis.encoder.count"])
        torque = recording.channels["axis.motor.torque"]
        self.assertEqual((torque.unit, len(torque.time)), ("N m", recording.rows))
        written = np.array([row[1] for row in rows[-recording.rows:]], dtype=float)
        np.testing.assert_allclose(torque.value, written / 100 * 9.5, rtol=1e-12)

    def test_tells_what_does_not_fit(self):
        with self.assertRaises(drycut.BadInput) as told:
            drycut.fit(self.machine, recordings=[], vary=["plants.axis.mas"], jobs=0)
        self.assertEqual({problem.file for problem in told.exception.problems}, {"jobs", "vary", "recordings"})
        with self.assertRaises(drycut.BadInput):
            drycut.read_recording("none.yaml")


class HelpTest(unittest.TestCase):
    """help(drycut) is the manual page: every argument and every field is told of."""

    def test_every_argument_is_told(self):
        for name in drycut.__all__:
            call = getattr(drycut, name)
            if inspect.isfunction(call):
                for parameter in inspect.signature(call).parameters:
                    self.assertRegex(call.__doc__, rf"\b{parameter}\b", f"{name}({parameter})")

    def test_every_field_is_told(self):
        for name in drycut.__all__:
            kind = getattr(drycut, name)
            for field in getattr(kind, "_fields", None) or getattr(kind, "__dataclass_fields__", ()):
                self.assertRegex(kind.__doc__, rf"(?m)^ +{field} ", f"{name}.{field}")

    def test_everything_public_has_a_place_in_help(self):
        text = pydoc.plain(pydoc.render_doc(drycut))
        for name in drycut.__all__:
            self.assertTrue(getattr(drycut, name).__doc__, name)
            self.assertIn(name, text)
        for name in ("step", "advance", "read", "write", "unit", "names", "time", "step_length", "duration",
                     "take_events", "checks"):
            self.assertTrue(drycut.Simulation.__dict__[name].__doc__, name)
        self.assertEqual(str(inspect.signature(drycut.Simulation.write)), "(self, /, name, value)")

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_types_are_right_and_seen(self):
        with tempfile.TemporaryDirectory() as folder:
            def mypy(*arguments):
                return subprocess.run(["mypy", "--strict", "--python-executable", sys.executable, "--cache-dir",
                                       os.path.join(folder, "cache"), *arguments], capture_output=True, text=True,
                                      cwd=folder, check=False,
                                      env={**os.environ, "MYPYPATH": os.path.dirname(os.path.dirname(drycut.__file__))}
                                      ).stdout

            self.assertIn("Success", mypy(os.path.dirname(drycut.__file__)))
            uses = {"drycut.run('x.yaml').checks[0].margin + 1": "None", "drycut.run(3)": "run",
                    "drycut.Simulation('x.yaml').write(1, 2)": "str", "drycut.sweep('x.yaml')": "over",
                    "drycut.bode('x.yaml').phase_margin.value": "None",
                    "drycut.fit('x.yaml', recordings=[], vary=[]).parameters['y'].low + 1": "None"}
            for line, told in uses.items():
                with open(os.path.join(folder, "use.py"), "w", encoding="utf-8") as file:
                    file.write(f"import drycut\n{line}\n")
                said = mypy("use.py")
                self.assertIn("use.py:2: error:", said, line)
                self.assertIn(told, said, line)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-q", *sys.argv[1:]])

"""The Python package against the program: same numbers, same problems."""

import csv
import math
import os
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
        self.assertAlmostEqual(line.read("web.speed"), 60, places=6)
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
        self.assertEqual([(c.name, c.passed, c.margin) for c in line.checks()],
                         [(c.name, c.passed, c.margin) for c in run.checks])

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


class HelpTest(unittest.TestCase):
    def test_everything_is_documented(self):
        for name in drycut.__all__:
            self.assertTrue(getattr(drycut, name).__doc__, name)
        for name in ("step", "advance", "read", "write", "unit", "names", "take_events", "checks"):
            self.assertTrue(getattr(drycut.Simulation, name).__doc__, name)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-q"])

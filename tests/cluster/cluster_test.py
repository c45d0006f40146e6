"""drycut sweep, envelope and tune --on dask:// and slurm, on clusters of this machine: cluster_test.py PROGRAM dask|slurm|input

Exit status 77: what the cluster needs is not installed.
"""
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import engines

PROGRAM = os.path.abspath(sys.argv[1])
HERE = os.path.dirname(os.path.abspath(__file__))
KINDS = {"dask": engines.Dask, "slurm": engines.Slurm}
CPU_SECONDS = 2  # a process at a worker that computes for longer is ended by the kernel
SCENE = os.path.join(HERE, "web.yaml")
POINTS = ["sweep", SCENE, "--over", "variables.speed=5..125 m/min:50", "--over", "variables.limit=40..119 m/min:40"]
LONGER = ["sweep", SCENE, "--over", "variables.speed=5..125 m/min:100", "--set", "variables.end=200 s"]


def read(path):
    with open(path, "rb") as file:
        return file.read()


def lines(path):
    return read(path).count(b"\n") if os.path.exists(path) else 0


def at_work():
    """The processes that run chunks."""
    found = []
    for entry in os.listdir("/proc"):
        try:
            words = read(f"/proc/{entry}/cmdline").split(b"\0") if entry.isdigit() else []
        except OSError:
            continue
        if len(words) > 2 and words[1] == b"work" and os.path.basename(words[0]).startswith(b"drycut"):
            found.append(int(entry))
    return found


class ClusterTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.environ["PATH"] = os.path.dirname(PROGRAM) + ":" + os.environ["PATH"]
        cls.engine = KINDS[KIND](cpu_seconds=CPU_SECONDS)
        os.environ.update(cls.engine.environment())

    @classmethod
    def tearDownClass(cls):
        cls.engine.stop()

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def out(self, name):
        return os.path.join(self.folder, name)

    def start(self, words, out, program=PROGRAM, on=True, cpu_seconds=None):
        def limit():
            signal.signal(signal.SIGINT, signal.SIG_DFL)  # whoever runs the tests in the background has it ignored
            if cpu_seconds:
                resource.setrlimit(resource.RLIMIT_CPU, (cpu_seconds, resource.RLIM_INFINITY))

        more = ["--on", self.engine.address] if on else []
        return subprocess.Popen([program, *words, *more, "--out", self.out(out)], stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, cwd=self.folder, preexec_fn=limit)

    def run_it(self, words, out, status=0, **more):
        child = self.start(words, out, **more)
        said, errors = child.communicate()
        self.assertEqual(child.returncode, status, said + errors)
        return said, errors

    def begun(self, child, count, out):
        cache = os.path.join(self.out(out), "points.cache")
        engines.wait_for(lambda: lines(cache) >= count or child.poll() is not None, "points")
        self.assertIsNone(child.poll(), "it was to be met at work")

    def nothing_left(self, *outs):
        for out in outs:
            self.assertEqual([n for n in os.listdir(self.out(out)) if "work" in n], [])
        engines.wait_for(lambda: not at_work(), "chunks to end")
        if KIND == "slurm":
            engines.wait_for(lambda: not self.engine.queue(), "an empty queue")
        else:
            engines.wait_for(lambda: not self.engine.left_behind(), "files at the workers to go")

    def test_same_bytes_of_2000_points(self):
        def timed(words, out, **more):
            begin = time.monotonic()
            used = resource.getrusage(resource.RUSAGE_CHILDREN)
            said = self.run_it(words, out, **more)[0]
            now = resource.getrusage(resource.RUSAGE_CHILDREN)
            return said, time.monotonic() - begin, now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime

        here, here_took, here_used = timed([*POINTS, "--jobs", "2"], "here", on=False)
        there, there_took, there_used = timed(POINTS, "there")
        self.assertIn("\n2000 runs simulated", here)
        self.assertIn("\n2000 runs simulated", there)
        self.assertEqual(read(self.out("here/sweep.csv")), read(self.out("there/sweep.csv")))
        self.nothing_left("there")
        print(f"2000 points: here {here_took:.1f} s and {1000 * here_used / 2000:.2f} ms CPU a point; {KIND} "
              f"{there_took:.1f} s, {1000 * (there_took - here_took) / 2000:.2f} ms a point more; the command itself "
              f"{1000 * there_used / 2000:.2f} ms CPU a point")
        # Nothing is run twice, wherever it ran.
        self.assertIn("\n0 runs simulated", self.run_it(POINTS, "there", on=False)[0])
        self.assertIn("\n0 runs simulated", self.run_it(POINTS, "here")[0])

    def test_same_bytes_when_a_worker_is_killed(self):
        self.run_it(LONGER, "here", on=False)
        child = self.start(LONGER, "there")
        self.begun(child, 10, "there")
        if KIND == "dask":
            killed = self.engine.workers[0]
            killed.kill()
            self.engine.workers[0] = self.engine.add_worker()
        else:
            for process in engines.wait_for(at_work, "a chunk"):
                os.kill(process, signal.SIGKILL)
        said, errors = child.communicate()
        self.assertEqual(child.returncode, 0, said + errors)
        self.assertIn("\n100 runs simulated", said)
        self.assertEqual(read(self.out("here/sweep.csv")), read(self.out("there/sweep.csv")))
        if KIND == "dask":
            shutil.rmtree(killed.folder)  # who is killed clears nothing up; Dask does when it starts there again

    def test_a_poisoned_point_is_told_and_left(self):
        words = ["sweep", SCENE, "--over", "variables.end=0.3,0.4,100000,0.5,0.6,0.7 s"]
        # Slurm's jobs have the limits of who submits them, Dask's those of the worker.
        limit = CPU_SECONDS if KIND == "slurm" else None
        said, errors = self.run_it(words, "there", status=3, cpu_seconds=limit)
        self.assertRegex(errors, r"variables.end=100000 s was lost: whoever ran it died, 3 times: .*")
        self.assertIn("\n5 runs simulated", said)
        rows = read(self.out("there/sweep.csv")).decode().splitlines()
        self.assertEqual([row.split(",")[1] for row in rows[1:]], ["passed", "passed", "lost", "passed", "passed", "passed"])
        self.assertEqual(lines(self.out("there/points.cache")), 5)

    def test_cancelled_leaves_nothing_and_goes_on_anywhere(self):
        self.run_it(LONGER, "here", on=False)
        for number, sign in enumerate((signal.SIGTERM, signal.SIGINT)):
            out = f"there{number}"
            child = self.start(LONGER, out)
            self.begun(child, 5, out)
            child.send_signal(sign)
            said, errors = child.communicate()
            self.assertEqual(child.returncode, -sign, said + errors)
            self.assertFalse(os.path.exists(self.out(out + "/sweep.csv")))
            self.nothing_left(out)
            kept = lines(self.out(out + "/points.cache"))
            said = self.run_it(LONGER, out, on=number == 0)[0]
            self.assertIn(f"\n{100 - kept} runs simulated", said)
            self.assertEqual(read(self.out("here/sweep.csv")), read(self.out(out + "/sweep.csv")))

    def test_killed_itself_the_next_one_clears_up(self):
        child = self.start(LONGER, "there")
        self.begun(child, 5, "there")
        child.kill()
        child.communicate()
        kept = lines(self.out("there/points.cache"))
        self.assertIn(f"\n{100 - kept} runs simulated", self.run_it(LONGER, "there")[0])
        self.nothing_left("there")

    def test_another_version_is_refused(self):
        other = self.out("drycut-other")
        shutil.copy(PROGRAM, other)
        with open(other, "ab") as file:
            file.write(b"another")
        child = self.start(POINTS, "there", program=other)
        os.remove(other)  # so the workers take the one of their PATH
        said, errors = child.communicate()
        self.assertEqual(child.returncode, 3, said + errors)
        self.assertRegex(errors, r"has drycut [0-9.]+ \([0-9a-f]{16}\), the study is drycut [0-9.]+ \([0-9a-f]{16}\)'s")
        self.nothing_left("there")

    def test_every_study(self):
        knife = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../scenes/rotary_knife_lx3vp.yaml")
        for words, file in ((["size", knife, "--motors", "HG-SR202,HG-SR352",
                              "--gears", "5,7"], "size.csv"),
                            (["envelope", SCENE, "--over", "variables.limit=40,60 m/min",
                              "--find-max", "variables.speed=5..300 m/min:8"], "envelope.csv"),
                            (["tune", SCENE, "--vary", "variables.speed=20..90 m/min", "--minimise",
                              "max(abs(web.speed - 61))", "--constraint", "max(web.speed) <= 80", "--budget", "6",
                              "--no-pictures"], "evaluations.csv")):
            with self.subTest(words[0]):
                status = subprocess.run([PROGRAM, *words, "--out", self.out("here-" + words[0])], capture_output=True).returncode
                self.run_it(words, "there-" + words[0], status=status)
                self.assertEqual(read(self.out(f"here-{words[0]}/{file}")), read(self.out(f"there-{words[0]}/{file}")))

    def test_a_scenario_elsewhere_under_the_same_name(self):
        """Refused points name files: the message is the same wherever they are run."""
        words = ["sweep", os.path.relpath(SCENE, self.folder), "--over", "plants.web.speed=50,1e6 m/min"]
        self.run_it(words, "here", on=False)
        self.run_it(words, "there")
        self.assertEqual(read(self.out("here/sweep.csv")), read(self.out("there/sweep.csv")))


@unittest.skipUnless(sys.argv[2] == "slurm", "of Slurm")
class SlurmTest(ClusterTest):
    def test_partitions_are_looked_at_first(self):
        for on, told in (("slurm:mian", "--on:1:1: slurm: there is no partition 'mian'; did you mean main?"),
                         ("slurm:closed", "--on:1:1: slurm: partition closed is down; "),
                         ("slurm:", "it names no partition")):
            with self.subTest(on):
                done = subprocess.run([PROGRAM, *POINTS, "--on", on, "--out", self.out("there")], capture_output=True, text=True)
                self.assertEqual(done.returncode, 2)
                self.assertIn(told, done.stderr)
                self.assertFalse(os.path.exists(self.out("there")))

    def test_a_stage_of_its_own(self):
        stage = self.out("stage")
        os.mkdir(stage)
        self.run_it([*LONGER, "--set", "variables.end=1 s", "--stage", stage], "there")
        self.assertEqual(os.listdir(stage), [])


class InputTest(unittest.TestCase):
    def test_what_is_wrong_is_told_within_seconds(self):
        port = engines.free_port()
        cases = [("foo://x", "'foo://x' is no engine"), ("dask://127.0.0.1", "is no scheduler; dask://HOST:PORT"),
                 ("dask://127.0.0.1:port", "'port' is no port"), ("dask://127.0.0.1:70000", "'70000' is no port"),
                 ("slurmy", "'slurmy' is no engine")]
        if engines.PYTHON:
            cases.append((f"dask://127.0.0.1:{port}", "--on:1:1: dask://127.0.0.1:%d: no scheduler answers there" % port))
        with tempfile.TemporaryDirectory() as folder:
            for on, told in cases:
                for words in (POINTS, ["tune", SCENE, "--vary", "variables.speed=20..90 m/min", "--minimise", "max(web.speed)"]):
                    with self.subTest(on + " " + words[0]):
                        done = subprocess.run([PROGRAM, *words, "--on", on, "--out", folder + "/out"], capture_output=True,
                                              text=True, timeout=60)
                        self.assertEqual(done.returncode, 2, done.stderr)
                        self.assertIn(told, done.stderr)
                        self.assertFalse(os.path.exists(folder + "/out"))

    def told(self, words, path):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([PROGRAM, *POINTS, *words, "--out", folder + "/out"], capture_output=True, text=True,
                                  env={**os.environ, "PATH": path}, timeout=60)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(os.listdir(folder), [])
            return done.stderr

    def test_what_is_missing_is_told(self):
        self.assertIn("slurm: there is no sinfo; install slurm-client", self.told(["--on", "slurm"], "/nowhere"))
        self.assertIn("--stage:1:1: nothing is staged for runs here", self.told(["--stage", "/tmp"], "/nowhere"))
        self.assertIn("--stage:1:1: there is no folder /nowhere", self.told(["--on", "slurm", "--stage", "/nowhere"], "/nowhere"))
        self.assertIn("--stage:1:1: a Dask cluster needs no shared folder",
                      self.told(["--on", "dask://127.0.0.1:1", "--stage", "/tmp"], "/nowhere"))

    def test_work_tells_what_is_no_bundle(self):
        for text, status in ((b"nonsense", 3), (None, 2)):
            with tempfile.TemporaryDirectory() as folder:
                if text:
                    with open(folder + "/bundle", "wb") as file:
                        file.write(text)
                done = subprocess.run([PROGRAM, "work", folder + "/bundle"], capture_output=True, text=True)
                self.assertEqual(done.returncode, status)
                self.assertRegex(done.stderr, "/bundle:")


KIND = sys.argv.pop(2)
del sys.argv[1]
if KIND in KINDS and KINDS[KIND].missing:
    print(f"skipped: {KIND} needs {KINDS[KIND].missing}")
    sys.exit(77)
NAMES = {"dask": ClusterTest, "slurm": SlurmTest, "input": InputTest}
if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]] if len(sys.argv) > 1 else [sys.argv[0], NAMES[KIND].__name__])

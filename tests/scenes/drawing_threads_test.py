#!/usr/bin/env python3
"""Threads that draw at the same time leave each other's memory alone.

All OpenGL contexts of a process share one rasteriser. A thread that reads what another is writing goes well by luck: glibc's
MALLOC_PERTURB_ fills new and freed memory with a value, so that it ends in a crash or in other pixels instead.

    drawing_threads_test.py DRYCUT one   one size, some seconds
    drawing_threads_test.py DRYCUT all   ten sizes x four values x --jobs 1 and 2, some minutes
"""
import hashlib
import os
import pathlib
import subprocess
import sys
import tempfile

SCENES = pathlib.Path(__file__).parents[2] / "scenes"
SIZES = ["161x161", "160x160", "320x180", "333x177", "480x270", "481x271", "640x360", "641x361", "960x540", "961x541"]
FILLS = [1, 85, 170, 255]


def frames(program, size, fill, jobs, seconds, folder):
    """Hashes of the frames by name. With one job a scene has all the threads, with two the scenes share them."""
    scenes = ["rotary_knife"] if jobs == 1 else ["rotary_knife", "flying_saw", "press_learning", "wire_guide"]
    settings = {"scene.duration": f"{seconds} s", "pictures.frames.from": "0 s", "pictures.frames.until": f"{seconds} s",
                "pictures.frames.every": "1 ms", "pictures.frames.size": size, "pictures.view": "off", "pictures.video": "off"}
    command = [program, "run", *(str(SCENES / f"{name}.yaml") for name in scenes), "--jobs", str(jobs), "--out", str(folder)]
    for path, value in settings.items():
        command += ["--set", f"{path}={value}"]
    run = subprocess.run(command, env={**os.environ, "MALLOC_PERTURB_": str(fill)}, capture_output=True, text=True)
    what = f"{size}, MALLOC_PERTURB_={fill}, --jobs {jobs}"
    # So short a run fails its checks, which is 1.
    if run.returncode not in (0, 1):
        sys.exit(f"{what}: ended with {run.returncode}\n{run.stdout[-2000:]}{run.stderr[-2000:]}")
    found = {str(file.relative_to(folder)): hashlib.sha256(file.read_bytes()).hexdigest()
             for file in sorted(pathlib.Path(folder).glob("*/frames/*.png"))}
    if len(found) < len(scenes) * seconds / 0.001:
        sys.exit(f"{what}: {len(found)} frames\n{run.stdout[-2000:]}")
    return found


def main(program, kind):
    first = {}

    def draw(size, fill, jobs, seconds):
        with tempfile.TemporaryDirectory() as folder:
            for name, pixels in frames(program, size, fill, jobs, seconds, folder).items():
                if first.setdefault((size, name), pixels) != pixels:
                    sys.exit(f"{size}, MALLOC_PERTURB_={fill}, --jobs {jobs}: {name} differs")

    if kind == "one":
        for _ in range(4):
            draw("161x161", 85, 1, 0.2)
        return
    for size in SIZES:
        for fill in FILLS:
            for jobs in (1, 2):
                draw(size, fill, jobs, 0.1)
        print(f"{size}: same pixels {len(FILLS) * 2} times", flush=True)


main(*sys.argv[1:])

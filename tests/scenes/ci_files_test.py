"""The files for CI that `drycut new` writes: sound YAML, of the keys that GitHub and GitLab know, and the command
lines in them run as they stand, in the folder they were made for. Skipped where yamllint is not installed."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

try:
    import yaml
    from yamllint import config, linter
except ImportError:
    print("skipped without python3-yaml and yamllint")
    sys.exit(77)

RULES = config.YamlLintConfig(
    "extends: default\nrules: {document-start: disable, truthy: {check-keys: false}, line-length: {max: 125}}"
)
STEP = {"name", "uses", "with", "run", "env", "if", "id", "shell", "working-directory", "continue-on-error", "timeout-minutes"}
JOB = {"runs-on", "container", "steps", "needs", "if", "env", "permissions", "strategy", "timeout-minutes", "defaults"}
WORKFLOW = {"name", True, "permissions", "jobs", "env", "defaults", "concurrency"}  # YAML 1.1 reads `on` as true
GITLAB_JOB = {"image", "before_script", "script", "after_script", "cache", "artifacts", "rules", "variables", "stage"}


def sound(file):
    text = file.read_text(encoding="utf-8")
    found = [f"{file}:{p.line}:{p.column}: {p.desc}" for p in linter.run(text, RULES)]
    assert not found, "\n".join(found)
    return yaml.safe_load(text)


def github_commands(file):
    workflow = sound(file)
    assert set(workflow) <= WORKFLOW, set(workflow) - WORKFLOW
    assert set(workflow[True]) == {"push", "pull_request"}
    commands = []
    for job in workflow["jobs"].values():
        assert set(job) <= JOB, set(job) - JOB
        for step in job["steps"]:
            assert set(step) <= STEP, set(step) - STEP
            assert ("run" in step) != ("uses" in step), step
            if "uses" in step:
                assert re.fullmatch(r"actions/[a-z-]+@v[0-9]+", step["uses"]), step["uses"]
            commands += step.get("run", "").splitlines()
    return commands


def gitlab_commands(file):
    jobs = sound(file)
    commands = []
    for job in jobs.values():
        assert set(job) <= GITLAB_JOB, set(job) - GITLAB_JOB
        assert set(job["artifacts"]["reports"]) == {"junit", "codequality"}
        commands += job["before_script"] + job["script"]
    return jobs, commands


def run(command, folder, environment):
    return subprocess.run(["sh", "-ec", command], cwd=folder, env=environment, capture_output=True, text=True, check=False)


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary) / "line"
        subprocess.run(
            [program, "new", folder, "--from", "rotary_knife", "--controller", "qmove"], check=True, capture_output=True
        )
        github = github_commands(folder / ".github/workflows/drycut.yml")
        jobs, gitlab = gitlab_commands(folder / ".gitlab-ci.yml")
        summary = pathlib.Path(temporary) / "step_summary.md"
        summary.touch()
        environment = os.environ | {
            "PATH": f"{program.parent}:{os.environ['PATH']}",
            "GITHUB_STEP_SUMMARY": str(summary),
        }
        for commands in (github, gitlab):
            for command in commands:  # the shell reads all of them
                assert run("exit 0\n" + command, folder, environment).returncode == 0, command
            guard = [command for command in commands if 'test -n "$DRYCUT_DEB"' in command]
            assert len(guard) == 1, commands
            assert run(guard[0], folder, environment | {"DRYCUT_DEB": ""}).returncode == 1
            assert run(guard[0], folder, environment | {"DRYCUT_DEB": "https://host/drycut.deb"}).returncode == 0
        short = " --no-pictures --set 'scene.duration=9 s'"
        for commands in (github, gitlab):
            mine = [command for command in commands if command.startswith("drycut ")]
            assert len(mine) == 1, commands
            done = run(mine[0] + short, folder, environment)
            assert done.returncode == 0, done.stdout + done.stderr
        assert "unchanged" in done.stdout, "the second took the results of the first: " + done.stdout
        assert summary.read_text(encoding="utf-8").startswith("## Drycut: the one scene passed")
        artifacts = jobs["line"]["artifacts"]
        xml.etree.ElementTree.parse(folder / artifacts["reports"]["junit"])
        assert json.loads((folder / artifacts["reports"]["codequality"]).read_text(encoding="utf-8")) == []
        for path in artifacts["paths"] + jobs["line"]["cache"]["paths"]:
            assert (folder / path).is_dir(), path
        # What comes into being is not for the repository.
        ignored = (folder / ".gitignore").read_text(encoding="utf-8").split()
        assert set(ignored) == {"out/", ".drycut-cache/", artifacts["reports"]["codequality"]}, ignored
        # A check that fails stands at its line.
        line = folder / "line.yaml"
        text = line.read_text(encoding="utf-8")
        line.write_text(text.replace("<= 0.2 mm", "<= -1 mm"), encoding="utf-8")
        done = run(next(c for c in github if c.startswith("drycut ")) + short, folder, environment)
        assert done.returncode == 1, done.stdout + done.stderr
        number = 1 + text[: text.index("<= 0.2 mm")].count("\n")
        assert f"\n::error file=line.yaml,line={number},col=" in done.stdout, done.stdout
    print("the files for CI are sound, and do what they are for")


if __name__ == "__main__":
    main()

// What is missing is said before the line starts.
import assert from "node:assert/strict";
import { copyFileSync, chmodSync, mkdirSync, symlinkSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { folder, program, Program, scenes } from "./bench.mjs";

const knife = `${scenes}/rotary_knife.yaml`;

/// The program alone in a folder, with what `more` puts beside it.
function alone(name, more = () => {}) {
  const here = join(folder, name);
  mkdirSync(here, { recursive: true });
  const copy = join(here, "drycut");
  copyFileSync(program, copy);
  chmodSync(copy, 0o755);
  more(here);
  return copy;
}

async function refused(copy, env, ...words) {
  const { child, ended, said } = await start(copy, env);
  assert.deepEqual(await ended, { status: 2, signal: null }, said());
  for (const word of words) assert.ok(said().includes(word), said());
  assert.ok(!said().includes("the line:"));
  return child;
}

async function start(copy, env) {
  const { spawn } = await import("node:child_process");
  const child = spawn(copy, ["live", knife, "--port", "0", "--opcua", "0"], { env: { ...process.env, ...env }, stdio: ["ignore", "pipe", "pipe"] });
  let said = "";
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (data) => (said += data));
  const ended = new Promise((resolve) => child.on("close", (status, signal) => resolve({ status, signal })));
  return { child, ended, said: () => said };
}

test("no gateway beside the program", () => refused(alone("bare"), {}, "--opcua", "there is no OPC UA gateway", "make opcua"));

test("a gateway without its packages", () =>
  refused(
    alone("unpacked", (here) => {
      mkdirSync(join(here, "opcua"));
      copyFileSync(join(process.env.DRYCUT_OPCUA, "gateway.mjs"), join(here, "opcua", "gateway.mjs"));
    }),
    {},
    "the packages of the OPC UA gateway are missing",
    "npm ci",
  ));

test("no Node.js", () => {
  const empty = join(folder, "empty");
  mkdirSync(empty);
  return refused(program, { PATH: empty }, "there is no Node.js", "apt install nodejs");
});

test("a Node.js that is too old", async () => {
  const { writeFileSync } = await import("node:fs");
  const old = join(folder, "old");
  mkdirSync(old);
  writeFileSync(join(old, "node"), "#!/bin/sh\necho v16.20.1\n", { mode: 0o755 });
  return refused(program, { PATH: `${old}:${process.env.PATH}` }, "node is too old: v16.20.1", "18");
});

test("an installed program finds its gateway in share", async () => {
  const copy = alone("usr/bin", () => {
    const share = join(folder, "usr/share/drycut");
    mkdirSync(share, { recursive: true });
    symlinkSync(process.env.DRYCUT_OPCUA, join(share, "opcua"));
  });
  const { child, ended, said } = await start(copy, {});
  while (!said().includes("OPC UA: opc.tcp://127.0.0.1:") && child.exitCode === null) await new Promise((resolve) => setTimeout(resolve, 20));
  assert.match(said(), /OPC UA: opc\.tcp/);
  child.kill("SIGINT");
  assert.equal((await ended).status, 130);
});

for (const port of ["-1", "65536", "x"])
  test(`--opcua ${port} is no port`, async () => {
    const live = new Program(["live", knife, "--opcua", port]);
    assert.equal((await live.ended).status, 2);
    assert.match(live.said, /--opcua/);
  });

// What a client writes is part of the session: it runs again to the byte.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { DataType, folder, Program, scene, scenes, Session, start_line, until } from "./bench.mjs";

test("a session with writes of a client runs again to the byte", async () => {
  const file = scene("knife.yaml", `extends: ${scenes}/rotary_knife.yaml\n`);
  const out = join(folder, "session");
  const line = await start_line(file, "--record", out, "--paused");
  const client = await Session.open(line.url);
  assert.equal(await client.write("Line/Pace", DataType.Double, 0), "GoodCompletesAsynchronously");
  await client.write("Panel/start", DataType.Boolean, true);
  assert.equal(await client.call("Line/Step", [DataType.Double, 1]), "Good");
  await until(async () => !(await client.value("Line/Running")));
  await client.write("Line/Pace", DataType.Double, 1);
  await client.call("Line/Start");
  assert.equal(await client.write("Plants/web/Settings/speed", DataType.Double, 48.5), "Good");
  assert.equal(await client.write("Faults/web.wheel/slip", DataType.Double, 1.5), "Good");
  assert.equal(await client.write("Controllers/qmove/slLength", DataType.Int32, 790), "Good");
  const reached = await client.value("Line/Time");
  await until(async () => (await client.value("Line/Time")) > reached + 0.3);
  await client.call("Line/Stop");
  await client.close();
  await line.end();
  const session = readFileSync(join(out, "1", "session.yaml"), "utf8");
  for (const act of [/panel\.start: 1/, /web\.speed: 48\.5/, /web\.wheel: \{slip: 1\.5/, /slLength: 790/]) assert.match(session, act);
  const again = join(folder, "again");
  const replay = new Program(["replay", join(out, "1"), "--out", again, "--no-pictures"]);
  const { status } = await replay.ended;
  assert.ok(status === 0 || status === 1, replay.said);
  for (const name of ["trace.csv", "events.csv"])
    assert.ok(readFileSync(join(again, "session", name)).equals(readFileSync(join(out, "1", name))), name);
});

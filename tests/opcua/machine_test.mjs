// States of the machine where the scenario's section opcua says which values mean them.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { DataType, Program, scene, scenes, Session, start_line, until } from "./bench.mjs";

const { Int32 } = DataType;
const saw = (opcua) => `extends: ${scenes}/flying_saw_lx3vp.yaml\ntimeline: []\nopcua: ${opcua}\n`;
const registers = "Controllers/lx3vp";
let line;
let client;

// Registers that the program fills in its first scan and then leaves alone.
before(async () => {
  line = await start_line(scene("saw.yaml", saw("{packml: {state: D510, mode: D511}, machinery: {out_of_service: D512, mode: D1030}}")));
  client = await Session.open(line.url);
  assert.equal(await client.write(`${registers}/D512`, Int32, 0), "Good");
  await until(async () => (await client.value(`${registers}/D512`)) === 0);
});
after(async () => {
  await client?.close();
  await line?.end();
});

const state = async (path) => {
  const { value, statusCode } = await client.read(path);
  return statusCode.name === "Good" ? value.value.text : statusCode.name;
};
const child = async (path, name) => (await client.children(path)).find((one) => one.name === name).nodeId;

for (const [number, base, machine, execute, item] of [
  [0, "BadStateNotActive", "BadStateNotActive", "BadStateNotActive", "NotExecuting"],
  [1, "Cleared", "Clearing", "BadStateNotActive", "NotExecuting"],
  [2, "Cleared", "Stopped", "BadStateNotActive", "NotExecuting"],
  [3, "Cleared", "Running", "Starting", "Executing"],
  [4, "Cleared", "Running", "Idle", "NotExecuting"],
  [5, "Cleared", "Running", "Suspended", "NotExecuting"],
  [6, "Cleared", "Running", "Execute", "Executing"],
  [7, "Cleared", "Stopping", "BadStateNotActive", "NotExecuting"],
  [8, "Aborting", "BadStateNotActive", "BadStateNotActive", "NotExecuting"],
  [9, "Aborted", "BadStateNotActive", "BadStateNotActive", "NotExecuting"],
  [10, "Cleared", "Running", "Holding", "Executing"],
  [11, "Cleared", "Running", "Held", "NotExecuting"],
  [12, "Cleared", "Running", "Unholding", "Executing"],
  [13, "Cleared", "Running", "Suspending", "Executing"],
  [14, "Cleared", "Running", "Unsuspending", "Executing"],
  [15, "Cleared", "Running", "Resetting", "NotExecuting"],
  [16, "Cleared", "Running", "Completing", "Executing"],
  [17, "Cleared", "Running", "Complete", "NotExecuting"],
])
  test(`PackML state ${number}`, async () => {
    assert.equal(await client.write(`${registers}/D510`, Int32, number), "Good");
    await until(async () => (await client.value(`${registers}/D510`)) === number);
    const first = await child("PackML", "BaseStateMachine");
    const second = await child(first, "MachineState");
    const third = await child(second, "ExecuteState");
    const machines = [first, second, third];
    const seen = [];
    for (const one of machines) seen.push(await state(await child(one, "CurrentState")));
    assert.deepEqual(seen, [base, machine, execute]);
    // The Id is the node of that state in the type.
    for (const [i, one] of machines.entries()) {
      const { value, statusCode } = await client.read(await child(await child(one, "CurrentState"), "Id"));
      if (statusCode.name !== "Good") continue;
      const name = await client.session.read({ nodeId: value.value, attributeId: 3 });
      assert.equal(name.value.value.name, seen[i]);
    }
    assert.equal(await state(await child("MachineryItemState", "CurrentState")), item);
  });

test("modes, and a machine out of service", async () => {
  await client.write(`${registers}/D511`, Int32, 3);
  await client.write(`${registers}/D1030`, Int32, 2);
  await client.write(`${registers}/D512`, Int32, 1);
  const item = await child("MachineryItemState", "CurrentState");
  await until(async () => (await state(item)) === "OutOfService");
  assert.equal(await state(await child("MachineryOperationMode", "CurrentState")), "Setup");
  const status = await child("PackML", "Status");
  assert.equal(await client.value(await child(status, "UnitModeCurrent")), 3);
});

test("a saw tells whether its clamps grip", async () => {
  assert.equal(typeof (await client.value("Cutter/saw/SideClampClosed")), "boolean");
  const { statusCode } = await client.read("Cutter/saw/CuttingProducts/CuttingProduct_1/Length");
  assert.equal(statusCode.name, "BadConfigurationError");
});

for (const [opcua, place, what, remedy] of [
  ["{packml: {state: D11O0}}", "3:25", "there is no value 'D11O0'", "."],
  ["{packml: {mode: D511}}", "3:17", "state", "name the value that holds the number of the PackML state"],
  ["{packml: {state: saw.spede}}", "3:25", "there is no value 'saw.spede'", "saw.speed"],
  ["{machinery: {}}", "3", "says nothing", "executing: "],
  ["{machinery: {executing: M1O, mode: saw.spede}}", "3:43", "there is no value 'saw.spede'", "saw.speed"],
  ["{cutters: {sow: {length: DD100}}}", "3:19", "no plant 'sow' cuts", "saw"],
  ["{cutters: {tube: {length: DD100}}}", "3:19", "no plant 'tube' cuts", "saw"],
  ["{cutters: {saw: {lenght: DD100}}}", "3", "lenght", "length"],
  ["{cutters: {saw: {}}}", "3", "length", "name the value"],
  ["{machine: {maker: Weber}}", "3:19", "maker", "manufacturer"],
])
  test(`opcua: ${opcua} is refused with its place`, async () => {
    const file = scene("wrong.yaml", saw(opcua));
    const check = new Program(["check", file]);
    const { status } = await check.ended;
    assert.equal(status, 2, check.said);
    const told = check.said.split("\n").find((words) => words.includes(what)) ?? check.said;
    assert.ok(told.startsWith(`${file}:${place}`), check.said);
    assert.ok(check.said.includes(remedy), check.said);
  });

test("what it says is written back by --expand, and nothing where it says nothing", async () => {
  const all = "{machine: {manufacturer: Weber, model: FS, serial_number: A1}, packml: {state: D510, mode: D511}, machinery: {executing: M11}, cutters: {saw: {length: DD100}}}";
  const expanded = new Program(["check", "--expand", scene("whole.yaml", saw(all))]);
  assert.equal((await expanded.ended).status, 0, expanded.said);
  for (const words of ["manufacturer: Weber", "model: FS", "serial_number: A1", "state: D510", "mode: D511", "executing: M11", "length: DD100"]) assert.ok(expanded.said.includes(words), words);
  const none = new Program(["check", "--expand", `${scenes}/flying_saw_lx3vp.yaml`]);
  assert.equal((await none.ended).status, 0);
  assert.ok(!none.said.includes("opcua"));
});

// What a client finds of a line, reads, writes, calls and is told.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { AttributeIds, constructEventFilter, DataType, scene, scenes, Session, start_line, until } from "./bench.mjs";

const { Boolean: Bool, Double, Int32, String: Words } = DataType;
let line;
let client;

before(async () => {
  const file = scene(
    "knife.yaml",
    `extends: ${scenes}/rotary_knife.yaml
opcua:
  machine: {manufacturer: Weber, model: RK 2, serial_number: "0123"}
  cutters: {knife: {length: slLength}}
`,
  );
  line = await start_line(file, "--paused");
  client = await Session.open(line.url);
});
after(async () => {
  await client?.close();
  const { status } = await line.end();
  assert.equal(status, 130);
});

test("the line has what its page has", async () => {
  const { line: described } = await (await fetch(new URL("line.json", line.page))).json();
  const plants = described.plants.map(({ name }) => name);
  const of = (name) => (plants.includes(name.split(".")[0]) ? "plant" : name.startsWith("panel.") ? "panel" : "controller");
  const own = (kind) => described.channels.map(({ name }) => name).filter((name) => of(name) === kind);
  assert.deepEqual((await client.names("Controllers/qmove")).sort(), own("controller").sort());
  const channels = (await Promise.all(plants.map((plant) => client.names(`Plants/${plant}/Channels`)))).flat();
  assert.equal(channels.length, own("plant").length);
  assert.ok(own("controller").length > 50 && channels.length > 30);
  const settings = (await Promise.all(plants.map((plant) => client.names(`Plants/${plant}/Settings`)))).flat();
  assert.equal(settings.length, described.targets.filter((target) => !target.panel).length);
  assert.deepEqual((await client.names("Panel")).sort(), own("panel").map((name) => name.slice("panel.".length)).sort());
  const components = await client.names("Faults");
  const faults = (await Promise.all(components.map((name) => client.names(`Faults/${name}`)))).flat();
  assert.equal(faults.length, described.faults.length);
  assert.deepEqual(await client.names("Checks"), described.checks);
  assert.equal(await client.value("Line/Title"), described.title);
  assert.deepEqual(await client.value("Line/Notes"), described.notes);
});

test("every value can be read in one go", async () => {
  const names = await client.names("Controllers/qmove");
  const nodes = names.map((name) => ({ nodeId: client.node(`Controllers/qmove/${name}`), attributeId: AttributeIds.Value }));
  const values = await client.session.read(nodes);
  assert.deepEqual([...new Set(values.map(({ statusCode }) => statusCode.name))], ["Good"]);
  assert.equal(values.length, names.length);
});

for (const { path, type, unit, code, range, writable } of [
  { path: "Plants/web/Settings/speed", type: Double, unit: "m/min", code: "2X", range: [-1000, 1000], writable: true },
  { path: "Plants/knife/Settings/drum_inertia", type: Double, unit: "kg·m²", code: "B32", range: [1e-5, 1e4], writable: true },
  { path: "Plants/knife/Channels/cut.length", type: Double, unit: "mm", code: "MMT" },
  { path: "Plants/knife/Channels/motor.torque", type: Double, unit: "N·m", code: "NU" },
  { path: "Plants/knife/Channels/angle", type: Double, unit: "°", code: "DD" },
  { path: "Controllers/qmove/AxisX.posit", type: Int32, unit: "Um", code: -1, range: [-999999, 999999], writable: true },
  { path: "Controllers/qmove/slLength", type: Int32, range: [-2147483648, 2147483647], writable: true },
  { path: "Controllers/qmove/AxisX.st_sync", type: Double },
  { path: "Panel/start", type: Bool, writable: true },
  { path: "Panel/in_sync", type: Bool },
  { path: "Faults/web.wheel/slip", type: Double, unit: "%", code: "P1", range: [-100, 100], writable: true },
  { path: "Faults/web.wheel/stuck", type: Bool, writable: true },
  { path: "Faults/web.wheel/lose_counts", type: Int32, range: [-2147483648, 2147483647], writable: true },
  { path: "Line/Pace", type: Double, range: [0, 10000], writable: true },
  { path: "Line/Time", type: Double, unit: "s", code: "SEC" },
])
  test(`${path}: type, unit, range, access`, async () => {
    const { value } = await client.read(path, AttributeIds.DataType);
    assert.equal(value.value.value, type);
    const access = (await client.read(path, AttributeIds.AccessLevel)).value.value;
    assert.equal((access & 2) !== 0, writable ?? false);
    const names = await client.names(path);
    assert.equal(names.includes("EngineeringUnits"), unit !== undefined);
    if (unit) {
      const info = await client.value(`${path}/EngineeringUnits`);
      assert.equal(info.displayName.text, unit);
      const id = code === -1 ? -1 : [...code].reduce((sum, letter) => sum * 256 + letter.charCodeAt(0), 0);
      assert.equal(info.unitId, id);
    }
    if (type !== Bool) assert.equal(names.includes("EURange"), range !== undefined);
    if (range) {
      const { low, high } = await client.value(`${path}/EURange`);
      assert.deepEqual([low, high], range);
    }
  });

for (const [path, type, value, status] of [
  ["Plants/web/Settings/speed", Words, "fast", "BadTypeMismatch"],
  ["Plants/web/Channels/position", Double, 1, "BadNotWritable"],
  ["Controllers/qmove/AxisX.st_sync", Double, 1, "BadNotWritable"],
  ["Faults/web.wheel/stuck", Double, 1, "BadTypeMismatch"],
  ["Panel/in_sync", Bool, true, "BadNotWritable"],
  ["Line/Title", Words, "mine", "BadNotWritable"],
])
  test(`${path} does not take ${value}: ${status}`, async () => {
    assert.equal(await client.write(path, type, value), status);
  });

for (const [path, value, words] of [
  ["Plants/web/Settings/speed", 1e6, /web\.speed does not hold 1000000; write -1000 to 1000 m\/min/],
  ["Plants/knife/Settings/drum_inertia", 1e9, /knife\.drum_inertia does not hold 1000000000; write 1e-05 to 10000 kg m2/],
  ["Faults/web.wheel/slip", 101, /web\.wheel\.slip does not hold 101; write -100 to 100 %/],
  ["Line/Pace", -1, /pace is a number from 0\.0001 to 10000/],
])
  test(`why ${path} does not take ${value} is told in the line's words`, async () => {
    const subscription = await client.subscription();
    const filter = constructEventFilter(["SourceName", "Message", "Severity"]);
    const events = await client.monitor("i=2253", subscription, { attributeId: AttributeIds.EventNotifier, filter });
    assert.equal(await client.write(path, Double, value), "BadOutOfRange");
    const [, message, severity] = await events.next(([name]) => name.value === path);
    assert.match(message.value.text, words);
    assert.equal(severity.value, 500);
    await subscription.terminate();
  });

test("the line stands still, steps, runs, waits for an event, begins anew", async () => {
  assert.equal(await client.value("Line/Running"), false);
  assert.equal(await client.value("Line/Time"), 0);
  assert.equal(await client.call("Line/Step", [Double, 0.002]), "Good");
  await until(async () => (await client.value("Line/Time")) === 0.002);
  assert.equal(await client.call("Line/Step", [Double, -1]), "BadInvalidArgument");
  assert.equal(await client.call("Line/Step", [Words, "1 ms"]), "BadTypeMismatch");
  // What is written while it stands acts in the next step.
  assert.equal(await client.write("Plants/web/Settings/speed", Double, 55), "GoodCompletesAsynchronously");
  assert.equal(await client.call("Line/Step", [Double, 0.001]), "Good");
  await until(async () => (await client.value("Plants/web/Settings/speed")) === 55);
  assert.equal(await client.call("Line/Restart"), "Good");
  await until(async () => (await client.value("Line/Number")) === 2);
  assert.equal(await client.value("Line/Time"), 0);
  assert.notEqual(await client.value("Plants/web/Settings/speed"), 55);
  assert.equal(await client.write("Line/Pace", Double, 0), "GoodCompletesAsynchronously");
  assert.equal(await client.call("Line/RunUntil", [Words, "knife.cut"]), "Good");
  await until(async () => !(await client.value("Line/Running")) && (await client.value("Plants/knife/Channels/cut.number")) > 0);
  assert.equal(await client.value("Plants/knife/Channels/cut.number"), 1);
  assert.equal(await client.write("Line/Pace", Double, 1), "GoodCompletesAsynchronously");
  assert.equal(await client.call("Line/Start"), "Good");
  assert.equal(await client.value("Line/Running"), true);
  assert.equal(await client.write("Plants/web/Settings/speed", Double, 50), "Good");
  assert.equal(await client.value("Plants/web/Settings/speed"), 50);
  assert.equal(await client.call("Line/Stop"), "Good");
  assert.equal(await client.value("Line/Running"), false);
  assert.equal(await client.write("Line/Running", Bool, true), "Good");
});

test("values, settings and faults that are watched are told as they change", async () => {
  const subscription = await client.subscription();
  const position = await client.monitor("Plants/web/Channels/position", subscription);
  const first = (await position.next(() => true)).value.value;
  await position.next(({ value }) => value.value > first + 10);
  const slip = await client.monitor("Faults/web.wheel/slip", subscription);
  const before = await slip.next(() => true);
  assert.equal(before.statusCode.name, "UncertainInitialValue");
  assert.equal(await client.write("Faults/web.wheel/slip", Double, 2), "Good");
  await slip.next(({ value, statusCode }) => value.value === 2 && statusCode.name === "Good");
  const checks = await client.monitor("Checks/locks on/Passed", subscription);
  await checks.next(({ value }) => typeof value.value === "boolean");
  // In thirds of the line's news and no faster.
  assert.ok(position.item.monitoringParameters.samplingInterval >= 30);
  await subscription.terminate();
});

test("cuts are events, also those of OPC 40084-9", async () => {
  const subscription = await client.subscription();
  const type = `ns=${client.index};s=`;
  const own = [`${client.index}:Event`, `${client.index}:ValueNames`, `${client.index}:Values`, `${client.index}:Units`, `${client.index}:MachineTime`];
  const filter = constructEventFilter(["SourceName", "Severity", "EventType", "Message", ...own]);
  const events = await client.monitor("Line", subscription, { attributeId: AttributeIds.EventNotifier, filter });
  const [source, severity, event_type, message, , names, values, units, time] = await events.next((fields) => fields[4].value === "cut");
  assert.equal(source.value, "knife");
  assert.equal(severity.value, 100);
  assert.equal(event_type.value.toString(), `${type}LineEventType`);
  assert.match(message.value.text, /^knife cut length=\d/);
  assert.deepEqual(names.value, ["length", "mismatch", "force", "number"]);
  assert.deepEqual(units.value, ["mm", "mm/s", "N", ""]);
  assert.ok(values.value[0] > 500 && values.value[0] < 1000);
  assert.ok(time.value > 0);
  const cutter = client.namespaces.indexOf("http://opcfoundation.org/UA/PlasticsRubber/Extrusion_v2/Cutter/");
  const of_cut = constructEventFilter(["EventType", `${cutter}:CuttingProductId`, `${cutter}:ActualOutput`, `${cutter}:TotalOutput`, `${client.index}:Length`]);
  const cuts = await client.monitor("Cutter/knife", subscription, { attributeId: AttributeIds.EventNotifier, filter: of_cut });
  const [cut_type, , actual, total, length] = await cuts.next(() => true);
  assert.equal(cut_type.value.toString(), `${type}LineCutEventType`);
  assert.deepEqual(actual.value, total.value);
  assert.ok(actual.value[1] >= 2);
  assert.ok(length.value > 500 && length.value < 1000);
  await subscription.terminate();
});

test("the machine has its name plate, and the knife is a cutter of OPC 40084-9", async () => {
  const machinery = client.namespaces.indexOf("http://opcfoundation.org/UA/Machinery/");
  const machines = await client.children(`ns=${machinery};i=1001`);
  assert.ok(machines.some(({ nodeId }) => nodeId === client.node("Line")));
  assert.ok(machines.some(({ name }) => name === "Cutter_Weber_0123"));
  const plate = Object.fromEntries((await client.children("Identification")).map(({ name, nodeId }) => [name, nodeId]));
  assert.equal((await client.value(plate.Manufacturer)).text, "Weber");
  assert.equal((await client.value(plate.Model)).text, "RK 2");
  assert.equal(await client.value(plate.SerialNumber), "0123");
  const cutter = client.namespaces.indexOf("http://opcfoundation.org/UA/PlasticsRubber/Extrusion_v2/Cutter/");
  const [knife] = machines.filter(({ name }) => name === "Cutter_Weber_0123");
  assert.equal(knife.type, `ns=${cutter};i=1005`);
  const product = "Cutter/knife/CuttingProducts/CuttingProduct_1";
  assert.equal(await client.value(`${product}/Length`), await client.value("Controllers/qmove/slLength"));
  const [, count] = await client.value(`${product}/TotalOutput`);
  assert.ok(count > 0 && count <= (await client.value("Plants/knife/Channels/cut.number")));
  assert.equal((await client.value(`${product}/Length/EngineeringUnits`)).displayName.text, "mm");
  const speed = await client.value("Cutter/knife/ProductSpeed/ActualValue");
  assert.ok(speed > 0 && speed < 100);
  assert.equal(await client.write(`${product}/Length`, Double, 750), "Good");
  await until(async () => (await client.value("Controllers/qmove/slLength")) === 750);
});

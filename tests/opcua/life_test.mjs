// Who ends with whom: the line, its gateway, their clients; and who may come in.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { alive, DataType, folder, MessageSecurityMode, OPCUAClient, Program, scene, SecurityPolicy, Session, start_line, until, UserTokenType } from "./bench.mjs";

const web = scene(
  "web.yaml",
  `scene: {title: A web, step: 1 ms, duration: 2 s}
plants: {web: {type: web, speed: 60 m/min}}
`,
);
const gateway_of = (line) => Number(execFileSync("pgrep", ["-P", String(line.child.pid), "-f", "gateway.mjs"]).toString());

test("the line ends its gateway", async () => {
  const line = await start_line(web);
  const gateway = gateway_of(line);
  assert.deepEqual(await line.end("SIGTERM"), { status: 130, signal: null });
  assert.equal(alive(gateway), false);
  assert.ok(existsSync(join(folder, "drycut", "opcua", "own")));
  assert.deepEqual(readdirSync(folder).filter((name) => name !== "drycut" && !name.endsWith(".yaml") && !name.startsWith("node-opcua")), []);
});

test("a line that is killed takes its gateway with it", async () => {
  const line = await start_line(web);
  const gateway = gateway_of(line);
  await line.end("SIGKILL");
  await until(() => !alive(gateway));
});

test("a gateway that is killed leaves the line running, which says so", async () => {
  const line = await start_line(web);
  process.kill(gateway_of(line), "SIGKILL");
  await line.hears(/the OPC UA gateway has ended by signal 9; the line goes on without it/);
  assert.equal((await fetch(new URL("line.json", line.page))).status, 200);
  assert.deepEqual(await line.end(), { status: 130, signal: null });
});

test("a client that comes back finds the line as it was", async () => {
  const line = await start_line(web);
  const first = await Session.open(line.url);
  assert.equal(await first.write("Plants/web/Settings/speed", DataType.Double, 42), "Good");
  await first.close();
  const second = await Session.open(line.url);
  assert.equal(await second.value("Plants/web/Settings/speed"), 42);
  await second.close();
  await line.end();
});

test("on this machine alone anybody may come in, over nothing but an open channel", async () => {
  const line = await start_line(web);
  const client = OPCUAClient.create({ endpointMustExist: false, connectionStrategy: { maxRetry: 0 } });
  await client.connect(line.url);
  const endpoints = await client.getEndpoints();
  await client.disconnect();
  assert.deepEqual([...new Set(endpoints.map(({ securityPolicyUri }) => securityPolicyUri))], [SecurityPolicy.None]);
  assert.ok(endpoints[0].userIdentityTokens.some(({ tokenType }) => tokenType === UserTokenType.Anonymous));
  assert.ok(endpoints.every(({ endpointUrl }) => endpointUrl.startsWith("opc.tcp://127.0.0.1:")));
  await assert.rejects(Session.open(line.url, { identity: { type: UserTokenType.UserName, userName: "drycut", password: "" } }));
  await line.end();
});

test("with --listen user drycut shows the token", async () => {
  const line = await start_line(web, "--listen", "0.0.0.0");
  const token = new URL(line.page).searchParams.get("token");
  assert.match(line.said, new RegExp(`user drycut, password ${token}`));
  const url = line.url.replace("0.0.0.0", "127.0.0.1");
  const password = (word) => ({ identity: { type: UserTokenType.UserName, userName: "drycut", password: word } });
  await assert.rejects(Session.open(url), /anonymous|Identity|token/i);
  await assert.rejects(Session.open(url, password("wrong")), /BadUserAccessDenied|BadIdentityTokenRejected/);
  const other = { identity: { type: UserTokenType.UserName, userName: "other", password: token } };
  await assert.rejects(Session.open(url, other), /BadUserAccessDenied|BadIdentityTokenRejected/);
  for (const security of [{}, { securityMode: MessageSecurityMode.SignAndEncrypt, securityPolicy: SecurityPolicy.Basic256Sha256 }]) {
    const client = await Session.open(url, { ...password(token), ...security });
    assert.equal(await client.value("Line/Title"), "A web");
    await client.close();
  }
  await line.end();
});

test("a port that is taken is told before the line runs", async () => {
  const line = await start_line(web);
  const { port } = new URL(line.url.replace("opc.tcp", "http"));
  const second = new Program(["live", web, "--port", "0", "--opcua", port]);
  await second.hears(new RegExp(`cannot listen for OPC UA on 127.0.0.1 port ${port}: .*; give another port, or --opcua 0`));
  assert.deepEqual(await second.ended, { status: 2, signal: null });
  await line.end();
});

test("what is read again at a restart may be another machine", async () => {
  const line = await start_line(web);
  const client = await Session.open(line.url);
  assert.deepEqual(await client.names("Plants"), ["web"]);
  scene("web.yaml", `scene: {title: Two webs, step: 1 ms, duration: 2 s}\nplants: {web: {type: web}, upper: {type: web}}\n`);
  assert.equal(await client.call("Line/Restart"), "Good");
  await until(async () => (await client.names("Plants")).length === 2);
  assert.deepEqual((await client.names("Plants")).sort(), ["upper", "web"]);
  assert.equal(await client.value("Line/Title"), "Two webs");
  assert.equal(await client.write("Plants/upper/Settings/speed", DataType.Double, 12), "Good");
  await client.close();
  await line.end();
});

// A live line with its gateway, as a user starts them, and a client of OPC UA.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const program = resolve(process.env.DRYCUT);
const require = createRequire(join(resolve(process.env.DRYCUT_OPCUA), "any.js"));
const opcua = require("node-opcua-client");
export const {
  AttributeIds,
  ClientMonitoredItem,
  ClientSubscription,
  constructEventFilter,
  DataType,
  MessageSecurityMode,
  OPCUAClient,
  SecurityPolicy,
  StatusCodes,
  TimestampsToReturn,
  UserTokenType,
  Variant,
} = opcua;

export const scenes = resolve(dirname(fileURLToPath(import.meta.url)), "../../scenes");
export const folder = mkdtempSync(join(tmpdir(), "drycut-opcua-test-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
// The client's and the gateway's certificates go there too.
process.env.XDG_CACHE_HOME = folder;
process.env.HOME = folder;
process.env.XDG_CONFIG_HOME = folder;

export function scene(name, text) {
  const file = join(folder, name);
  writeFileSync(file, text);
  return file;
}

/// A program under test with all that it says.
export class Program {
  said = "";
  #waiting = new Set();

  constructor(args, options = {}) {
    this.child = spawn(program, args, { ...options, stdio: ["ignore", "pipe", "pipe"] });
    this.ended = once(this.child, "close").then(([status, signal]) => ({ status, signal }));
    for (const stream of [this.child.stdout, this.child.stderr])
      stream.on("data", (data) => {
        this.said += data;
        for (const look of this.#waiting) look();
      });
    this.ended.then(() => {
      for (const look of this.#waiting) look(true);
    });
  }
  /// What it said as `pattern`; fails if it ends before.
  hears(pattern) {
    return new Promise((resolve, reject) => {
      const look = (ended) => {
        const found = pattern.exec(this.said);
        if (!found && !ended) return;
        this.#waiting.delete(look);
        if (found) resolve(found);
        else reject(new Error(`it never said ${pattern}: ${this.said}`));
      };
      this.#waiting.add(look);
      look();
    });
  }
  async end(signal = "SIGINT") {
    this.child.kill(signal);
    return this.ended;
  }
}

export async function start_line(file, ...args) {
  const line = new Program(["live", file, "--port", "0", "--opcua", "0", ...args]);
  const [, page] = await line.hears(/the line: (\S+)/);
  const [, url] = await line.hears(/OPC UA: (\S+)/);
  return Object.assign(line, { page, url });
}

/// A session of a client, with paths in place of NodeIds: "Plants/web/Settings/speed".
export class Session {
  static async open(url, { identity, ...options } = {}) {
    const client = OPCUAClient.create({
      endpointMustExist: false,
      connectionStrategy: { maxRetry: 0 },
      ...options,
    });
    await client.connect(url);
    const session = await client.createSession(identity).catch(async (refused) => {
      await client.disconnect();
      throw refused;
    });
    const made = new Session();
    Object.assign(made, { client, session });
    made.namespaces = await session.readNamespaceArray();
    made.index = made.namespaces.indexOf("urn:drycut:line");
    return made;
  }
  node(path) {
    return path.startsWith("ns=") || path.startsWith("i=") ? path : `ns=${this.index};s=${path}`;
  }
  read(path, attributeId = AttributeIds.Value) {
    return this.session.read({ nodeId: this.node(path), attributeId });
  }
  async value(path) {
    const { statusCode, value } = await this.read(path);
    if (statusCode.isNot(StatusCodes.Good)) throw new Error(`${path}: ${statusCode}`);
    return value.value;
  }
  async write(path, dataType, value) {
    const { name } = await this.session.write({
      nodeId: this.node(path),
      attributeId: AttributeIds.Value,
      value: { value: { dataType, value } },
    });
    return name;
  }
  async call(path, ...inputArguments) {
    const { statusCode } = await this.session.call({
      objectId: this.node("Line"),
      methodId: this.node(path),
      inputArguments: inputArguments.map(([dataType, value]) => new Variant({ dataType, value })),
    });
    return statusCode.name;
  }
  /// What is below a node: browse name, node class, NodeId.
  async children(path) {
    const { references } = await this.session.browse({ nodeId: this.node(path), referenceTypeId: "HierarchicalReferences", includeSubtypes: true, resultMask: 63 });
    return references.map(({ browseName, nodeId, nodeClass, typeDefinition }) => ({ name: browseName.name, namespace: browseName.namespaceIndex, nodeId: nodeId.toString(), nodeClass, type: typeDefinition.toString() }));
  }
  async names(path) {
    return (await this.children(path)).map(({ name }) => name);
  }
  async subscription(options = {}) {
    return this.session.createSubscription2({ requestedPublishingInterval: 50, requestedLifetimeCount: 1000, requestedMaxKeepAliveCount: 10, publishingEnabled: true, maxNotificationsPerPublish: 0, priority: 1, ...options });
  }
  /// The values of a monitored item: next(holds) is the first one to come for which `holds`.
  async monitor(path, subscription, { samplingInterval = 30, attributeId = AttributeIds.Value, filter } = {}) {
    const item = await subscription.monitor({ nodeId: this.node(path), attributeId }, { samplingInterval, queueSize: 1000, discardOldest: true, filter }, TimestampsToReturn.Both);
    const came = [];
    let look = () => {};
    item.on("changed", (value) => {
      came.push(value);
      look();
    });
    const next = (holds) =>
      new Promise((resolve) => {
        look = () => {
          while (came.length > 0) {
            const value = came.shift();
            if (holds(value)) return resolve(value);
          }
        };
        look();
      });
    return { item, next };
  }
  async close() {
    await this.session.close(true);
    await this.client.disconnect();
  }
}

/// The first time that `holds`, looked at again and again.
export async function until(holds) {
  for (;;) {
    const value = await holds();
    if (value) return value;
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

export const alive = (pid) => {
  try {
    process.kill(pid, 0);
    return true;
  } catch {
    return false;
  }
};

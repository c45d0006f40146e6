// opcua_client.mjs URL SECONDS: subscribes to what the plants and the panel show, 30 times a second, writes now and
// then, and says how many changes came. DRYCUT_OPCUA: the folder with the packages.
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [url, seconds] = [process.argv[2], Number(process.argv[3])];
const require = createRequire(join(resolve(process.env.DRYCUT_OPCUA), "any.js"));
const { AttributeIds, OPCUAClient, TimestampsToReturn } = require("node-opcua-client");

const client = OPCUAClient.create({ endpointMustExist: false, connectionStrategy: { maxRetry: 3 } });
await client.connect(url);
const session = await client.createSession();
const index = (await session.readNamespaceArray()).indexOf("urn:drycut:line");
const children = async (nodeId) => (await session.browse({ nodeId, referenceTypeId: "HierarchicalReferences", includeSubtypes: true, resultMask: 63 })).references;
const nodes = [];
for (const plant of await children(`ns=${index};s=Plants`))
  for (const group of await children(plant.nodeId))
    for (const value of await children(group.nodeId)) nodes.push(value.nodeId);
const subscription = await session.createSubscription2({ requestedPublishingInterval: 100, requestedLifetimeCount: 1000, requestedMaxKeepAliveCount: 10, publishingEnabled: true, maxNotificationsPerPublish: 0, priority: 1 });
let changes = 0;
for (const nodeId of nodes.slice(0, 100)) {
  const item = await subscription.monitor({ nodeId, attributeId: AttributeIds.Value }, { samplingInterval: 33, queueSize: 100, discardOldest: true }, TimestampsToReturn.Both);
  item.on("changed", () => ++changes);
}
await new Promise((done) => setTimeout(done, 1000 * seconds));
console.log(`OPC UA: ${Math.min(100, nodes.length)} items, ${changes} changes`);
await session.close(true);
await client.disconnect();

// read_mcap.mjs RUN.mcap TRACE.csv EVENTS.csv: @mcap/core finds in the one, by its index, what stands in the others.
import assert from "node:assert";
import { readFileSync } from "node:fs";
import { McapIndexedReader } from "@mcap/core";
import { decompress } from "fzstd";

const [mcap, trace, events] = process.argv.slice(2);
const bytes = readFileSync(mcap);
const reader = await McapIndexedReader.Initialize({
  readable: {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => bytes.subarray(Number(offset), Number(offset + length)),
  },
  decompressHandlers: { zstd: (data) => decompress(data) },
});
const lines = readFileSync(trace, "utf8").trimEnd().split("\n").map((line) => line.split(","));
const columns = lines[0].slice(1).map((cell) => /^(.*) \[(.*)\]$/.exec(cell).slice(1));
const rows = lines.slice(1).map((cells) => cells.map(Number));

// Every number of the trace, topic by topic.
let found = 0;
const topics = new Map([...reader.channelsById.values()].map((channel) => [channel.topic, channel]));
for (const source of new Set(columns.map(([name]) => name.split(".")[0]))) {
  const channel = topics.get(`/${source}`);
  const schema = JSON.parse(new TextDecoder().decode(reader.schemasById.get(channel.schemaId).data));
  let row = 0;
  for await (const message of reader.readMessages({ topics: [`/${source}`] })) {
    assert.strictEqual(message.logTime, BigInt(Math.round(rows[row][0] * 1e9)));
    const json = JSON.parse(new TextDecoder().decode(message.data));
    columns.forEach(([name, unit], i) => {
      const [first, ...path] = name.split(".");
      if (first !== source) return;
      assert.strictEqual(path.reduce((value, part) => value[part], json), rows[row][i + 1], name);
      assert.strictEqual(path.reduce((value, part) => value.properties[part], schema).description, unit);
      ++found;
    });
    ++row;
  }
  assert.strictEqual(row, rows.length, source);
}
assert.strictEqual(found, rows.length * columns.length);

// Every event, and the lengths of the cuts by their own topic.
const told = readFileSync(events, "utf8").trimEnd().split("\n").slice(1);
const log = [];
for await (const message of reader.readMessages({ topics: ["/events"] }))
  log.push(JSON.parse(new TextDecoder().decode(message.data)));
assert.strictEqual(log.length, told.length);
assert.ok(log.every(({ level, message }) => !message.startsWith("cut") || level === 2));
log.forEach((entry, i) => {
  const [time, source, event, values] = told[i].split(",");
  assert.strictEqual(`${entry.timestamp.sec}.${String(entry.timestamp.nsec).padStart(9, "0")}`, time);
  assert.strictEqual(entry.name, source);
  assert.ok(entry.message.startsWith(event), entry.message);
  if (values && !values.startsWith('"')) assert.strictEqual(entry.message, `${event}: ${values}`);
});
const cuts = told.filter((line) => line.includes(",cut,")).map((line) => Number(/length=(\S+)/.exec(line)[1]));
assert.ok(cuts.length > 2);
for await (const message of reader.readMessages({ topics: ["/knife/cut"] })) {
  const cut = JSON.parse(new TextDecoder().decode(message.data));
  assert.ok(Math.abs(cut.length - cuts.shift()) < 1e-5);
}
assert.strictEqual(cuts.length, 0);

const metadata = [];
for await (const record of reader.readMetadata()) metadata.push(record);
assert.strictEqual(metadata[0].metadata.get("step"), "100 us");
const statistics = reader.statistics;
assert.strictEqual(Number(statistics.chunkCount), reader.chunkIndexes.length);
assert.ok(reader.chunkIndexes.length > 1);
const counted = [...statistics.channelMessageCounts.values()].reduce((sum, count) => sum + count, 0n);
assert.strictEqual(statistics.messageCount, counted);
console.log("equal");

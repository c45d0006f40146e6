// The OPC UA gateway of a live line. `drycut live --opcua PORT` starts it and says on standard input, in a line
// of JSON, where the line is: {"line", "address", "port", "token"}. It ends when that input ends, or when its
// connection to the line is lost for good.
import { createInterface } from "node:readline";
import { Line } from "./line.mjs";
import { Machine } from "./machine.mjs";
import { make_server } from "./server.mjs";

function fail(message) {
  process.stderr.write(`OPC UA gateway: ${message}\n`);
  process.exit(1);
}

async function serve({ line: page, address, port, token }) {
  const line = new Line(page);
  line.on("lost", () => fail("the connection to the line is lost"));
  await new Promise((resolve) => line.once("description", resolve));
  const { server, url } = await make_server({ address, port, token, described: line.description });
  const machine = new Machine(server, line);
  line.on("description", () => machine.describe());
  line.on("news", (news) => machine.tell(news));
  await server.start();
  process.stdout.write(`OPC UA: ${url}${token === "" ? "" : ` (user drycut, password ${token})`}\n`);
  return async () => {
    line.close();
    await server.shutdown(100); // [ms] for its clients to hear of it
  };
}

process.on("unhandledRejection", (error) => fail(error.stack));
const input = createInterface({ input: process.stdin });
let end = async () => {};
input.once("line", (text) => {
  const served = serve(JSON.parse(text));
  end = async () => (await served)();
  served.catch((error) => fail(error.message));
});
input.once("close", () => {
  setTimeout(() => process.exit(0), 3000).unref();
  end().then(() => process.exit(0));
});

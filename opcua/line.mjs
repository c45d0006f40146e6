// The line's own WebSocket (sim/live/protocol.hpp): what it is, what it tells, what it is asked.
import { EventEmitter } from "node:events";
import WebSocket from "ws";

const between_attempts = 500; // [ms]
const lost_for_good = 10_000; // [ms] without a connection
const most_names = 500; // a message
const most_open = 60; // messages that are not answered yet: of more the line says that it is busy

/// What the line answers when it refuses something.
export class Refused extends Error {
  constructor({ problems, busy = false }) {
    super(problems.map(({ what, remedy }) => (remedy ? `${what}; ${remedy}` : what)).join("\n"));
    this.busy = busy;
  }
}
/// There is no connection to the line now.
export class Lost extends Error {}

/// Emits "description", "news", "lost" (for good).
export class Line extends EventEmitter {
  description = undefined;
  news = undefined; // the latest
  outcome = { checks: [], drives: [] };
  #address;
  #socket;
  #next = 1;
  #asked = new Map(); // by number: {resolve, reject, seen}
  #held = []; // what is asked when there is room: the same with the message
  #seen_with_news = [];
  #reading = undefined; // a message of names that is being put together
  #since = Date.now();
  #closed = false;

  constructor(page) {
    super();
    const address = new URL(page);
    address.protocol = "ws:";
    address.pathname = "/ws";
    this.#address = address;
    this.#connect();
  }

  get connected() {
    return this.#socket?.readyState === WebSocket.OPEN;
  }
  get running() {
    return this.news?.running ?? false;
  }
  close() {
    this.#closed = true;
    this.#socket?.close();
  }

  /// Asks for something; resolves when the next news can tell of it.
  ask(message) {
    return this.#ask(message, true);
  }

  /// The value of a channel now. All that is asked for in one go is one message.
  read(name) {
    if (!this.#reading || this.#reading.names.size >= most_names) {
      const names = new Set();
      const answer = new Promise((resolve) => setImmediate(resolve)).then(async () => {
        if (this.#reading?.names === names) this.#reading = undefined;
        const list = [...names];
        const { values } = await this.#ask({ read: list }, false);
        return new Map(list.map((one, i) => [one, values[i] ?? NaN]));
      });
      this.#reading = { names, answer };
    }
    const { names, answer } = this.#reading;
    names.add(name);
    return answer.then((values) => values.get(name));
  }

  #ask(message, seen) {
    if (!this.connected) return Promise.reject(new Lost("no connection to the line"));
    return new Promise((resolve, reject) => {
      this.#held.push({ message, resolve, reject, seen });
      this.#send();
    });
  }

  #send() {
    while (this.#held.length > 0 && this.#asked.size < most_open) {
      const { message, ...asked } = this.#held.shift();
      const id = this.#next++;
      this.#asked.set(id, asked);
      this.#socket.send(JSON.stringify({ ...message, id }));
    }
  }

  #connect() {
    const socket = new WebSocket(this.#address, { perMessageDeflate: false });
    this.#socket = socket;
    socket.on("message", (data) => this.#take(JSON.parse(data)));
    socket.on("error", () => {});
    socket.on("close", () => {
      for (const { reject } of [...this.#asked.values(), ...this.#held.splice(0), ...this.#seen_with_news]) reject(new Lost("no connection to the line"));
      this.#asked.clear();
      this.#seen_with_news = [];
      if (this.#closed) return;
      if (Date.now() - this.#since > lost_for_good) return this.emit("lost");
      setTimeout(() => this.#connect(), between_attempts);
    });
  }

  #take(message) {
    this.#since = Date.now();
    if (message.line) {
      this.description = message.line;
      this.news = undefined;
      this.emit("description", message.line);
    } else if (message.news) {
      this.news = message.news;
      if (message.news.outcome) this.outcome = message.news.outcome;
      this.emit("news", message.news);
      for (const { resolve, answer } of this.#seen_with_news.splice(0)) resolve(answer);
    } else if (message.done !== undefined) {
      const asked = this.#asked.get(message.done);
      this.#asked.delete(message.done);
      if (!asked) return;
      this.#send();
      if (message.problems.length > 0) asked.reject(new Refused(message));
      else if (asked.seen) this.#seen_with_news.push({ ...asked, answer: message });
      else asked.resolve(message);
    }
  }
}

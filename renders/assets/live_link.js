// The wire to the line: JSON over a WebSocket, which comes back by itself.

const soonest = 500;   // [ms] until the first new attempt
const longest = 4000;  // and between later ones

const token = new URLSearchParams(location.search).get("token");
const query = token === null ? "" : "?token=" + encodeURIComponent(token);

/// Where something of the line is to be had.
export const address = (path) => path + query;

export class Link {
  /// `heard`: what to do with a message, by its kind: line, news, samples. `changed`: told true or false as the
  /// connection comes and goes.
  constructor(heard, changed) {
    this.heard = heard;
    this.changed = changed;
    this.past = false;  // what is shown is: nothing can be done to it
    this.open = new Map();  // by number: who waits for an answer
    this.last = 0;
    this.pause = soonest;
    this.connect();
  }

  connect() {
    const url = new URL(address("ws"), location.href);
    url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    this.socket = new WebSocket(url);
    this.socket.onopen = () => {
      this.pause = soonest;
      this.changed(true);
    };
    this.socket.onmessage = (event) => this.take(JSON.parse(event.data));
    this.socket.onclose = () => {
      this.changed(false);
      for (const answered of this.open.values()) answered({ problems: [{ what: "the connection is lost", remedy: "" }] });
      this.open.clear();
      setTimeout(() => this.connect(), this.pause);
      this.pause = Math.min(longest, 2 * this.pause);
    };
  }

  take(message) {
    if ("done" in message) {
      this.open.get(message.done)?.(message);
      this.open.delete(message.done);
      return;
    }
    for (const [kind, content] of Object.entries(message)) this.heard[kind]?.(content);
  }

  /// What became of it: a list of problems, empty if it is done.
  async ask(what) {
    return (await this.request(what)).problems;
  }
  /// The whole answer, with its `problems`.
  request(what) {
    if (this.socket.readyState !== WebSocket.OPEN)
      return Promise.resolve({ problems: [{ what: "there is no connection to the line", remedy: "" }] });
    const id = ++this.last;
    this.socket.send(JSON.stringify({ id, ...what }));
    return new Promise((answered) => this.open.set(id, answered));
  }
  act(what) {
    if (this.past)
      return Promise.resolve([{ what: "what is shown is past", remedy: "go back to now, or go on from here" }]);
    return this.ask({ act: what });
  }
}

// The machine that the line's description tells of, anew when it tells of another one.
import { add_cut_event, add_cutter_types, Cutter } from "./cutter.mjs";
import { Events } from "./events.mjs";
import { add_identification, add_machinery, add_packml, needs_packml, put_among_machines } from "./machinery.mjs";
import { build_space, our_namespace } from "./space.mjs";

/// What a description says but the number of its run.
const content = ({ run, ...described }) => JSON.stringify(described);

export class Machine {
  #space;
  #namespace;
  #line;
  #events;
  #types;
  #cut_event;
  #nodes = [];
  #content;
  #built;

  constructor(server, line) {
    this.#space = server.engine.addressSpace;
    this.#namespace = this.#space.registerNamespace(our_namespace);
    this.#line = line;
    this.#events = new Events(this.#namespace);
    this.#types = add_cutter_types(this.#space);
    this.#cut_event = add_cut_event(this.#namespace, this.#types);
    this.describe();
  }

  describe() {
    const described = this.#line.description;
    if (content(described) === this.#content) {
      this.#built.injected.clear();
      return;
    }
    this.#content = content(described);
    for (const node of this.#nodes.splice(0)) this.#space.deleteNode(node);
    this.#build(described);
  }

  tell({ time, events = [] }) {
    this.#events.time = time;
    for (const event of events) {
      this.#built.happened(event);
      this.#events.happened(event);
    }
  }

  #build(described) {
    const space = this.#space;
    const namespace = this.#namespace;
    const line = this.#line;
    const { objects } = space.rootFolder;
    const root = namespace.addObject({
      organizedBy: objects,
      browseName: "Line",
      displayName: described.title || described.scenario,
      nodeId: "s=Line",
      eventNotifier: 1,
      eventSourceOf: objects.server,
    });
    this.#nodes.push(root);
    put_among_machines(space, root);
    add_identification(space, namespace, root, "Identification", "Line", described.opcua, `urn:drycut:${described.scenario}`);
    this.#built = build_space(namespace, root, line, this.#events);
    add_machinery(space, namespace, root, line, described.opcua);
    if (needs_packml(described.opcua)) add_packml(space, namespace, root, line, described.opcua);
    const told = (path, message) => this.#events.refused(path, message);
    const cutters = new Map();
    for (const plant of described.plants.filter(({ cuts }) => cuts)) {
      const made = { space, namespace, types: this.#types, cut_event: this.#cut_event, line, told };
      cutters.set(plant.name, new Cutter(made, plant));
      this.#nodes.push(space.findNode(`ns=${namespace.index};s=Cutter/${plant.name}`));
    }
    this.#events.attach(root, cutters);
  }
}

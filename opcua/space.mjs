// The line in the address space: what it is and how it runs, its controller, plants, panel, faults, checks.
import { StatusCodes, DataType } from "./ua.mjs";
import { add_variable, bad, good, status_of, type_of } from "./variables.mjs";

export const our_namespace = "urn:drycut:line";

const { Boolean: Bool, Double, Int32, String: Words } = DataType;
const pace_range = { low: 0, high: 1e4, whole: false };
const first_part = (name) => name.slice(0, name.indexOf(".") < 0 ? undefined : name.indexOf("."));

/// A value as the line reads it in an act: what has a unit is given with it.
const written = (value, unit) => (unit === "" ? Number(value) : `${value} ${unit}`);

class Space {
  constructor(namespace, line, events) {
    this.namespace = namespace;
    this.line = line;
    this.events = events;
    this.injected = new Map(); // by fault: what it was given last
  }

  folder(parent, name, path) {
    const place = parent ? { componentOf: parent } : {};
    return this.namespace.addObject({ ...place, browseName: name, nodeId: `s=${path}`, typeDefinition: "FolderType" });
  }
  variable(owner, options) {
    const told = (message) => this.events.refused(options.path, message);
    return add_variable(this.namespace, owner, { line: this.line, told, ...options });
  }
  /// One that the scenario's timeline could set.
  setter(name, unit = "") {
    return (value) => this.line.ask({ act: { set: { [name]: written(value, unit) } } });
  }

  build(root, described) {
    const { line } = this;
    this.about(root, described);
    this.methods(root);
    const plants = new Set(described.plants.map(({ name }) => name));
    const of_plant = (name) => plants.has(first_part(name));
    this.controllers(root, described, of_plant);
    this.plants(root, described, of_plant);
    this.panel(root, described);
    this.faults(root, described);
    this.verdicts(root, "Checks", described.checks, (name) => line.outcome.checks.find((check) => check.name === name), "passed");
  }

  about(root, described) {
    const { line } = this;
    const about = (name, dataType, get, rest = {}) => this.variable(root, { path: `Line/${name}`, name, dataType, get, ...rest });
    about("Title", Words, () => line.description.title);
    about("Scenario", Words, () => line.description.scenario);
    about("PhysicsStep", Double, () => line.description.step, { unit: "s" });
    about("Duration", Double, () => line.description.duration, { unit: "s", description: "of the scenario; the line goes on" });
    about("Notes", Words, () => line.description.notes, { array: true });
    about("Number", Int32, () => line.news?.run ?? described.run, { description: "of the run: each restart is another one" });
    about("Time", Double, () => line.news?.time ?? 0, { unit: "s", description: "machine time" });
    about("Running", Bool, () => line.running, { set: (on) => line.ask({ run: on }), description: "false: it stands still" });
    about("Pace", Double, () => line.news?.pace ?? 1, {
      range: pace_range,
      set: (pace) => line.ask({ pace: pace === 0 ? "max" : pace }),
      description: "machine seconds a second; 0: as fast as it goes",
    });
    about("Late", Double, () => line.news?.late.worst ?? 0, { unit: "s", description: "the latest cycle since it began to run" });
    about("Failure", Words, () => line.news?.failure ?? "", { description: "why the simulation cannot go on" });
  }

  methods(root) {
    const { line, namespace } = this;
    const add = (name, inputArguments, message) => {
      const method = namespace.addMethod(root, { nodeId: `s=Line/${name}`, browseName: name, inputArguments, outputArguments: [] });
      const told = (text) => this.events.refused(`Line/${name}`, text);
      method.bindMethod((given, context, callback) => {
        line
          .ask(message(...given.map(({ value }) => value)))
          .then(() => StatusCodes.Good)
          .catch((error) => status_of(error, StatusCodes.BadInvalidArgument, told))
          .then((statusCode) => callback(null, { statusCode, outputArguments: [] }), callback);
      });
    };
    const argument = (name, dataType, text) => ({ name, dataType, description: { text } });
    add("Start", [], () => ({ run: true }));
    add("Stop", [], () => ({ run: false }));
    add("Step", [argument("Time", Double, "machine time [s], then it stands still")], (time) => ({ advance: `${time} s` }));
    add("RunUntil", [argument("Event", Words, "an event's name, cut or knife.cut; empty: any")], (event) => ({ until: event ?? "" }));
    add("Restart", [], () => ({ restart: true }));
  }

  controllers(root, described, of_plant) {
    if (described.controller === "") return;
    const all = this.folder(root, "Controllers", "Controllers");
    const path = `Controllers/${described.controller}`;
    const folder = this.folder(all, described.controller, path);
    for (const { name, unit, writable, range } of described.channels) {
      if (of_plant(name) || name.startsWith("panel.")) continue;
      const set = writable ? this.setter(name) : undefined;
      this.variable(folder, { path: `${path}/${name}`, name, unit, range, set, get: () => this.line.read(name) });
    }
  }

  plants(root, described, of_plant) {
    const all = this.folder(root, "Plants", "Plants");
    for (const { name: plant, type } of described.plants) {
      const path = `Plants/${plant}`;
      const object = this.namespace.addObject({ componentOf: all, browseName: plant, nodeId: `s=${path}`, description: type });
      const channels = this.folder(object, "Channels", `${path}/Channels`);
      const settings = this.folder(object, "Settings", `${path}/Settings`);
      const own = (full) => of_plant(full) && first_part(full) === plant;
      for (const { name: full, unit } of described.channels.filter((channel) => own(channel.name))) {
        const name = full.slice(plant.length + 1);
        this.variable(channels, { path: `${path}/Channels/${name}`, name, unit, get: () => this.line.read(full) });
      }
      described.targets.forEach((target, i) => {
        if (target.panel || !own(target.name)) return;
        const name = target.name.slice(plant.length + 1);
        this.setting(settings, `${path}/Settings/${name}`, name, target, i);
      });
    }
  }

  setting(owner, path, name, { name: full, unit, range }, i) {
    const get = () => this.line.news?.values[i] ?? bad(StatusCodes.BadWaitingForInitialData);
    this.variable(owner, { path, name, unit, range, get, set: this.setter(full, unit) });
  }

  panel(root, described) {
    const panel = this.folder(root, "Panel", "Panel");
    described.targets.forEach((target, i) => {
      const name = target.name.slice("panel.".length);
      if (target.panel) this.setting(panel, `Panel/${name}`, name, target, i);
    });
    described.lamps.forEach((full, i) => {
      const name = full.slice("panel.".length);
      const get = () => this.line.news?.lamps[i] ?? bad(StatusCodes.BadWaitingForInitialData);
      this.variable(panel, { path: `Panel/${name}`, name, dataType: Bool, get });
    });
  }

  faults(root, described) {
    const all = this.folder(root, "Faults", "Faults");
    const components = new Map();
    for (const { component, name, unit, range, meaning } of described.faults) {
      const path = `Faults/${component}`;
      if (!components.has(component)) components.set(component, this.folder(all, component, path));
      const full = `${component}.${name}`;
      const dataType = type_of(range);
      this.variable(components.get(component), {
        path: `${path}/${name}`,
        name,
        unit,
        range,
        description: meaning,
        // What is not injected is not known as a number: it is not at work.
        get: () => {
          const value = this.injected.get(full);
          if (value !== undefined) return value;
          return good(dataType === Bool ? false : 0, dataType, StatusCodes.UncertainInitialValue);
        },
        set: (value) => this.line.ask({ act: { fault: { [component]: { [name]: written(value, unit) } } } }),
      });
    }
    this.fault_units = new Map(described.faults.map(({ component, name, unit }) => [`${component}.${name}`, unit]));
  }

  /// Faults are told as they act, whoever injected them: "knife.encoder.lose_counts = 200".
  happened({ source, event, values }) {
    if (source !== "timeline" || event !== "fault") return;
    const [, name, number, unit] = /^(\S+) = (\S+) ?(.*)$/.exec(values) ?? [];
    if (!this.fault_units?.has(name)) return;
    const known = unit === "" || unit === this.fault_units.get(name);
    this.injected.set(name, known ? Number(number) : bad(StatusCodes.UncertainNoCommunicationLastUsableValue));
  }

  verdicts(root, title, names, find, key) {
    const folder = this.folder(root, title, title);
    for (const name of names) {
      const path = `${title}/${name}`;
      const object = this.namespace.addObject({ componentOf: folder, browseName: name, nodeId: `s=${path}` });
      const waiting = () => bad(StatusCodes.BadWaitingForInitialData);
      this.variable(object, { path: `${path}/Passed`, name: "Passed", dataType: Bool, get: () => find(name)?.[key] ?? waiting() });
      this.variable(object, { path: `${path}/Detail`, name: "Detail", dataType: Words, get: () => find(name)?.detail ?? waiting() });
    }
  }
}



/// Builds what the description says below `root`.
export function build_space(namespace, root, line, events) {
  const space = new Space(namespace, line, events);
  space.build(root, line.description);
  return space;
}

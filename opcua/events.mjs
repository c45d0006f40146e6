// The line's events, and what it refuses, as events of OPC UA.
import { DataType, Variant, VariantArrayType } from "./ua.mjs";

// Of OPC 10000-5: low 1..333, medium, high 667..1000.
const severities = { note: 100, warning: 500, error: 800, damage: 1000 };

const scalar = (dataType, value) => new Variant({ dataType, value });
const list = (dataType, value) => new Variant({ dataType, arrayType: VariantArrayType.Array, value });

export class Events {
  #type;
  #line;
  #cutters = new Map();

  constructor(namespace) {
    this.#type = namespace.addEventType({ browseName: "LineEventType", nodeId: "s=LineEventType", subtypeOf: "BaseEventType" });
    const property = (name, dataType, valueRank, description) =>
      namespace.addVariable({
        propertyOf: this.#type,
        browseName: name,
        nodeId: `s=LineEventType/${name}`,
        typeDefinition: "PropertyType",
        dataType,
        valueRank,
        modellingRule: "Mandatory",
        description,
      });
    property("Event", "String", -1, "its name: cut, refused, error");
    property("MachineTime", "Double", -1, "when it happened, in seconds of the line");
    property("ValueNames", "String", 1, "what it tells in numbers");
    property("Values", "Double", 1, "in their units");
    property("Units", "String", 1, "of the values");
  }

  /// `line`: the object whose events they are; `cutters`: by plant, who tells a cut in its own way too.
  attach(line, cutters) {
    this.#line = line;
    this.#cutters = cutters;
  }

  happened({ source, event, severity, values, numbers, time }) {
    const message = [source, event, values].filter((part) => part !== "").join(" ");
    this.#raise(source, event, severity, message, time, numbers);
    if (event === "cut") this.#cutters.get(source)?.cut(message, Object.fromEntries(numbers));
  }
  /// A write or a call that the line does not take, with its words.
  refused(path, message) {
    this.#raise(path, "refused", "warning", message, this.time ?? 0, []);
  }

  #raise(source, event, severity, message, time, numbers) {
    this.#line.raiseEvent(this.#type, {
      sourceName: scalar(DataType.String, source),
      message: scalar(DataType.LocalizedText, { text: message }),
      severity: scalar(DataType.UInt16, severities[severity]),
      event: scalar(DataType.String, event),
      machineTime: scalar(DataType.Double, time),
      valueNames: list(DataType.String, numbers.map(([name]) => name)),
      values: list(DataType.Double, numbers.map(([, number]) => number ?? NaN)),
      units: list(DataType.String, numbers.map(([, , unit]) => unit)),
    });
  }
}

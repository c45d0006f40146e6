// Knives and saws by OPC 40084-9 v2.00 (PlasticsRubber, Extrusion, Cutter), sections 6.1 to 6.12, with the
// parts of OPC 40083 that they use. There is no nodeset of it in a package: types and members stand here as the
// model has them, with its namespace and NodeIds, as far as a line knows them. See docs/live.md for what is not there.
import { DataType, StatusCodes, Variant, VariantArrayType } from "./ua.mjs";
import { add_identification, put_among_machines } from "./machinery.mjs";
import { add_variable, bad } from "./variables.mjs";

const cutter_uri = "http://opcfoundation.org/UA/PlasticsRubber/Extrusion_v2/Cutter/";
const rubber_uri = "http://opcfoundation.org/UA/PlasticsRubber/GeneralTypes/";

/// The types, once.
export function add_cutter_types(space) {
  const ns = space.registerNamespace(cutter_uri);
  const rubber = space.registerNamespace(rubber_uri);
  const part = (namespace, owner, name, nodeId, dataType, rule, extra = {}) =>
    namespace.addVariable({
      [extra.property ? "propertyOf" : "componentOf"]: owner,
      browseName: name,
      nodeId: `s=${nodeId}/${name}`,
      typeDefinition: extra.property ? "PropertyType" : (extra.type ?? "BaseDataVariableType"),
      dataType,
      modellingRule: rule,
      accessLevel: extra.writable ? "CurrentRead | CurrentWrite" : "CurrentRead",
      userAccessLevel: extra.writable ? "CurrentRead | CurrentWrite" : "CurrentRead",
    });
  // OPC 40083 MonitoredParameterType, i=1056: the member that is mandatory.
  const monitored = rubber.addObjectType({ browseName: "MonitoredParameterType", nodeId: "i=1056" });
  part(rubber, monitored, "ActualValue", "MonitoredParameterType", "Double", "Mandatory", { type: "AnalogUnitType" });
  // 6.6, i=1003
  const product = ns.addObjectType({ browseName: "CuttingProductType", nodeId: "i=1003" });
  const of_product = (name, dataType, extra) => part(ns, product, name, "CuttingProductType", dataType, "Mandatory", extra);
  of_product("Id", "String", { property: true });
  of_product("Length", "Double", { type: "AnalogUnitType", writable: true });
  of_product("SetOutput", "UInt64", { writable: true });
  of_product("ActualOutput", "UInt64");
  of_product("TotalOutput", "UInt64");
  // 6.5, i=1004
  const products = ns.addObjectType({ browseName: "CuttingProductsType", nodeId: "i=1004" });
  part(ns, products, "ActualCuttingProductId", "CuttingProductsType", "String", "Mandatory");
  // 6.1, i=1005; its base, ExtrusionDeviceType of OPC 40084-1, is left out.
  const cutter = ns.addObjectType({ browseName: "Cutter_InterfaceType", nodeId: "i=1005" });
  // 6.12, i=1002, is abstract: the events are of a type of ours below it.
  const event = ns.addEventType({ browseName: "CutEventType", nodeId: "i=1002", subtypeOf: "BaseEventType", isAbstract: true });
  for (const [name, dataType] of Object.entries({ CuttingProductId: "String", ActualOutput: "UInt64", TotalOutput: "UInt64" }))
    part(ns, event, name, "CutEventType", dataType, "Mandatory", { property: true });
  return { ns, rubber, monitored, product, products, cutter, event };
}

/// The event of a cut as this line tells it: with the length of the piece.
export function add_cut_event(namespace, types) {
  const event = namespace.addEventType({ browseName: "LineCutEventType", nodeId: "s=LineCutEventType", subtypeOf: types.event });
  namespace.addVariable({
    propertyOf: event,
    browseName: "Length",
    nodeId: "s=LineCutEventType/Length",
    typeDefinition: "PropertyType",
    dataType: "Double",
    modellingRule: "Mandatory",
    description: "of the piece [mm]",
  });
  return event;
}

const of_count = (count) => [Math.floor(count / 2 ** 32), count >>> 0];

/// One knife or saw.
export class Cutter {
  #object;
  #event;
  #product;

  constructor({ space, namespace, types, cut_event, line, told }, plant) {
    const described = line.description;
    const { opcua } = described;
    this.#event = cut_event;
    this.#product = described.title;
    const { ns } = types;
    const maker = opcua.manufacturer || "Drycut";
    const path = `Cutter/${plant.name}`;
    const name = `Cutter_${maker}_${opcua.serial_number || plant.name}`;
    const cutter = namespace.addObject({
      browseName: name,
      nodeId: `s=${path}`,
      typeDefinition: types.cutter,
      eventNotifier: 1,
      eventSourceOf: space.rootFolder.objects.server,
    });
    this.#object = cutter;
    put_among_machines(space, cutter);
    add_identification(space, namespace, cutter, `${path}/Identification`, "Cutter", { ...opcua, model: opcua.model || plant.type }, `urn:drycut:${described.scenario}:${plant.name}`);
    const object = (owner, own, name, type, namespaceIndex) =>
      namespace.addObject({ componentOf: owner, browseName: { name, namespaceIndex }, nodeId: `s=${own}`, typeDefinition: type });
    const variable = (owner, own, name, dataType, get, options) => {
      const full = `${own}/${name}`;
      add_variable(namespace, owner, { path: full, name, namespaceIndex: ns.index, dataType, get, line, told: (message) => told(full, message), ...options });
    };
    if (plant.web !== "") {
      const speed = `${plant.web}.speed`;
      const unit = described.channels.find((channel) => channel.name === speed)?.unit;
      if (unit !== undefined) {
        const own = `${path}/ProductSpeed`;
        const product_speed = object(cutter, own, "ProductSpeed", types.monitored, ns.index);
        variable(product_speed, own, "ActualValue", DataType.Double, () => line.read(speed), { unit, namespaceIndex: types.rubber.index });
      }
    }
    const clamp = `${plant.name}.clamp.closed`;
    if (described.channels.some((channel) => channel.name === clamp))
      variable(cutter, path, "SideClampClosed", DataType.Boolean, () => line.read(clamp));
    const all = `${path}/CuttingProducts`;
    const products = object(cutter, all, "CuttingProducts", types.products, ns.index);
    variable(products, all, "ActualCuttingProductId", DataType.String, () => this.#product);
    const one = `${all}/CuttingProduct_1`;
    const product = object(products, one, "CuttingProduct_1", types.product, ns.index);
    variable(product, one, "Id", DataType.String, () => this.#product, { property: true });
    const length = opcua.lengths[plant.name];
    const channel = described.channels.find(({ name }) => name === length);
    variable(product, one, "Length", DataType.Double, () => (length ? line.read(length) : bad(StatusCodes.BadConfigurationError)), {
      unit: channel?.unit || "mm",
      set: channel?.writable ? (value) => line.ask({ act: { set: { [length]: value } } }) : undefined,
    });
    const cuts = `${plant.name}.cut.number`;
    variable(product, one, "SetOutput", DataType.UInt64, () => 0); // no end
    variable(product, one, "ActualOutput", DataType.UInt64, () => line.read(cuts));
    variable(product, one, "TotalOutput", DataType.UInt64, () => line.read(cuts));
  }

  cut(message, { length, number }) {
    const count = new Variant({ dataType: DataType.UInt64, arrayType: VariantArrayType.Scalar, value: of_count(number ?? 0) });
    this.#object.raiseEvent(this.#event, {
      message: new Variant({ dataType: DataType.LocalizedText, value: { text: message } }),
      severity: new Variant({ dataType: DataType.UInt16, value: 100 }),
      cuttingProductId: new Variant({ dataType: DataType.String, value: this.#product }),
      actualOutput: count,
      totalOutput: count,
      length: new Variant({ dataType: DataType.Double, value: length ?? NaN }),
    });
  }
}

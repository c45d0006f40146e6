// OPC 40001-1 (Machinery) and OPC 30050 (PackML), as far as the scenario's section opcua says what means it.
import { StatusCodes, DataType } from "./ua.mjs";
import { bad, bind, good } from "./variables.mjs";

const machinery_uri = "http://opcfoundation.org/UA/Machinery/";
const di_uri = "http://opcfoundation.org/UA/DI/";
const packml_uri = "http://opcfoundation.org/UA/PackML/";

const text = (words) => good({ text: words }, DataType.LocalizedText);

function index_of(space, uri) {
  const index = space.getNamespaceIndex(uri);
  if (index < 0) throw new Error(`${uri} is not loaded`);
  return index;
}

/// The machine's name plate.
export function add_identification(space, namespace, machine, path, type_class, { manufacturer, model, serial_number }, instance) {
  const machinery = index_of(space, machinery_uri);
  const type = space.findObjectType("MachineIdentificationType", machinery);
  const plate = type.instantiate({
    browseName: { name: "Identification", namespaceIndex: index_of(space, di_uri) },
    nodeId: `s=${path}`,
    namespace,
    optionals: ["Model", "DeviceClass"],
  });
  machine.addReference({ referenceType: "HasAddIn", nodeId: plate });
  const say = (name, dataType, value) => {
    const property = plate.getChildByName(name);
    property.setValueFromSource({ dataType, value });
  };
  say("Manufacturer", DataType.LocalizedText, { text: manufacturer });
  say("Model", DataType.LocalizedText, { text: model });
  say("SerialNumber", DataType.String, serial_number);
  say("ProductInstanceUri", DataType.String, instance);
  say("DeviceClass", DataType.String, type_class);
}

/// Into the folder where OPC 40001-1 looks for machines.
export function put_among_machines(space, machine) {
  const folder = space.findNode(`ns=${index_of(space, machinery_uri)};i=1001`);
  folder.addReference({ referenceType: "Organizes", nodeId: machine });
}

/// CurrentState of a state machine: `state` gives its name now, "" = none.
function bind_state(machine, state) {
  const parts = machine.typeDefinitionObj.findReferencesExAsObject("HasComponent");
  const states = new Map(parts.map((node) => [node.browseName.name, node]));
  const none = () => bad(StatusCodes.BadStateNotActive);
  bind(machine, ["CurrentState"], DataType.LocalizedText, async () => {
    const name = await state();
    return name === "" ? none() : text(name);
  });
  bind(machine, ["CurrentState", "Id"], DataType.NodeId, async () => {
    const node = states.get(await state());
    return node ? good(node.nodeId, DataType.NodeId) : none();
  });
}

// Each state by its number in ISA-TR88.00.02: the states of the three machines that nest in OPC 30050.
const packml_states = {
  1: ["Cleared", "Clearing", ""],
  2: ["Cleared", "Stopped", ""],
  3: ["Cleared", "Running", "Starting"],
  4: ["Cleared", "Running", "Idle"],
  5: ["Cleared", "Running", "Suspended"],
  6: ["Cleared", "Running", "Execute"],
  7: ["Cleared", "Stopping", ""],
  8: ["Aborting", "", ""],
  9: ["Aborted", "", ""],
  10: ["Cleared", "Running", "Holding"],
  11: ["Cleared", "Running", "Held"],
  12: ["Cleared", "Running", "Unholding"],
  13: ["Cleared", "Running", "Suspending"],
  14: ["Cleared", "Running", "Unsuspending"],
  15: ["Cleared", "Running", "Resetting"],
  16: ["Cleared", "Running", "Completing"],
  17: ["Cleared", "Running", "Complete"],
};

const working = new Set([3, 6, 10, 12, 13, 14, 16]);

export const needs_packml = (opcua) => opcua.packml.state !== "";

export function add_packml(space, namespace, machine, line, { packml }) {
  const index = index_of(space, packml_uri);
  const object = space.findObjectType("PackMLBaseObjectType", index).instantiate({
    browseName: { name: "PackML", namespaceIndex: index },
    componentOf: machine,
    nodeId: "s=PackML",
    namespace,
  });
  const level = (number) => async () => packml_states[Math.round(await line.read(packml.state))]?.[number] ?? "";
  const base = object.getChildByName("BaseStateMachine");
  const inner = base.getChildByName("MachineState");
  const execute = inner.getChildByName("ExecuteState");
  [base, inner, execute].forEach((state_machine, number) => bind_state(state_machine, level(number)));
  const status = object.getChildByName("Status");
  if (packml.mode !== "")
    bind(status, ["UnitModeCurrent"], DataType.Int32, () => line.read(packml.mode));
}

export function add_machinery(space, namespace, machine, line, { packml, machinery }) {
  const index = index_of(space, machinery_uri);
  const has_state = machinery.executing !== "" || machinery.out_of_service !== "" || packml.state !== "";
  if (!has_state && machinery.mode === "") return;
  const blocks = namespace.addObject({
    componentOf: machine,
    browseName: { name: "MachineryBuildingBlocks", namespaceIndex: index },
    nodeId: "s=MachineryBuildingBlocks",
    typeDefinition: "FolderType",
  });
  const add = (type, name, state) => {
    const object = space.findObjectType(type, index).instantiate({
      browseName: { name, namespaceIndex: index },
      nodeId: `s=${name}`,
      namespace,
    });
    blocks.addReference({ referenceType: "HasAddIn", nodeId: object });
    bind_state(object, state);
  };
  const executing = async () => {
    if (machinery.executing !== "") return (await line.read(machinery.executing)) !== 0;
    return packml.state !== "" && working.has(Math.round(await line.read(packml.state)));
  };
  const state = async () => {
    if (machinery.out_of_service !== "" && (await line.read(machinery.out_of_service)) !== 0) return "OutOfService";
    return (await executing()) ? "Executing" : "NotExecuting";
  };
  if (has_state) add("MachineryItemState_StateMachineType", "MachineryItemState", state);
  const modes = ["None", "Maintenance", "Setup", "Processing"];
  const mode = async () => modes[Math.round(await line.read(machinery.mode))] ?? "";
  if (machinery.mode !== "") add("MachineryOperationModeStateMachineType", "MachineryOperationMode", mode);
}

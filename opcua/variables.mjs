// Variables that are the line's: read from it when somebody reads them, written by it.
import { DataType, DataValue, Range, StatusCodes, Variant, VariantArrayType } from "./ua.mjs";
import { Lost, Refused } from "./line.mjs";
import { engineering_unit } from "./units.mjs";

export const a_sample = 33; // [ms] the line tells so often

/// The OPC UA type of numbers in a range of the line.
export function type_of(range) {
  if (!range?.whole) return DataType.Double;
  if (range.low === 0 && range.high === 1) return DataType.Boolean;
  if (range.low >= -(2 ** 31) && range.high < 2 ** 31) return DataType.Int32;
  return DataType.Double;
}

/// A number of the line as a value of that type. One that a program took out of its range stays at the end of it.
function value_of(number, dataType) {
  if (dataType === DataType.Boolean) return Boolean(number);
  if (dataType === DataType.Int32) return Math.max(-(2 ** 31), Math.min(2 ** 31 - 1, Math.round(number)));
  if (dataType === DataType.UInt32) return Math.max(0, Math.min(2 ** 32 - 1, Math.round(number)));
  if (dataType === DataType.UInt64) return [Math.floor(number / 2 ** 32), number >>> 0];
  return number;
}

export function good(value, dataType, statusCode = StatusCodes.Good) {
  const arrayType = Array.isArray(value) && dataType !== DataType.UInt64 ? VariantArrayType.Array : VariantArrayType.Scalar;
  const now = new Date();
  return new DataValue({
    value: new Variant({ dataType, arrayType, value }),
    statusCode,
    sourceTimestamp: now,
    serverTimestamp: now,
  });
}

export function bad(statusCode) {
  const now = new Date();
  return new DataValue({ statusCode, sourceTimestamp: now, serverTimestamp: now });
}

/// What becomes of an error: the line is lost, or it refuses, with words that are told. Others are thrown again.
export function status_of(error, refused, told) {
  if (error instanceof Lost) return StatusCodes.BadNoCommunication;
  if (!(error instanceof Refused)) throw error;
  told(error.message);
  return error.busy ? StatusCodes.BadTooManyOperations : refused;
}

/// The binding of a variable whose value `get` gives, now or later, and that `set` writes if there is one;
/// `told` is called with what the line says to a value that it refuses.
function binding({ dataType, get, set, line, told }) {
  const options = {
    timestamped_get(callback) {
      Promise.resolve()
        .then(get)
        .then(
          (value) => callback(null, value instanceof DataValue ? value : good(value_of(value, dataType), dataType)),
          (error) => callback(null, bad(error instanceof Lost ? StatusCodes.BadNoCommunication : StatusCodes.BadUnexpectedError)),
        );
    },
  };
  if (set)
    options.timestamped_set = (dataValue, callback) => {
      Promise.resolve(dataValue.value.value)
        .then(set)
        // What a line that stands still takes acts in its next step.
        .then(() => (line.running ? StatusCodes.Good : StatusCodes.GoodCompletesAsynchronously))
        .catch((error) => status_of(error, StatusCodes.BadOutOfRange, told))
        .then((statusCode) => callback(null, statusCode), callback);
    };
  return options;
}

function add_property(namespace, owner, name, dataType, value) {
  namespace.addVariable({
    propertyOf: owner,
    browseName: { name, namespaceIndex: 0 },
    nodeId: `s=${owner.nodeId.value}/${name}`,
    typeDefinition: "PropertyType",
    dataType,
    value: { dataType: DataType.ExtensionObject, value },
  });
}

/// EngineeringUnits and EURange where there are some.
function add_unit(namespace, variable, unit, range) {
  const info = engineering_unit(unit);
  if (info) add_property(namespace, variable, "EngineeringUnits", "EUInformation", info);
  if (range) add_property(namespace, variable, "EURange", "Range", new Range({ low: range.low, high: range.high }));
}

/// Adds a variable to `owner`, or a property. `path`: its NodeId, and those of what belongs to it begin with it.
/// `namespaceIndex`: of its name.
export function add_variable(namespace, owner, { path, name, namespaceIndex = namespace.index, property, description, unit = "", range, dataType = type_of(range), ...bound }) {
  const analog = dataType !== DataType.Boolean && dataType !== DataType.String;
  const has_unit = analog && unit !== "";
  const has_range = analog && range !== undefined;
  const plain = property ? "PropertyType" : "BaseDataVariableType";
  const type = has_unit && has_range ? "AnalogUnitRangeType" : has_unit ? "AnalogUnitType" : has_range ? "AnalogItemType" : plain;
  const access = bound.set ? "CurrentRead | CurrentWrite" : "CurrentRead";
  const variable = namespace.addVariable({
    [property ? "propertyOf" : "componentOf"]: owner,
    browseName: { name, namespaceIndex },
    nodeId: `s=${path}`,
    description: description ?? "",
    typeDefinition: type,
    dataType: DataType[dataType],
    valueRank: bound.array ? 1 : -1,
    minimumSamplingInterval: a_sample,
    accessLevel: access,
    userAccessLevel: access,
  });
  variable.bindVariable(binding({ dataType, ...bound }), true);
  if (analog) add_unit(namespace, variable, unit, range);
  return variable;
}

/// A part of a type's instance now gives this value.
export function bind(instance, path, dataType, get) {
  const variable = path.reduce((node, name) => node?.getChildByName(name), instance);
  if (!variable) throw new Error(`${instance.browseName} has no ${path.join(".")}`);
  variable.minimumSamplingInterval = a_sample;
  variable.bindVariable(binding({ dataType, get }), true);
  return variable;
}


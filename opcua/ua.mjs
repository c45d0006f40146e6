// What is used of node-opcua, whose packages are CommonJS.
import { createRequire } from "node:module";

// It logs its own affairs there; standard output is for the user of the line.
console.log = console.info = console.warn = () => {};

const require = createRequire(import.meta.url);

export const { MonitoredItem, OPCUAServer, RegisterServerMethod } = require("node-opcua-server");
export const { OPCUACertificateManager } = require("node-opcua-certificate-manager");
export const { nodesets } = require("node-opcua-nodesets");
export const { MessageSecurityMode, SecurityPolicy } = require("node-opcua-secure-channel");
export const { EUInformation, Range, makeEUInformation, standardUnits } = require("node-opcua-data-access");
export const { DataValue } = require("node-opcua-data-value");
export const { StatusCodes } = require("node-opcua-status-code");
export const { DataType, Variant, VariantArrayType } = require("node-opcua-variant");

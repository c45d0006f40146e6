// Where the gateway listens, who may come in, and where its certificate is.
import { MessageSecurityMode, MonitoredItem, nodesets, OPCUACertificateManager, OPCUAServer, RegisterServerMethod, SecurityPolicy } from "./ua.mjs";
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { homedir, hostname, tmpdir } from "node:os";
import { join } from "node:path";
import { needs_packml } from "./machinery.mjs";
import { a_sample } from "./variables.mjs";

/// In the user's cache, else in a temporary folder of its own.
function certificates() {
  const folder = join(process.env.XDG_CACHE_HOME || join(homedir(), ".cache"), "drycut", "opcua");
  try {
    mkdirSync(folder, { recursive: true, mode: 0o700 });
    return folder;
  } catch {
    const own = mkdtempSync(join(tmpdir(), "drycut-opcua-"));
    process.once("exit", () => rmSync(own, { recursive: true, force: true }));
    return own;
  }
}

/// Without a token anybody on this machine; with one user drycut with it as the password, which is always
/// encrypted, over a channel that is encrypted or not.
export async function make_server({ address, port, token, described }) {
  MonitoredItem.minimumSamplingInterval = a_sample;
  const serverCertificateManager = new OPCUACertificateManager({ rootFolder: certificates(), automaticallyAcceptUnknownCertificate: true });
  await serverCertificateManager.initialize();
  const open = token === "";
  const server = new OPCUAServer({
    hostname: address,
    host: address,
    port,
    serverCertificateManager,
    securityModes: open ? [MessageSecurityMode.None] : [MessageSecurityMode.None, MessageSecurityMode.SignAndEncrypt],
    securityPolicies: open ? [SecurityPolicy.None] : [SecurityPolicy.None, SecurityPolicy.Basic256Sha256],
    allowAnonymous: open,
    userManager: { isValidUser: (user, password) => !open && user === "drycut" && password === token },
    registerServerMethod: RegisterServerMethod.HIDDEN,
    serverInfo: {
      applicationUri: `urn:${hostname()}:drycut`,
      productUri: "urn:drycut",
      applicationName: { text: `Drycut: ${described.title || described.scenario}` },
    },
    buildInfo: { productName: "Drycut", manufacturerName: "Drycut", productUri: "urn:drycut" },
    nodeset_filename: [nodesets.standard, nodesets.di, nodesets.ia, nodesets.machinery, ...(needs_packml(described.opcua) ? [nodesets.packML] : [])],
  });
  await server.initialize();
  const host = address.includes(":") ? `[${address}]` : address;
  return { server, url: `opc.tcp://${host}:${port}/` };
}

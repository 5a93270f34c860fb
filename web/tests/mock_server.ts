/** A server with the addresses of `placegraph view` and `run --view`, over synthetic runs. */
import { randomBytes } from "node:crypto";
import { readFileSync } from "node:fs";
import { type IncomingMessage, type Server, type ServerResponse, createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { join } from "node:path";

export interface Answer {
  status: number;
  type: string;
  body: string | Buffer;
}

export function json(value: unknown, status = 200): Answer {
  return { status, type: "application/json", body: JSON.stringify(value) };
}

export function refusal(status: number, text: string): Answer {
  return { status, type: "text/plain; charset=utf-8", body: text };
}

/** What one kind of server answers; null: there is no such address. */
export interface Site {
  start: { kind: "view" | "run"; title: string; editable: boolean };
  answer(method: string, path: string, body: unknown): Answer | null;
  /** Takes a stream of events, if there is one. */
  stream?(response: ServerResponse): void;
  close(): void;
}

export class MockServer {
  readonly token = randomBytes(16).toString("hex");
  private readonly server: Server;

  constructor(private readonly site: Site) {
    this.server = createServer((request, response) => void this.serve(request, response));
  }

  /** Returns the address of the page. */
  async listen(): Promise<string> {
    await new Promise<void>((resolve) => this.server.listen(0, "127.0.0.1", resolve));
    return `http://127.0.0.1:${(this.server.address() as AddressInfo).port}/${this.token}/`;
  }

  /** As when the program ends. */
  async close(): Promise<void> {
    this.site.close();
    this.server.closeAllConnections();
    await new Promise((resolve) => this.server.close(resolve));
  }

  private async serve(request: IncomingMessage, response: ServerResponse): Promise<void> {
    const prefix = `/${this.token}/`;
    const path = request.url ?? "";
    if (!path.startsWith(prefix)) return send(response, refusal(404, "There is nothing here."), "");
    const nonce = randomBytes(16).toString("base64");
    const rest = path.slice(prefix.length);
    if (rest === "events" && this.site.stream) {
      response.writeHead(200, { ...headers(nonce), "Content-Type": "text/event-stream" });
      return this.site.stream(response);
    }
    if (rest === "")
      return send(response, { status: 200, type: "text/html; charset=utf-8", body: this.page(nonce) }, nonce);
    const body: unknown = request.method === "POST" ? JSON.parse(await textOf(request)) : null;
    send(response, this.site.answer(request.method ?? "", rest, body) ?? refusal(404, "There is nothing here."), nonce);
  }

  private page(nonce: string): string {
    const start = { format: "placegraph-live-1", program: "placegraph 0.2.0", ...this.site.start };
    const text = JSON.stringify(start).replace(/</g, "\\u003c");
    return readFileSync(join(import.meta.dirname, "../dist/report.html"), "utf8")
      .replace(/^ *<meta http-equiv="Content-Security-Policy" content="[^"]*">\n/m, "")
      .replace(
        "<!--placegraph-report-->",
        () => `<script id="placegraph-live" type="application/json">${text}</script>`,
      )
      .replaceAll("placegraph-nonce", nonce);
  }
}

function headers(nonce: string): Record<string, string> {
  return {
    "Content-Security-Policy":
      `default-src 'none'; script-src 'nonce-${nonce}'; style-src 'unsafe-inline'; img-src 'self' data: blob:; ` +
      "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
  };
}

function send(response: ServerResponse, { status, type, body }: Answer, nonce: string): void {
  response.writeHead(status, { ...headers(nonce), "Content-Type": type, "Content-Length": Buffer.byteLength(body) });
  response.end(status === 204 ? undefined : body);
}

async function textOf(request: IncomingMessage): Promise<string> {
  let text = "";
  for await (const part of request) text += String(part);
  return text;
}

/** Requests to the program that serves the page. All addresses are relative to the page. */

/** An answer that is no success; `message` is a sentence for the user. */
export class ServerFault extends Error {
  constructor(
    /** HTTP status; 0 without an answer. */
    readonly status: number,
    message: string,
  ) {
    super(message);
  }
}

export const NO_ANSWER = "The program does not answer: it has ended or is out of reach.";

/** The answer to a request. Throws a ServerFault without an answer and for every status but 2xx. */
export async function request(path: string, options: RequestInit = {}): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(path, { cache: "no-store", ...options });
  } catch {
    throw new ServerFault(0, NO_ANSWER);
  }
  if (!response.ok) throw new ServerFault(response.status, faultText(response.status, await response.text()));
  return response;
}

/** The sentence of a refusal: the "error" of a JSON object, else the text as it is. */
export function faultText(status: number, body: string): string {
  try {
    const error = (JSON.parse(body) as { error?: unknown }).error;
    if (typeof error === "string" && error !== "") return error;
  } catch {
    // a plain text
  }
  const text = body.trim();
  return text === "" || text.length > 500 ? `The program answers with status ${status}.` : text;
}

export async function getJson(path: string): Promise<unknown> {
  return (await request(path)).json() as Promise<unknown>;
}

export async function postJson(path: string, body: unknown): Promise<unknown> {
  const headers = { "Content-Type": "application/json" };
  return (await request(path, { method: "POST", headers, body: JSON.stringify(body) })).json() as Promise<unknown>;
}

/** A large answer; `onProgress` gets the bytes so far and, if it is known, the size of all. */
export async function getLargeJson(
  path: string,
  onProgress: (bytes: number, all: number | null) => void,
): Promise<unknown> {
  const response = await request(path);
  const length = Number(response.headers.get("Content-Length") ?? NaN);
  const all = length > 0 ? length : null;
  if (response.body === null) return response.json() as Promise<unknown>;
  const reader = response.body.getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let bytes = 0;
  try {
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      parts.push(part.value);
      bytes += part.value.length;
      onProgress(bytes, all);
    }
  } catch {
    throw new ServerFault(0, NO_ANSWER);
  }
  return JSON.parse(await new Blob(parts).text()) as unknown;
}

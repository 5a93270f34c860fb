/** npm run mock -- view|run: serves a page of the mock server until it is stopped. */
import { MockServer } from "./mock_server";
import { RunSite, ViewSite } from "./mock_sites";

export async function main([kind]: string[]): Promise<void> {
  const site = kind === "run" ? new RunSite(500) : new ViewSite();
  console.log(await new MockServer(site).listen());
}

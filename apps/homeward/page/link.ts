// SPDX-License-Identifier: GPL-3.0-or-later
// The way to the program: events from it, commands to it.

function random(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(12)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** The token comes in the fragment once and stays in this tab; the address line forgets it. */
function tokenOfTab(): string {
  const given = /token=([0-9a-f]+)/.exec(location.hash);
  if (given) {
    sessionStorage.setItem("token", given[1]);
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem("token") ?? "";
}

export class Link {
  readonly client = random();
  private readonly token = tokenOfTab();
  private sequence = 0;
  private readonly events: EventSource;

  constructor(onOpen: (open: boolean) => void) {
    this.events = new EventSource(this.withToken(`/events?client=${this.client}`));
    this.events.onopen = () => onOpen(true);
    this.events.onerror = () => onOpen(false);
  }

  on<Data>(event: string, then: (data: Data) => void): void {
    this.events.addEventListener(event, (message) => then(JSON.parse((message as MessageEvent<string>).data) as Data));
  }

  /** What an image's address needs beside its path. */
  withToken(path: string): string {
    return this.token ? `${path}${path.includes("?") ? "&" : "?"}token=${this.token}` : path;
  }

  /** Gives a command. @returns HTTP status and words for people */
  async command(command: string, args: object = {}, take = false): Promise<{ status: number; words: string }> {
    try {
      const response = await fetch("/command", {
        method: "POST",
        headers: { "Content-Type": "application/json", "X-Homeward-Token": this.token },
        body: JSON.stringify({ client: this.client, sequence: ++this.sequence, command, arguments: args, take }),
      });
      const answer = (await response.json()) as { words: string };
      return { status: response.status, words: answer.words };
    } catch {
      return { status: 0, words: "the program does not answer" };
    }
  }
}

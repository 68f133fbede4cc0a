// Where in a JSON text each JSON Pointer leads: a scanner that is content with whatever it can read.

export interface Place {
  from: number;
  to: number;
}

/** Places of values by pointer, and where a name stands in the text of its object ("name" of a member). */
export function placesOf(text: string): Map<string, Place> {
  return new Scanner(text).scan();
}

class Scanner {
  private at = 0;
  private readonly places = new Map<string, Place>();

  constructor(private readonly text: string) {}

  scan(): Map<string, Place> {
    this.value("");
    return this.places;
  }

  private space(): void {
    while (/\s/.test(this.text[this.at] ?? "")) this.at += 1;
  }

  private string(): string {
    const from = this.at;
    this.at += 1;
    while (this.at < this.text.length && this.text[this.at] !== '"') this.at += this.text[this.at] === "\\" ? 2 : 1;
    this.at += 1;
    try {
      return JSON.parse(this.text.slice(from, this.at)) as string;
    } catch {
      return this.text.slice(from + 1, this.at - 1);
    }
  }

  private value(pointer: string): void {
    this.space();
    const from = this.at;
    const first = this.text[this.at];
    if (first === "{") this.members(pointer);
    else if (first === "[") this.items(pointer);
    else if (first === '"') this.string();
    else while (/[^\s,\]}]/.test(this.text[this.at] ?? "\n")) this.at += 1;
    this.places.set(pointer, { from, to: Math.max(from + 1, this.at) });
  }

  private members(pointer: string): void {
    this.at += 1;
    for (;;) {
      this.space();
      if (this.text[this.at] !== '"') break;
      const name = this.string();
      this.space();
      if (this.text[this.at] !== ":") break;
      this.at += 1;
      this.value(`${pointer}/${name.replace(/~/g, "~0").replace(/\//g, "~1")}`);
      this.space();
      if (this.text[this.at] !== ",") break;
      this.at += 1;
    }
    this.space();
    if (this.text[this.at] === "}") this.at += 1;
  }

  private items(pointer: string): void {
    this.at += 1;
    this.space();
    for (let i = 0; this.at < this.text.length && this.text[this.at] !== "]"; ++i) {
      const before = this.at;
      this.value(`${pointer}/${i}`);
      this.space();
      if (this.text[this.at] === ",") this.at += 1;
      this.space();
      if (this.at === before) break;
    }
    if (this.text[this.at] === "]") this.at += 1;
  }
}

/** The place of a pointer, or of the nearest thing around it that is there. */
export function placeNear(places: ReadonlyMap<string, Place>, pointer: string): Place {
  for (let path = pointer; ; path = path.slice(0, path.lastIndexOf("/"))) {
    const place = places.get(path);
    if (place) return path === pointer ? place : { from: place.from, to: place.from + 1 };
    if (!path.includes("/")) return { from: 0, to: 1 };
  }
}

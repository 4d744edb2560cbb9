/** Checks of parsed JSON: each gives the value with its type, or says where it is wrong. */

export class MalformedDocument extends Error {}

export type Check<T> = (value: unknown, place: string) => T;

/** The type that a check gives. */
export type Checked<C> = C extends Check<infer T> ? T : never;

function fail(place: string, wanted: string): never {
  throw new MalformedDocument(`${place} is not ${wanted}`);
}

export const text: Check<string> = (value, place) =>
  typeof value === "string" ? value : fail(place, "a text");

export const truth: Check<boolean> = (value, place) =>
  typeof value === "boolean" ? value : fail(place, "true or false");

export const number: Check<number> = (value, place) =>
  typeof value === "number" ? value : fail(place, "a number");

export const count: Check<number> = (value, place) =>
  typeof value === "number" && Number.isInteger(value) && value >= 0
    ? value
    : fail(place, "a whole number from 0 on");

export function oneOf<const T extends string>(...words: T[]): Check<T> {
  return (value, place) => words.find((word) => word === value) ?? fail(place, `one of ${words.join(", ")}`);
}

export function list<T>(item: Check<T>): Check<T[]> {
  return (value, place) =>
    Array.isArray(value) ? value.map((entry, i) => item(entry, `${place}[${i}]`)) : fail(place, "a list");
}

export function pair<T>(item: Check<T>): Check<[T, T]> {
  return (value, place) =>
    Array.isArray(value) && value.length === 2
      ? [item(value[0], `${place}[0]`), item(value[1], `${place}[1]`)]
      : fail(place, "a pair");
}

export function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

type Members = Record<string, Check<unknown>>;
type ObjectOf<R extends Members, O extends Members> = { [K in keyof R]: Checked<R[K]> } & {
  [K in keyof O]?: Checked<O[K]>;
};

/** An object with all members of `required`, and of `optional` those that are there and not null.
 * Further members are left out. */
export function object<R extends Members, O extends Members = Record<never, never>>(
  required: R,
  optional?: O,
): Check<ObjectOf<R, O>> {
  return (value, place) => {
    if (!isRecord(value)) return fail(place, "an object");
    const checked: Record<string, unknown> = {};
    for (const [name, check] of Object.entries(required)) {
      if (!(name in value)) throw new MalformedDocument(`${place}.${name} is missing`);
      checked[name] = check(value[name], `${place}.${name}`);
    }
    for (const [name, check] of Object.entries(optional ?? {})) {
      const member = value[name];
      if (member !== undefined && member !== null) checked[name] = check(member, `${place}.${name}`);
    }
    return checked as ObjectOf<R, O>;
  };
}

/** An object whose member `tag` says which of the checks it has to meet. */
export function tagged<V extends Record<string, Check<unknown>>>(
  tag: string,
  variants: V,
): Check<Checked<V[keyof V]>> {
  const word = oneOf(...Object.keys(variants));
  return (value, place) => {
    if (!isRecord(value)) return fail(place, "an object");
    const check = variants[word(value[tag], `${place}.${tag}`)];
    return check?.(value, place) as Checked<V[keyof V]>;
  };
}

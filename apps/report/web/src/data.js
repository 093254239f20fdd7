// The data of the report, as they stand in the page, and what they are decoded to.

/**
 * An array of the report as numbers.
 * @param {{n: number, f32?: string, f64?: string} | number[] | undefined} array base64 of little-endian numbers
 * @returns {Float32Array | Float64Array | number[]}
 */
export function numbers(array) {
  if (!array) return [];
  if (Array.isArray(array)) return array;
  if (!array.decoded) {
    const text = atob(array.f32 ?? array.f64);
    const bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
    array.decoded = array.f32 !== undefined ? new Float32Array(bytes.buffer) : new Float64Array(bytes.buffer);
    delete array.f32;
    delete array.f64;
  }
  return array.decoded;
}

/** What `froude report` has put into the page. */
export function readData() {
  return JSON.parse(document.getElementById('data').textContent);
}

/** Calls `each` with every element of `all`, grouped by `key`, groups in the order of their first element. */
export function grouped(all, key) {
  const groups = new Map();
  for (const one of all) {
    const k = key(one);
    if (!groups.has(k)) groups.set(k, []);
    groups.get(k).push(one);
  }
  return groups;
}

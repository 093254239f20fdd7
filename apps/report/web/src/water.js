// The surface of the waves of a run: ζ = r Σ a cos(ωt − k (x cos β + y sin β) + φ), in m; r grows from 0 to 1 by a
// half cosine over the ramp.

/**
 * @param {{omega: number[], k: number[], amplitude: number[], phase: number[], heading: number[],
 *   ramp: number} | null} waves
 */
export function surfaceOf(waves) {
  if (!waves || !waves.omega) return { at: () => 0, prepare: () => {}, hs: 0 };
  const n = waves.omega.length;
  const oneWay = waves.heading.every((b) => Math.abs(b - waves.heading[0]) < 1e-9);
  const cos = waves.heading.map(Math.cos),
    sin = waves.heading.map(Math.sin);
  const turned = new Float64Array(n); // ωt + φ
  let table = null,
    grown = 1;

  /** Along the one direction of long-crested waves, from −reach to reach. */
  function tabled(reach) {
    const shortest = (2 * Math.PI) / Math.max(...waves.k);
    const points = Math.min(400, Math.max(64, Math.ceil((16 * reach) / shortest)));
    const step = (2 * reach) / (points - 1),
      values = new Float64Array(points);
    for (let p = 0; p < points; ++p) {
      const s = -reach + p * step;
      for (let i = 0; i < n; ++i) values[p] += waves.amplitude[i] * Math.cos(turned[i] - waves.k[i] * s);
    }
    return { reach, step, values };
  }

  return {
    hs: 4 * Math.sqrt(waves.amplitude.reduce((sum, a) => sum + (a * a) / 2, 0)),
    /** Must be called for each instant before at(); `reach`: how far points are from the origin at most, m. */
    prepare(t, reach) {
      grown = t < waves.ramp ? (1 - Math.cos((Math.PI * t) / waves.ramp)) / 2 : 1;
      for (let i = 0; i < n; ++i) turned[i] = waves.omega[i] * t + waves.phase[i];
      table = oneWay ? tabled(reach * 1.01 + 1) : null;
    },
    at(x, y) {
      if (table) {
        const u = (x * cos[0] + y * sin[0] + table.reach) / table.step;
        const i = Math.min(Math.max(Math.floor(u), 0), table.values.length - 2);
        return grown * (table.values[i] + (u - i) * (table.values[i + 1] - table.values[i]));
      }
      let sum = 0;
      for (let i = 0; i < n; ++i)
        sum += waves.amplitude[i] * Math.cos(turned[i] - waves.k[i] * (x * cos[i] + y * sin[i]));
      return grown * sum;
    },
    oneWay,
  };
}

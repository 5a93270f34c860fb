/** Colour scales that remain readable with colour vision deficiencies. */

export type Rgb = [number, number, number];

/**
 * Samples of viridis (Smith, van der Walt 2015) and cividis (Nunez et al. 2018), sRGB in 0..255. Both
 * ends are left out: the darkest is lost on a dark ground, the brightest on a light one.
 */
const VIRIDIS: Rgb[] = [
  [72, 36, 117],
  [66, 64, 134],
  [54, 93, 141],
  [43, 117, 142],
  [33, 144, 141],
  [39, 173, 129],
  [78, 195, 107],
  [144, 215, 67],
  [218, 226, 25],
];
const CIVIDIS: Rgb[] = [
  [18, 53, 112],
  [45, 68, 110],
  [73, 83, 109],
  [98, 101, 112],
  [125, 124, 120],
  [154, 148, 118],
  [185, 173, 108],
  [212, 195, 94],
  [239, 219, 73],
];

/** For residuals over images, dark and bright: sky blue, yellow, vermilion of Okabe and Ito (2008). */
const RESIDUAL: Rgb[] = [
  [86, 180, 233],
  [240, 228, 66],
  [213, 94, 0],
];

export const SCALES = { viridis: VIRIDIS, cividis: CIVIDIS, residual: RESIDUAL } as const;
export type ScaleName = keyof typeof SCALES;

/** The colours of Okabe and Ito (2008), without black, with a yellow that is seen on white too. */
export const CATEGORIES: Rgb[] = [
  [86, 180, 233],
  [230, 159, 0],
  [0, 158, 115],
  [204, 121, 167],
  [214, 196, 20],
  [0, 114, 178],
  [213, 94, 0],
];

/** Of values that are unknown. */
export const UNKNOWN_COLOUR: Rgb = [140, 140, 140];

/** The colour at `share` (0..1) of a scale; values outside are clamped. */
export function scaleColour(name: ScaleName, share: number): Rgb {
  if (Number.isNaN(share)) return UNKNOWN_COLOUR;
  const table = SCALES[name];
  const position = Math.min(Math.max(share, 0), 1) * (table.length - 1);
  const below = Math.min(Math.floor(position), table.length - 2);
  const part = position - below;
  const a = table[below];
  const b = table[below + 1];
  return [a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part, a[2] + (b[2] - a[2]) * part];
}

export function categoryColour(index: number): Rgb {
  return index < 0 ? UNKNOWN_COLOUR : CATEGORIES[index % CATEGORIES.length];
}

export function cssColour([r, g, b]: Rgb, alpha = 1): string {
  return `rgba(${Math.round(r)}, ${Math.round(g)}, ${Math.round(b)}, ${alpha})`;
}

/** The range of a colour scale: the values between the quantiles `low` and `high`. */
export function robustRange(values: ArrayLike<number>, low = 0, high = 0.98): [number, number] {
  const finite: number[] = [];
  const stride = Math.max(1, Math.floor(values.length / 20000));
  for (let i = 0; i < values.length; i += stride) {
    if (Number.isFinite(values[i])) finite.push(values[i]);
  }
  if (finite.length === 0) return [0, 1];
  finite.sort((a, b) => a - b);
  const from = finite[Math.floor(low * (finite.length - 1))];
  const to = finite[Math.ceil(high * (finite.length - 1))];
  return to > from ? [from, to] : [from, from + Math.max(Math.abs(from) * 1e-3, 1e-6)];
}

/** The share of `value` in a range, on a linear or a logarithmic scale. */
export function shareOf(value: number, [low, high]: [number, number], logarithmic = false): number {
  if (!logarithmic) return (value - low) / (high - low);
  const floor = Math.max(low, high * 1e-6, Number.MIN_VALUE);
  return Math.log(Math.max(value, floor) / floor) / Math.log(Math.max(high / floor, 1 + 1e-9));
}

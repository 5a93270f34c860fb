/** Numbers and times as text, always with their unit. */

export const UNKNOWN = "unknown";

/** `digits` significant digits, without an exponent for sizes that people read. */
export function formatNumber(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return UNKNOWN;
  if (value === 0) return "0";
  if (Number.isInteger(value) && Math.abs(value) < 1e9) return String(value);
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(digits - 1);
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return String(Number(value.toFixed(Math.min(decimals, 12))));
}

export function formatWithUnit(value: number, unit: string, digits = 3): string {
  if (!Number.isFinite(value)) return UNKNOWN;
  return unit === "" ? formatNumber(value, digits) : `${formatNumber(value, digits)} ${unit}`;
}

export function formatPercent(share: number): string {
  return Number.isFinite(share) ? `${formatNumber(100 * share)} %` : UNKNOWN;
}

/** Seconds as "m:ss.s" or "h:mm:ss". */
export function formatTime(seconds: number): string {
  if (!Number.isFinite(seconds)) return UNKNOWN;
  const sign = seconds < 0 ? "-" : "";
  const tenths = Math.round(Math.abs(seconds) * 10);
  const hours = Math.floor(tenths / 36000);
  const minutes = Math.floor(tenths / 600) % 60;
  const rest = tenths % 600;
  const two = (n: number): string => String(n).padStart(2, "0");
  if (hours > 0) return `${sign}${hours}:${two(minutes)}:${two(Math.floor(rest / 10))}`;
  return `${sign}${minutes}:${two(Math.floor(rest / 10))}.${rest % 10}`;
}

/** A span of time in words: "850 ms", "12.3 s", "4 min 10 s". */
export function formatDuration(seconds: number | null): string {
  if (seconds === null || !Number.isFinite(seconds)) return UNKNOWN;
  if (seconds < 1) return `${formatNumber(seconds * 1000)} ms`;
  if (seconds < 60) return `${formatNumber(seconds)} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
  return `${Math.floor(seconds / 3600)} h ${Math.round((seconds % 3600) / 60)} min`;
}

/** Counts with a thin space between thousands. */
export function formatCount(count: number): string {
  return String(count).replace(/\B(?=(\d{3})+$)/g, "\u2009");
}

export function plural(count: number, one: string, many = `${one}s`): string {
  return `${formatCount(count)} ${count === 1 ? one : many}`;
}

// A binary frame: a header of 24 bytes, then one row of float32 per robot.

export const HEADER = 24;

export interface Frame {
  paused: boolean;
  sequence: number;
  /** Unix seconds on the server */
  sent: number;
  rows: Float32Array[];
}

/** `null` for what is no frame of this version, or not of rows of this width. */
export function parseFrame(data: ArrayBuffer, width: number): Frame | null {
  if (data.byteLength < HEADER) return null;
  const view = new DataView(data);
  if (view.getUint8(0) !== 1) return null;
  const robots = view.getUint16(2, true);
  if (data.byteLength !== HEADER + robots * width * 4) return null;
  const rows: Float32Array[] = [];
  for (let k = 0; k < robots; k++) rows.push(new Float32Array(data, HEADER + k * width * 4, width));
  return {
    paused: (view.getUint8(1) & 1) !== 0,
    sequence: view.getUint32(4, true),
    sent: view.getFloat64(8, true),
    rows,
  };
}

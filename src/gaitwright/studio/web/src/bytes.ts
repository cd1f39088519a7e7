// base64 as the protocol uses it: little-endian arrays.

export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; k++) bytes[k] = raw.charCodeAt(k);
  return bytes;
}

export function floats(text: string): Float32Array {
  const bytes = fromBase64(text);
  return new Float32Array(bytes.buffer, 0, bytes.length >> 2);
}

export function integers(text: string): Uint32Array {
  const bytes = fromBase64(text);
  return new Uint32Array(bytes.buffer, 0, bytes.length >> 2);
}

// Responses with many numbers: JSON followed by binary numbers, as written by polhode.lab.

const WORD = 4; // bytes of a number, and of the length of the JSON

/** The content, every array with its numbers. */
export function decoded<T>(packet: ArrayBuffer): T {
  const length = new DataView(packet).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(packet, WORD, length));
  const numbers = new Float32Array(packet, WORD + length);
  return JSON.parse(text, (key, value: unknown) => {
    if (key !== "float32") return value;
    const [begin, end] = value as [number, number];
    return numbers.subarray(begin, end);
  }) as T;
}

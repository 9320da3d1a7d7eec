// Compressed data, as polhode.view._packed writes it.

/** JSON that was compressed, with equal arrays shared; rejects in a browser that cannot unpack it. */
export async function unpacked<T>(packed: string): Promise<T> {
  const stream = new Blob([bytesOf(packed)]).stream().pipeThrough(new DecompressionStream("deflate"));
  const arrays: object[] = [];
  return JSON.parse(await new Response(stream).text(), (_, value) => {
    if (typeof value?.same === "number") return arrays[value.same];
    if (typeof value?.steps === "string") arrays.push(value);
    return value;
  }) as T;
}

/** The rows of numbers of which these are the differences, documented at _differences in polhode.view._packed. */
export function summed(steps: string, count: number, width: number): Float32Array {
  const planes = bytesOf(steps);
  const size = count * width;
  const bits = new Uint32Array(size);
  for (let column = 0; column < width; column++) {
    let sum = 0;
    for (let row = 0; row < count; row++) {
      const i = column * count + row;
      const signless = planes[i] | (planes[i + size] << 8) | (planes[i + 2 * size] << 16) | (planes[i + 3 * size] << 24);
      sum = (sum + ((signless >>> 1) ^ -(signless & 1))) | 0;
      bits[row * width + column] = sum;
    }
  }
  return new Float32Array(bits.buffer);
}

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
}

'use strict';

// What the page holds, as arrays.

const facts = JSON.parse(document.getElementById('facts').textContent);

/// The numbers of an array that packNumbers() packed. Its element is removed, because its text is large.
async function unpackNumbers(id) {
  const element = document.getElementById(id);
  const text = atob(element.textContent);
  element.remove();
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = planes.length / 4, numbers = new Uint32Array(count);
  let sum = 0;
  for (let i = 0; i < count; ++i) {
    const folded = planes[i] | planes[count + i] << 8 | planes[2 * count + i] << 16 | planes[3 * count + i] << 24;
    sum = sum + (folded >>> 1 ^ -(folded & 1)) | 0;
    numbers[i] = sum;
  }
  return numbers;
}

/// Lets the browser show what was written before long work.
const breathe = () => new Promise((go) => setTimeout(go, 0));

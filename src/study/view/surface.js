// From a mesh's faces to what is drawn. A corner is one of a triangle's three, number 3 t + k; an edge is named by the
// corner that it begins at.

const creaseCosine = Math.cos(30 * Math.PI / 180);  // Faces that meet at more share no normal, as in pdc's pictures.
const binsPerDegree = 4;

const after = (corner) => corner % 3 === 2 ? corner - 2 : corner + 1;

/// The vertices of the triangles, those of the quads first.
function triangleCorners(corners, quads) {
  const others = corners.length - 4 * quads, triangles = new Uint32Array(6 * quads + others);
  for (let q = 0, i = 0; q < 4 * quads; q += 4, i += 6) {
    triangles[i] = triangles[i + 3] = corners[q];
    triangles[i + 1] = corners[q + 1];
    triangles[i + 2] = triangles[i + 4] = corners[q + 2];
    triangles[i + 5] = corners[q + 3];
  }
  triangles.set(corners.subarray(4 * quads), 6 * quads);
  return triangles;
}

/// Whether the edge at this corner is the one along which a quad was cut in two.
const isDiagonal = (corner, quads) => corner < 6 * quads && (corner % 6 === 2 || corner % 6 === 3);

/// Vectors across the triangles, three numbers each, as long as twice their areas.
function areaVectors(places, triangles) {
  const vectors = new Float32Array(triangles.length);
  for (let i = 0; i < triangles.length; i += 3) {
    const a = 3 * triangles[i], b = 3 * triangles[i + 1], c = 3 * triangles[i + 2];
    const ux = places[b] - places[a], uy = places[b + 1] - places[a + 1], uz = places[b + 2] - places[a + 2];
    const vx = places[c] - places[a], vy = places[c + 1] - places[a + 1], vz = places[c + 2] - places[a + 2];
    vectors[i] = uy * vz - uz * vy;
    vectors[i + 1] = uz * vx - ux * vz;
    vectors[i + 2] = ux * vy - uy * vx;
  }
  return vectors;
}

/// The edges: `first` and `second` are corners of their two faces; `second` is -1 for one face, -2 for more than two.
function findEdges(triangles, vertices) {
  const starts = new Uint32Array(vertices + 1), count = triangles.length;
  const lower = (c) => Math.min(triangles[c], triangles[after(c)]);
  for (let c = 0; c < count; ++c) ++starts[lower(c) + 1];
  for (let v = 0; v < vertices; ++v) starts[v + 1] += starts[v];
  const sorted = new Uint32Array(count), next = starts.slice(0, vertices);
  for (let c = 0; c < count; ++c) sorted[next[lower(c)]++] = c;
  const edgeAt = new Int32Array(vertices).fill(-1), first = new Uint32Array(count), second = new Int32Array(count);
  let edges = 0;
  for (let v = 0; v < vertices; ++v) {
    const before = edges;
    for (let i = starts[v]; i < starts[v + 1]; ++i) {
      const c = sorted[i], a = triangles[c], b = triangles[after(c)], upper = Math.max(a, b);
      if (a === b) continue;
      const edge = edgeAt[upper];
      if (edge < before) {
        edgeAt[upper] = edges;
        first[edges] = c;
        second[edges++] = -1;
      } else {
        second[edge] = second[edge] === -1 ? c : -2;
      }
    }
  }
  return {first: first.slice(0, edges), second: second.slice(0, edges)};
}

/// The cosine of the angle between the faces of each edge: -2 where there are not two, or where they face differently.
function edgeCosines(edges, triangles, vectors) {
  const cosines = new Float32Array(edges.first.length).fill(-2);
  for (let e = 0; e < cosines.length; ++e) {
    const c = edges.first[e], d = edges.second[e];
    if (d < 0 || triangles[c] === triangles[d]) continue;
    const i = c - c % 3, j = d - d % 3;
    const dot = vectors[i] * vectors[j] + vectors[i + 1] * vectors[j + 1] + vectors[i + 2] * vectors[j + 2];
    const lengths = Math.hypot(vectors[i], vectors[i + 1], vectors[i + 2]) *
        Math.hypot(vectors[j], vectors[j + 1], vectors[j + 2]);
    cosines[e] = lengths > 0 ? Math.min(1, dot / lengths) : 1;  // What has no area makes no crease.
  }
  return cosines;
}

/// Corners of one vertex that share a normal get one vertex to draw. The vertices keep their numbers, those that a crease
/// parts get further ones. \returns the triangles with these, and which vertex each further one repeats.
function splitAtCreases(triangles, vertices, edges, cosines) {
  const parent = new Int32Array(triangles.length);
  for (let c = 0; c < parent.length; ++c) parent[c] = c;
  const find = (c) => {
    while (parent[c] !== c) c = parent[c] = parent[parent[c]];
    return c;
  };
  const join = (a, b) => { parent[find(a)] = find(b); };
  for (let e = 0; e < cosines.length; ++e) {
    if (cosines[e] < creaseCosine) continue;
    const c = edges.first[e], d = edges.second[e];
    join(c, after(d));
    join(after(c), d);
  }
  const drawn = new Uint32Array(triangles.length), ofRoot = new Int32Array(triangles.length).fill(-1), repeated = [];
  const used = new Uint8Array(vertices);
  for (let c = 0; c < triangles.length; ++c) {
    const root = find(c), v = triangles[c];
    if (ofRoot[root] < 0) {
      ofRoot[root] = used[v] ? vertices + repeated.push(v) - 1 : v;
      used[v] = 1;
    }
    drawn[c] = ofRoot[root];
  }
  return {drawn, repeated};
}

/// The normals of the drawn vertices, four numbers each, of which the last is not used.
function vertexNormals(drawn, count, vectors) {
  const sums = new Float32Array(3 * count), normals = new Int16Array(4 * count);
  for (let c = 0; c < drawn.length; ++c)
    for (let k = 0, i = c - c % 3; k < 3; ++k) sums[3 * drawn[c] + k] += vectors[i + k];
  for (let v = 0; v < count; ++v) {
    const scale = 32767 / Math.max(1e-30, Math.hypot(sums[3 * v], sums[3 * v + 1], sums[3 * v + 2]));
    for (let k = 0; k < 3; ++k) normals[4 * v + k] = sums[3 * v + k] * scale;
  }
  return normals;
}

/// The edges but diagonals of quads, two vertices each, the sharpest first, and how many there are above each angle, in
/// steps of 1 / binsPerDegree degrees. What has not two faces counts as 180 degrees.
function sortByAngle(triangles, quads, edges, cosines) {
  const bins = 180 * binsPerDegree, above = new Uint32Array(bins + 2), bin = new Uint16Array(cosines.length);
  const left = (e) => isDiagonal(edges.first[e], quads);
  for (let e = 0; e < cosines.length; ++e) {
    if (left(e)) continue;
    bin[e] = cosines[e] < -1 ? bins : Math.acos(cosines[e]) * (bins / Math.PI);
    ++above[bin[e]];
  }
  for (let b = bins; b >= 0; --b) above[b] += above[b + 1];
  const next = above.slice(1), ends = new Uint32Array(2 * above[0]);
  for (let e = 0; e < cosines.length; ++e) {
    if (left(e)) continue;
    const i = 2 * next[bin[e]]++, c = edges.first[e];
    ends[i] = triangles[c];
    ends[i + 1] = triangles[after(c)];
  }
  return {ends, above: (degrees) => above[Math.min(bins, Math.ceil(degrees * binsPerDegree))]};
}

/// Few triangles for while the view moves: of the vertices in one cell of a grid the first stands for all.
function coarseTriangles(places, drawn, cells) {
  const first = new Int32Array(cells ** 3).fill(-1), count = places.length / 3, stands = new Uint32Array(count);
  const place = (x) => Math.min(cells - 1, Math.max(0, Math.floor((x + 1) / 2 * cells)));
  for (let v = 0; v < count; ++v) {
    const cell = (place(places[3 * v]) * cells + place(places[3 * v + 1])) * cells + place(places[3 * v + 2]);
    if (first[cell] < 0) first[cell] = v;
    stands[v] = first[cell];
  }
  const coarse = new Uint32Array(drawn.length);
  let size = 0;
  for (let c = 0; c < drawn.length; c += 3) {
    const i = stands[drawn[c]], j = stands[drawn[c + 1]], k = stands[drawn[c + 2]];
    if (i === j || j === k || k === i) continue;
    coarse[size++] = i;
    coarse[size++] = j;
    coarse[size++] = k;
  }
  return coarse.slice(0, size);
}

/// All of a mesh's arrays for drawing. \param frame what the page's unit is: {center, radius} in world units.
async function makeSurface(name, frame) {
  const {corner, step, vertices, quads} = facts[name];
  const counts = await unpackNumbers(name + '_positions');
  let places = new Float32Array(3 * vertices);
  for (let axis = 0; axis < 3; ++axis) {
    const from = (corner[axis] - frame.center[axis]) / frame.radius, size = step / frame.radius;
    for (let v = 0, i = axis * vertices; v < vertices; ++v) places[3 * v + axis] = from + counts[i + v] * size;
  }
  const triangles = triangleCorners(await unpackNumbers(name + '_corners'), quads);
  await breathe();
  const vectors = areaVectors(places, triangles), edges = findEdges(triangles, vertices);
  const cosines = edgeCosines(edges, triangles, vectors);
  const {drawn, repeated} = splitAtCreases(triangles, vertices, edges, cosines);
  const all = new Float32Array(3 * (vertices + repeated.length));
  all.set(places);
  repeated.forEach((v, i) => all.set(places.subarray(3 * v, 3 * v + 3), 3 * (vertices + i)));
  places = all;
  return {
    places, drawn, repeated, vertices,
    normals: vertexNormals(drawn, places.length / 3, vectors),
    lines: sortByAngle(triangles, quads, edges, cosines),
    closed: edges.second.every((d, e) => d >= 0 && triangles[d] !== triangles[edges.first[e]]),
    coarse: drawn.length > 600000 ? coarseTriangles(places, drawn, 128) : drawn,
  };
}

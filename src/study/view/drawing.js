// Draws surfaces with WebGL 2. Places are in the page's unit, about the middle of the mesh; z is up.

const surfaceVertexShader = `#version 300 es
uniform mat4 toScreen, toEye;
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in float value;
layout(location = 3) in vec3 colour;
out vec3 atEye, atModel, normalAtEye, paint;
out float number, known;
void main() {
  atModel = place;
  atEye = (toEye * vec4(place, 1)).xyz;
  normalAtEye = mat3(toEye) * normal;
  number = value;
  known = value > 65000.5 ? 0. : 1.;
  paint = colour;
  gl_Position = toScreen * vec4(place, 1);
}`;

// The light of pdc's pictures (src/render/shading.cpp): a lamp on the left above the viewer, a weak one on the right.
const surfaceFragmentShader = `#version 300 es
precision highp float;
uniform vec4 section;  // What lies on its positive side is cut away.
uniform int mode;      // 0: one colour, 1: values, 2: colours of the vertices.
uniform bool flatFaces;
uniform vec3 base, backs, ramp[5];
uniform vec2 share;    // From a value's number to its place on the ramp: factor and summand.
uniform float alpha;
in vec3 atEye, atModel, normalAtEye, paint;
in float number, known;
out vec4 result;
void main() {
  if (dot(section.xyz, atModel) > section.w) discard;
  vec3 n = normalize(cross(dFdx(atEye), dFdy(atEye)));
  if (!flatFaces) {
    vec3 smoothed = normalAtEye * (gl_FrontFacing ? 1. : -1.);
    if (dot(smoothed, smoothed) > 1e-6) n = normalize(smoothed);
  }
  vec3 own = base;
  if (mode == 1) {
    float at = clamp(number * share.x + share.y, 0., 1.) * 4.;
    int low = min(int(at), 3);
    own = known < .999 ? vec3(.3) : mix(ramp[low], ramp[low + 1], at - float(low));
  } else if (mode == 2) {
    own = paint * paint;
  }
  if (!gl_FrontFacing) own = mode == 0 ? backs : own * .6;
  float lamp = max(0., dot(n, vec3(-.48, .6, .64))) + .18 * max(0., dot(n, vec3(.8, .1, .59)));
  float ambient = mode == 0 ? .3 : .55;
  float light = ambient * (.6 + .4 * (.5 + .5 * n.y)) + (1.15 - ambient) * lamp;
  result = vec4(sqrt(clamp(own * light, 0., 1.)), alpha);
}`;

// Lines as strips of two triangles, moved a little towards the viewer.
const lineVertexShader = `#version 300 es
uniform mat4 toScreen;
uniform vec2 halfWidth;  // In units of the screen, -1 to 1.
layout(location = 0) in vec3 begin;
layout(location = 1) in vec3 end;
out vec3 atModel;
void main() {
  vec4 a = toScreen * vec4(begin, 1), b = toScreen * vec4(end, 1);
  vec3 from = begin, to = end;
  float least = 1e-3;  // What is behind the eye has no place on the screen.
  if (a.w < least && b.w > least) { float t = (least - a.w) / (b.w - a.w); a = mix(a, b, t); from = mix(from, to, t); }
  if (b.w < least && a.w > least) { float t = (least - b.w) / (a.w - b.w); b = mix(b, a, t); to = mix(to, from, t); }
  vec2 along = (b.xy / b.w - a.xy / a.w) / halfWidth;
  vec2 across = normalize(vec2(-along.y, along.x) + vec2(1e-9, 0.)) * (gl_VertexID % 2 == 0 ? 1. : -1.);
  bool atEnd = gl_VertexID > 1;
  vec4 p = atEnd ? b : a;
  atModel = atEnd ? to : from;
  gl_Position = vec4(p.xy + across * halfWidth * p.w, p.z - 4e-4 * p.w, p.w);
}`;
const plainVertexShader = `#version 300 es
uniform mat4 toScreen;
layout(location = 0) in vec3 place;
out vec3 atModel;
void main() {
  atModel = place;
  gl_Position = toScreen * vec4(place, 1);
  gl_Position.z -= 2e-4 * gl_Position.w;
}`;
const lineFragmentShader = `#version 300 es
precision highp float;
uniform vec4 section, ink;
in vec3 atModel;
out vec4 result;
void main() {
  if (dot(section.xyz, atModel) > section.w + 1e-5) discard;
  result = ink;
}`;
const capFragmentShader = `#version 300 es
precision highp float;
uniform vec4 ink;
in vec3 atModel;
out vec4 result;
void main() {
  float stripe = mod(gl_FragCoord.x + gl_FragCoord.y, 12.);
  result = vec4(ink.rgb * (stripe < 2.5 ? .72 : 1.), 1);
}`;

class Drawing {
  constructor(canvas) {
    this.canvas = canvas;
    const gl = this.gl = canvas.getContext('webgl2', {alpha: false, stencil: true, powerPreference: 'high-performance'});
    if (!gl) throw new Error('this browser has no WebGL 2, or it is turned off');
    this.surfaces = this.makeProgram(surfaceVertexShader, surfaceFragmentShader);
    this.thick = this.makeProgram(lineVertexShader, lineFragmentShader);
    this.thin = this.makeProgram(plainVertexShader, lineFragmentShader);
    this.caps = this.makeProgram(plainVertexShader, capFragmentShader);
    this.capPlaces = gl.createBuffer();
    this.capArray = gl.createVertexArray();
    gl.bindVertexArray(this.capArray);
    this.attribute(0, this.capPlaces, 3, gl.FLOAT);
    gl.bindVertexArray(null);
  }

  makeProgram(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram(), at = {};
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error('a shader: ' + gl.getProgramInfoLog(program));
    for (let i = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) - 1; i >= 0; --i) {
      const name = gl.getActiveUniform(program, i).name.replace('[0]', '');
      at[name] = gl.getUniformLocation(program, name);
    }
    return {program, at};
  }

  attribute(location, buffer, size, type, {normalized = false, divisor = 0, stride = 0, offset = 0} = {}) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, size, type, normalized, stride, offset);
    gl.vertexAttribDivisor(location, divisor);
  }

  upload(target, data, usage) {
    const gl = this.gl, buffer = gl.createBuffer();
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, data, usage || gl.STATIC_DRAW);
    return buffer;
  }

  /// Gives a surface's arrays to the graphics processor and adds what draw() needs.
  prepare(surface) {
    const gl = this.gl;
    surface.placeBuffer = this.upload(gl.ARRAY_BUFFER, surface.places);
    const normals = this.upload(gl.ARRAY_BUFFER, surface.normals);
    const makeArray = (triangles) => {
      const array = gl.createVertexArray();
      gl.bindVertexArray(array);
      this.attribute(0, surface.placeBuffer, 3, gl.FLOAT);
      this.attribute(1, normals, 3, gl.SHORT, {normalized: true, stride: 8});
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.upload(gl.ELEMENT_ARRAY_BUFFER, triangles));
      gl.bindVertexArray(null);
      return {array, size: triangles.length};
    };
    surface.full = makeArray(surface.drawn);
    surface.quick = surface.coarse === surface.drawn ? surface.full : makeArray(surface.coarse);
  }

  /// \param numbers one per vertex: places of values, or colours, red << 16 | green << 8 | blue.
  setValues(surface, numbers, areColours) {
    const gl = this.gl, count = surface.vertices, total = count + surface.repeated.length;
    const numberOf = (v) => numbers[v < count ? v : surface.repeated[v - count]];
    const data = areColours ? new Uint8Array(4 * total) : new Uint16Array(total);
    for (let v = 0; v < total; ++v) {
      const number = numberOf(v);
      if (areColours) data.set([number >> 16, number >> 8 & 255, number & 255], 4 * v);
      else data[v] = number;
    }
    const buffer = this.upload(gl.ARRAY_BUFFER, data);
    for (const part of new Set([surface.full, surface.quick])) {
      gl.bindVertexArray(part.array);
      if (areColours) this.attribute(3, buffer, 3, gl.UNSIGNED_BYTE, {normalized: true, stride: 4});
      else this.attribute(2, buffer, 1, gl.UNSIGNED_SHORT);
    }
    gl.bindVertexArray(null);
    if (surface.valueBuffer) gl.deleteBuffer(surface.valueBuffer);
    surface.valueBuffer = buffer;
  }

  drawSurface(surface, scene, look) {
    const gl = this.gl, {program, at} = this.surfaces, part = scene.quick ? surface.quick : surface.full;
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.toScreen, false, scene.toScreen);
    gl.uniformMatrix4fv(at.toEye, false, scene.toEye);
    gl.uniform4fv(at.section, scene.section);
    gl.uniform1i(at.mode, look.mode);
    gl.uniform1i(at.flatFaces, scene.flatFaces ? 1 : 0);
    gl.uniform3fv(at.base, look.base);
    gl.uniform3fv(at.backs, look.backs);
    gl.uniform3fv(at.ramp, facts.ramp.flat());
    gl.uniform2fv(at.share, look.share || [0, 0]);
    gl.uniform1f(at.alpha, look.alpha);
    gl.bindVertexArray(part.array);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    gl.drawElements(gl.TRIANGLES, part.size, gl.UNSIGNED_INT, 0);
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }

  /// Fills what the section plane cuts of a closed surface: where a ray enters it more often than it leaves.
  drawCap(surface, scene, look) {
    const gl = this.gl;
    gl.enable(gl.STENCIL_TEST);
    gl.disable(gl.DEPTH_TEST);
    gl.colorMask(false, false, false, false);
    gl.stencilFunc(gl.ALWAYS, 0, 255);
    gl.stencilOpSeparate(gl.FRONT, gl.KEEP, gl.KEEP, gl.DECR_WRAP);
    gl.stencilOpSeparate(gl.BACK, gl.KEEP, gl.KEEP, gl.INCR_WRAP);
    this.drawSurface(surface, scene, look);
    gl.colorMask(true, true, true, true);
    gl.enable(gl.DEPTH_TEST);
    gl.stencilFunc(gl.NOTEQUAL, 0, 255);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.ZERO);
    gl.useProgram(this.caps.program);
    gl.uniformMatrix4fv(this.caps.at.toScreen, false, scene.toScreen);
    gl.uniform4fv(this.caps.at.ink, [.83, .79, .70, 1]);
    const {axis, place, reach: r} = scene.cut, corners = [];
    for (const [s, t] of [[-r, -r], [r, -r], [-r, r], [r, r]]) {
      const corner = [s, t];
      corner.splice(axis, 0, place);
      corners.push(...corner);
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, this.capPlaces);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(corners), gl.DYNAMIC_DRAW);
    gl.bindVertexArray(this.capArray);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.disable(gl.STENCIL_TEST);
  }

  useLines({program, at}, scene, ink) {
    const gl = this.gl;
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.toScreen, false, scene.toScreen);
    gl.uniform4fv(at.section, scene.section);
    gl.uniform4fv(at.ink, ink);
    if (at.halfWidth) gl.uniform2f(at.halfWidth, scene.lineWidth / this.canvas.width, scene.lineWidth / this.canvas.height);
  }

  drawEdges(surface, scene, ink) {
    const gl = this.gl;
    if (!surface.edgeArray) {
      surface.edgeArray = gl.createVertexArray();
      gl.bindVertexArray(surface.edgeArray);
      this.attribute(0, surface.placeBuffer, 3, gl.FLOAT);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.upload(gl.ELEMENT_ARRAY_BUFFER, surface.lines.ends));
    }
    this.useLines(this.thin, scene, ink);
    gl.bindVertexArray(surface.edgeArray);
    gl.drawElements(gl.LINES, surface.lines.ends.length, gl.UNSIGNED_INT, 0);
  }

  drawCreases(surface, scene, degrees, ink) {
    const gl = this.gl, count = surface.lines.above(degrees);
    if (!surface.creaseArray || count > surface.creaseCount) {
      const places = new Float32Array(6 * count);
      for (let i = 0; i < 2 * count; ++i)
        for (let k = 0; k < 3; ++k) places[3 * i + k] = surface.places[3 * surface.lines.ends[i] + k];
      if (surface.creaseBuffer) gl.deleteBuffer(surface.creaseBuffer);
      surface.creaseBuffer = this.upload(gl.ARRAY_BUFFER, places);
      surface.creaseCount = count;
      surface.creaseArray = surface.creaseArray || gl.createVertexArray();
      gl.bindVertexArray(surface.creaseArray);
      this.attribute(0, surface.creaseBuffer, 3, gl.FLOAT, {divisor: 1, stride: 24});
      this.attribute(1, surface.creaseBuffer, 3, gl.FLOAT, {divisor: 1, stride: 24, offset: 12});
    }
    this.useLines(this.thick, scene, ink);
    gl.bindVertexArray(surface.creaseArray);
    if (count > 0) gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
  }

  /// Draws all. \param scene matrices, section, what is shown; parts: [{surface, look, lines}] from back to front.
  draw(scene) {
    const gl = this.gl;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(...scene.background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE);
    for (const {surface, look} of scene.parts) {
      const through = look.alpha < 1;
      (through ? gl.enable : gl.disable).call(gl, gl.BLEND);
      gl.depthMask(!through);
      this.drawSurface(surface, scene, look);
      gl.depthMask(true);
      if (scene.cut && surface.closed && !through && !scene.quick) this.drawCap(surface, scene, look);
      gl.enable(gl.BLEND);
      if (scene.edges && !through) this.drawEdges(surface, scene, scene.edgeInk);
      if (scene.creases && !(through && scene.edges)) this.drawCreases(surface, scene, scene.creases, look.creaseInk);
      gl.disable(gl.BLEND);
    }
    gl.bindVertexArray(null);
  }
}

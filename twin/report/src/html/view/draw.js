// ---- draw.js: what is on the graphics card, and one picture ----

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  // solid and glass share their vertex arrays
  ['a_at', 'a_normal'].forEach((name, k) => gl.bindAttribLocation(made, k, name));
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(made));
  const uniforms = {};
  const many = gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS) || 0;
  for (let k = 0; k < many; k++) {
    const { name, type } = gl.getActiveUniform(made, k);
    uniforms[name] = { at: gl.getUniformLocation(made, name), type };
  }
  return { made, uniforms };
}

// Uses a program with these values; names that it does not have are passed over.
function use(gl, { made, uniforms }, values) {
  gl.useProgram(made);
  for (const [name, value] of Object.entries(values)) {
    const uniform = uniforms['u_' + name];
    if (!uniform) continue;
    switch (uniform.type) {
      case gl.FLOAT: gl.uniform1f(uniform.at, value); break;
      case gl.FLOAT_VEC2: gl.uniform2fv(uniform.at, value); break;
      case gl.FLOAT_VEC3: gl.uniform3fv(uniform.at, value); break;
      case gl.FLOAT_VEC4: gl.uniform4fv(uniform.at, value); break;
      case gl.FLOAT_MAT4: gl.uniformMatrix4fv(uniform.at, false, value); break;
      case gl.INT_VEC2: gl.uniform2iv(uniform.at, value); break;
      default: gl.uniform1i(uniform.at, value);
    }
  }
}

// A vertex array: entries are [name, floats, data or buffer].
function vertices(gl, { made }, entries, perInstance, faces) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  for (const [name, size, data] of entries) {
    const at = gl.getAttribLocation(made, name);
    if (at < 0) continue;
    gl.bindBuffer(gl.ARRAY_BUFFER, data instanceof Float32Array ? buffer(gl, data) : data);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
    if (perInstance) gl.vertexAttribDivisor(at, 1);
  }
  if (faces) {
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, faces, gl.STATIC_DRAW);
  }
  gl.bindVertexArray(null);
  return array;
}

function buffer(gl, data) {
  const made = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, made);
  gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
  return made;
}

class Renderer {
  constructor(gl, scene) {
    Object.assign(this, { gl, scene, size: [0, 0] });
    this.programs = {
      capsule: program(gl, CAPSULE_VERTEX, CAPSULE_FRAGMENT), mesh: program(gl, MESH_VERTEX, meshFragment(false)), glass: program(gl, MESH_VERTEX, meshFragment(true)),
      dome: program(gl, WHOLE_VERTEX, DOME_FRAGMENT), line: program(gl, LINE_VERTEX, LINE_FRAGMENT),
      mark: program(gl, MARK_VERTEX, MARK_FRAGMENT), pick: program(gl, WHOLE_VERTEX, PICK_FRAGMENT),
    };
    const { strands } = scene;
    this.segments = [...scene.bodies.map(body => body.capsules), 0].reduce((a, b) => a + b) + strands.many;
    this.fillSegments(strands);
    this.bodies = scene.bodies.map(body => this.body(body));
    this.marksAt = scene.findings.filter(finding => finding.at);
    this.markKinds = gl.createBuffer();
    this.marks = vertices(gl, this.programs.mark, [
      ['a_at', 3, new Float32Array(this.marksAt.flatMap(finding => finding.at))], ['a_kind', 1, this.markKinds]], true);
    this.pickTarget = this.target(gl.RGBA8, 1, 1);
    this.empty = gl.createVertexArray();
  }

  body(body) {
    const { gl, programs } = this;
    return { ...body, mesh: body.triangles ? vertices(gl, programs.mesh, [['a_at', 3, body.at], ['a_normal', 3, body.normal]], false, body.face) : null };
  }

  // strands, then the round ones of the bodies, which are always there
  fillSegments({ many, ends, plannedEnds, radius, when }) {
    const rows = Math.max(1, Math.ceil(this.segments / WIDE)), table = () => new Float32Array(4 * WIDE * rows);
    const [from, to, plannedFrom, plannedTo] = [table(), table(), table(), table()];
    this.more = new Float32Array(2 * WIDE * rows).fill(UNKNOWN);
    const put = (array, k, data, first, last) => { array.set(data.subarray(first, first + 3), 4 * k); array[4 * k + 3] = last; };
    for (let k = 0; k < many; k++) {
      const [begin, end] = [when[2 * k], when[2 * k + 1]];
      put(from, k, ends, 6 * k, radius[k]); put(to, k, ends, 6 * k + 3, begin);
      put(plannedFrom, k, plannedEnds, 6 * k, end); put(plannedTo, k, plannedEnds, 6 * k + 3, begin);
      this.more[2 * k + 1] = end;
    }
    let next = many;
    for (const body of this.scene.bodies) for (let k = 0; k < body.capsules; k++, next++) {
      put(from, next, body.capsule, 7 * k, body.capsule[7 * k + 6]); put(to, next, body.capsule, 7 * k + 3, -1e30);
      this.more[2 * next + 1] = -1e30;
    }
    const { gl } = this, made = array => this.fill(this.texture(gl.RGBA32F, WIDE, rows), gl.RGBA, array, rows);
    this.tables = { from: made(from), to: made(to), plannedFrom: made(plannedFrom), plannedTo: made(plannedTo), more: this.texture(gl.RG32F, WIDE, rows) };
    this.rows = rows;
  }

  fill(texture, format, array, rows) {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, WIDE, rows, format, gl.FLOAT, array);
    return texture;
  }

  setValues(values) {
    values.forEach((value, k) => { this.more[2 * k] = value; });
    this.gl.activeTexture(this.gl.TEXTURE0);
    this.fill(this.tables.more, this.gl.RG, this.more, this.rows);
  }

  // capsules from one number on; `values` are those of the shader
  drawCapsules(first, many, model, values) {
    const { gl, tables } = this;
    this.bind(null, null, tables.from, tables.to, tables.more);
    use(gl, this.programs.capsule, { ...this.shared, ...this.ray(model), from: 2, to: 3, more: 4, model, ...values });
    gl.enable(gl.CULL_FACE); gl.cullFace(gl.BACK);
    gl.bindVertexArray(this.empty);
    gl.drawArrays(gl.TRIANGLE_STRIP, 16 * first, 16 * many);
    gl.disable(gl.CULL_FACE);
  }

  texture(format, width, height) {
    const { gl } = this, made = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return made;
  }

  target(format, width, height, withDepth) {
    const { gl } = this, made = { frame: gl.createFramebuffer(), colour: this.texture(format, width, height), width, height };
    gl.bindFramebuffer(gl.FRAMEBUFFER, made.frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, made.colour, 0);
    if (withDepth) {
      made.depth = this.texture(gl.DEPTH_COMPONENT24, width, height);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, made.depth, 0);
    }
    return made;
  }

  resize(width, height, fine) {
    const { gl, solid } = this;
    if (solid && solid.width === width * fine && solid.height === height * fine) return;
    if (solid) { gl.deleteFramebuffer(solid.frame); gl.deleteTexture(solid.colour); gl.deleteTexture(solid.depth); }
    this.solid = this.target(gl.RGBA8, width * fine, height * fine, true);
  }

  // One picture. `look`: camera, poses, timeS, fine, glass, arm, planned, marks, chosen, bodies, colours of the page
  draw(look) {
    const { gl } = this, { width, height } = gl.canvas;
    this.size = [width, height];
    this.resize(width, height, look.fine);
    const m = look.camera.matrices(width / height, look.reach);
    const level = [m.forward[0], m.forward[1], 0];
    const sun = add(add([0, 0, 1], m.right, -0.55), level, -0.45);
    this.shared = {
      view_project: m.viewProject, forward: m.forward, sun: sun.map(x => x / norm(sun)), size: this.size, time: look.timeS,
      depth: 0, colour: 1, fine: look.fine, range: [m.near, m.far], flat: look.camera.flat ? 1 : 0,
    };
    this.matrices = m;
    this.distance = look.camera.distance;
    this.drawSolid(look, m);
    this.drawDome(look);
    this.drawOver(look, m);
  }

  drawSolid(look, m) {
    const { gl, solid, scene } = this;
    this.bind(null, null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, solid.frame);
    gl.viewport(0, 0, solid.width, solid.height);
    gl.enable(gl.DEPTH_TEST); gl.disable(gl.BLEND); gl.depthMask(true); gl.depthFunc(gl.LEQUAL);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    let round = scene.strands.many;
    for (const body of this.bodies) {
      if (look.shows(body) && !look.isGlass(body)) this.drawBody(body, look, false, round);
      round += body.capsules;
    }
    const part = look.poses[scene.head.part];
    const least = 0.55 * (look.camera.flat ? look.camera.distance : 1) * 2 * m.half / solid.height;
    this.drawCapsules(0, firstAbove(scene.strands.begins, look.timeS), part, { pixel: least, plain: rgb(COLOURS.plain), shine: 0.12, faded: look.isPicked ? 1 : 0 });
  }

  // the eye, or the way of parallel rays, in the axes of a thing
  ray(model) {
    const { eye, forward } = this.matrices;
    return { eye: this.shared.flat ? [...unturned(model, forward), 0] : [...unmoved(model, eye), 1] };
  }

  drawBody(body, look, isGlass, round) {
    const { gl } = this, model = look.poses[body.mover];
    const base = rgb(KIND_COLOURS[body.kind][0]);
    const plain = look.named.includes(body.name) ? base.map((x, i) => mix(x, rgb(COLOURS.highlight)[i], 0.7)) : base;
    if (body.mesh) {
      use(gl, isGlass ? this.programs.glass : this.programs.mesh, { ...this.shared, model, plain, grid: body.kind === 'bed' ? this.scene.gridM : 0 });
      gl.bindVertexArray(body.mesh);
      gl.drawElements(gl.TRIANGLES, body.face.length, gl.UNSIGNED_SHORT, 0);
    }
    if (body.capsules && !isGlass) this.drawCapsules(round, body.capsules, model, { plain, pixel: 0, shine: 0.1, faded: 0 });
  }

  drawDome(look) {
    const { gl, solid } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, ...this.size);
    gl.disable(gl.DEPTH_TEST);
    gl.clearDepth(1); gl.depthMask(true);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.bind(solid.depth, solid.colour);
    use(gl, this.programs.dome, { ...this.shared, top: look.ground[0], bottom: look.ground[1], height: this.size[1], samples: look.fine, ring: look.fine * look.dpr });
    gl.bindVertexArray(this.empty);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  bind(...textures) {
    const { gl } = this;
    textures.forEach((texture, unit) => { gl.activeTexture(gl.TEXTURE0 + unit); gl.bindTexture(gl.TEXTURE_2D, texture); });
  }

  // what hides nothing: glass, path to come, marks; against the depth of the solid things
  drawOver(look, m) {
    const { gl, scene } = this, part = look.poses[scene.head.part];
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE);
    // the strand that is being laid may have begun a few segments ago
    const laid = Math.max(0, firstAbove(scene.strands.begins, look.timeS) - 8), left = scene.strands.many - laid;
    if (look.planned && look.timeS < scene.strands.doneS) {
      this.bind(this.solid.depth, null, this.tables.plannedFrom, this.tables.plannedTo);
      use(gl, this.programs.line, { ...this.shared, from: 2, to: 3, model: part, wide: 0.7 * look.dpr, ink: look.ink });
      gl.bindVertexArray(this.empty);
      gl.drawArrays(gl.TRIANGLE_STRIP, 6 * laid, 6 * left);
    }
    this.bind(this.solid.depth, this.solid.colour);
    const glass = this.bodies.filter(body => look.shows(body) && look.isGlass(body));
    if (glass.length) {
      // depth alone first, so that only the nearest skin is seen
      gl.enable(gl.DEPTH_TEST);
      for (const pass of [0, 1]) {
        gl.colorMask(pass === 1, pass === 1, pass === 1, pass === 1);
        gl.depthMask(pass === 0);
        glass.forEach(body => this.drawBody(body, look, true));
      }
      gl.disable(gl.DEPTH_TEST);
    }
    const seen = this.sparse(look, part);
    if (seen.size) {
      const kinds = this.marksAt.map(finding => seen.has(finding) ? { note: 0, warning: 1, error: 2 }[finding.kind] + (finding === look.chosen ? 10 : 0) : -1);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.markKinds);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(kinds), gl.DYNAMIC_DRAW);
      use(gl, this.programs.mark, { ...this.shared, model: part, radius: (seen.size > 30 ? 5.5 : 7) * look.dpr, ring: look.ring, near: this.slack(m, look) });
      gl.bindVertexArray(this.marks);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.marksAt.length);
    }
    this.marksSeen = seen;
    gl.disable(gl.BLEND);
  }

  // the marks without those that would lie on a worse one: a part full of findings is still to be seen
  sparse(look, part) {
    const rank = finding => finding === look.chosen ? -1 : ['error', 'warning', 'note'].indexOf(finding.kind);
    const seen = new Set(), taken = [], apart = (look.marks.length > 30 ? 30 : 9) * look.dpr;
    for (const finding of [...look.marks].sort((a, b) => rank(a) - rank(b))) {
      const p = this.project(moved(part, finding.at));
      if (!p || p[0] < 0 || p[1] < 0 || p[0] > this.size[0] || p[1] > this.size[1]) continue;
      if (taken.some(q => Math.abs(p[0] - q[0]) < apart && Math.abs(p[1] - q[1]) < apart)) continue;
      taken.push(p);
      seen.add(finding);
    }
    return seen;
  }

  // depth that stands for the thickest strand at the pivot
  slack({ near, far }, look) {
    const thick = 2.5 * this.scene.thickM, d = look.camera.distance;
    return look.camera.flat ? thick / (far - near) : thick * near * far / (far - near) / (d * d);
  }

  // the place of the world under a pixel; null on the ground
  pick(x, y) {
    const { gl, solid, size, pickTarget, matrices } = this;
    if (!solid || !matrices) return null;
    const at = [Math.floor(x / size[0] * solid.width), Math.floor((1 - y / size[1]) * solid.height)];
    this.bind(solid.depth, solid.colour);
    gl.bindFramebuffer(gl.FRAMEBUFFER, pickTarget.frame);
    gl.viewport(0, 0, 1, 1);
    gl.disable(gl.DEPTH_TEST); gl.disable(gl.BLEND);
    use(gl, this.programs.pick, { depth: 0, at });
    gl.bindVertexArray(this.empty);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const b = new Uint8Array(4);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, b);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const depth = b[0] / 255 + b[1] / 65025 + b[2] / 16581375 + b[3] / 4228250625;
    return depth > 0.999999 ? null : this.unproject(x / size[0] * 2 - 1, 1 - y / size[1] * 2, depth);
  }

  unproject(x, y, depth) {
    const { near, far, eye, forward, right, up, half } = this.matrices, aspect = this.size[0] / this.size[1];
    const flat = this.shared.flat;
    const z = flat ? near + depth * (far - near) : near * far / (far - depth * (far - near));
    const wide = half * (flat ? this.distance : z);
    return add(add(add(eye, forward, z), right, x * wide * aspect), up, y * wide);
  }

  // pixel of a place of the world, from the upper left; null behind the eye
  project(p) {
    const m = this.matrices.viewProject, at = k => m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
    const w = at(3);
    return w > 0 ? [(at(0) / w + 1) / 2 * this.size[0], (1 - at(1) / w) / 2 * this.size[1]] : null;
  }
}


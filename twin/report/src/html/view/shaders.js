// ---- shaders.js: programs of the graphics card (GLSL ES 3.00) ----

// Light as in the still pictures: a key light from the upper left of the eye, sky, a lamp at the eye.
const LIT = `
uniform vec3 u_sun, u_forward;
vec3 linear(vec3 c) { return pow(c, vec3(2.2)); }
vec3 lit(vec3 base, vec3 n, float shine) {
  float key = max(dot(n, u_sun), 0.0);
  float sky = 0.40 + 0.16 * n.z;
  float lamp = 0.14 * max(-dot(n, u_forward), 0.0);
  vec3 h = normalize(u_sun - u_forward);
  vec3 c = linear(base) * (0.62 * key + sky + lamp) + shine * key * pow(max(dot(n, h), 0.0), 24.0);
  return pow(min(c, vec3(1.0)), vec3(1.0 / 2.2));
}`;

// viridis: polynomial of degree 6 by M. Zucker (CC0), as in the still pictures
const RAMP = [
  [0.2777273272, 0.0054073445, 0.3340998053], [0.1050930431, 1.4046135299, 1.3845901626],
  [-0.3308618287, 0.2148475595, 0.0950951630], [-4.6342304990, -5.7991009734, -19.3324409563],
  [6.2282699363, 14.1799333668, 56.6905526007], [4.7763849977, -13.7451453777, -65.3530326334],
  [-5.4354558559, 4.6458526122, 26.3124352496],
];
const COLOURS = { above: 0xD7263D, below: 0x9AA5B1, plain: 0xB9B2A6, highlight: 0xE8590C, faded: 0xD5D8DC };
const KIND_COLOURS = {
  arm: [0xE98A3A, 'arm'], tool: [0x3E4852, 'tool'], nozzle: [0xC79A3B, 'nozzle'], bed: [0xB8C2CC, 'bed'],
  obstacle: [0x8FA9C4, 'obstacle'], form: [0xD8CDB8, 'form'], other: [0xA7AFB8, 'other arm'],
};
const MARK_COLOURS = { note: 0x2563EB, warning: 0xD97706, error: 0xC81E1E };
const rgb = hex => [16, 8, 0].map(shift => (hex >> shift & 255) / 255);
const glsl = c => `vec3(${c.map(x => x.toFixed(10)).join(',')})`;
const ramp = t => RAMP[0].map((_, i) => clamp(RAMP.reduceRight((sum, c) => sum * t + c[i], 0), 0, 1));

// Segments lie in textures of this width: one end and the radius, the other end and when it begins, colour and when it
// ends. One strip of 16 corners after the other is quicker than instances of so few, by far where no card helps.
const WIDE = 1024;

// A capsule as the back of a box about it; each pixel sends its ray. In the axes of what it rides on.
const CAPSULE_VERTEX = `#version 300 es
precision highp float;
uniform mat4 u_model, u_view_project;
uniform vec4 u_eye; // the eye and 1, or the way of parallel rays and 0
uniform highp sampler2D u_from, u_to, u_more;
uniform float u_time, u_pixel;
flat out vec3 v_from, v_to;
flat out float v_radius, v_value;
out vec3 v_at;
void main() {
  int segment = gl_VertexID >> 4, corner = clamp((gl_VertexID & 15) - 1, 0, 13);
  ivec2 place = ivec2(segment % ${WIDE}, segment / ${WIDE});
  vec4 from = texelFetch(u_from, place, 0), to = texelFetch(u_to, place, 0), more = texelFetch(u_more, place, 0);
  float span = more.y - to.w;
  float share = span > 0.0 ? clamp((u_time - to.w) / span, 0.0, 1.0) : step(to.w, u_time);
  if (share <= 0.0) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  vec3 a = from.xyz, b = mix(a, to.xyz, share);
  float away = u_eye.w > 0.5 ? distance(u_eye.xyz, 0.5 * (a + b)) : 1.0;
  float r = max(from.w, u_pixel * away);
  float length = distance(a, b);
  vec3 d = length > 1e-9 ? (b - a) / length : vec3(0.0, 0.0, 1.0);
  vec3 u = normalize(cross(d, abs(d.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
  vec3 v = cross(d, u);
  int bit = 1 << corner; // a box as a strip of 14 corners, the first and the last twice
  float x = (0x287a & bit) != 0 ? r : -r, y = (0x02af & bit) != 0 ? r : -r;
  float z = (0x31e3 & bit) != 0 ? length + r : -r;
  v_from = a; v_to = b; v_radius = r; v_value = more.x;
  v_at = a + u * x + v * y + d * z;
  gl_Position = u_view_project * u_model * vec4(v_at, 1.0);
}`;

const CAPSULE_FRAGMENT = `#version 300 es
precision highp float;
uniform mat4 u_model, u_view_project;
uniform vec4 u_eye;
uniform vec3 u_plain;
uniform float u_shine, u_faded;
flat in vec3 v_from, v_to;
flat in float v_radius, v_value;
in vec3 v_at;
out vec4 o_colour;
${LIT}
vec3 colour_of(float t) {
  if (t < -5.0) return u_plain;
  if (t < 0.0) return ${glsl(rgb(COLOURS.below))};
  if (t > 1.0) return ${glsl(rgb(COLOURS.above))};
  return clamp(${RAMP.reduceRight((sum, c) => sum ? `(${sum}) * t + ${glsl(c)}` : glsl(c), '')}, 0.0, 1.0);
}
void main() {
  vec3 rd = u_eye.w > 0.5 ? normalize(v_at - u_eye.xyz) : u_eye.xyz;
  vec3 axis = v_to - v_from;
  float l2 = dot(axis, axis), r = v_radius;
  // from near the capsule, so that a far eye costs no digits
  vec3 ro = v_at - rd * (sqrt(l2) + 4.0 * r);
  vec3 oa = ro - v_from;
  float along = dot(axis, rd), along_a = dot(axis, oa);
  float k2 = l2 - along * along, t = -1.0;
  float h = -1.0;
  if (k2 > 1e-6 * l2) {
    float k1 = l2 * dot(rd, oa) - along_a * along, k0 = l2 * dot(oa, oa) - along_a * along_a - r * r * l2;
    h = k1 * k1 - k2 * k0;
    if (h < 0.0) discard;
    t = (-k1 - sqrt(h)) / k2;
    float y = along_a + t * along;
    if (y <= 0.0 || y >= l2) h = -1.0;
  }
  if (h < 0.0) {
    vec3 oc = (along_a + t * along <= 0.0 && k2 > 1e-6 * l2) || (k2 <= 1e-6 * l2 && along > 0.0) ? oa : ro - v_to;
    float half_b = dot(rd, oc), disc = half_b * half_b - dot(oc, oc) + r * r;
    if (disc < 0.0) discard;
    t = -half_b - sqrt(disc);
  }
  vec3 hit = ro + rd * t;
  if (u_eye.w > 0.5 && dot(hit - u_eye.xyz, rd) < 0.0) discard;
  float foot = l2 > 0.0 ? clamp(dot(hit - v_from, axis) / l2, 0.0, 1.0) : 0.0;
  vec3 n = mat3(u_model) * normalize(hit - v_from - axis * foot);
  vec4 clip = u_view_project * u_model * vec4(hit, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
  bool picked = v_value > 50.0;
  vec3 base = colour_of(picked ? v_value - 100.0 : v_value);
  // what is not pointed at steps back
  if (!picked && u_faded > 0.5) base = mix(base, ${glsl(rgb(COLOURS.faded))}, 0.6);
  o_colour = vec4(lit(base, n, u_shine), 1.0);
}`;

const MESH_VERTEX = `#version 300 es
precision highp float;
uniform mat4 u_model, u_view_project;
in vec3 a_at, a_normal;
out vec3 v_normal, v_at;
out float v_up;
void main() {
  v_at = a_at;
  v_up = a_normal.z;
  v_normal = mat3(u_model) * a_normal;
  gl_Position = u_view_project * u_model * vec4(a_at, 1.0);
}`;

// Solid, or as if of glass: then what is behind the solid things is left out here.
const meshFragment = isGlass => `#version 300 es
precision highp float;
uniform vec3 u_plain;
${isGlass ? 'uniform sampler2D u_depth; uniform float u_fine;' : ''}
uniform float u_grid; // m, 0 for none
in vec3 v_normal, v_at;
in float v_up;
out vec4 o_colour;
${LIT}
void main() {
  ${isGlass ? 'if (texelFetch(u_depth, ivec2(gl_FragCoord.xy * u_fine), 0).r < gl_FragCoord.z) discard;' : ''}
  vec3 n = normalize(v_normal);
  if (dot(n, u_forward) > 0.3) n = -n;
  float rim = 1.0 - abs(dot(n, u_forward));
  vec3 base = u_plain;
  if (u_grid > 0.0 && v_up > 0.5) { // lines of one pixel; they fade where they would lie closer than four
    vec2 line = v_at.xy / u_grid, wide = fwidth(line), near = abs(fract(line - 0.5) - 0.5) / wide;
    vec2 ink = (1.0 - clamp(near, 0.0, 1.0)) * (1.0 - smoothstep(0.1, 0.25, wide));
    base *= 1.0 - 0.28 * max(ink.x, ink.y);
  }
  o_colour = vec4(lit(base, n, 0.10), ${isGlass ? '0.2 + 0.4 * rim * rim * rim' : '1.0'});
}`;

const WHOLE_VERTEX = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;

// Eye-dome lighting (Boucheny 2009): darker the more the neighbours stand in front, over the finer picture's pixels.
const DOME_FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D u_colour, u_depth;
uniform vec3 u_top, u_bottom;
uniform vec2 u_range; // near and far
uniform float u_flat, u_ring, u_height;
uniform int u_samples;
out vec4 o_colour;
float away(ivec2 at) {
  float d = texelFetch(u_depth, clamp(at, ivec2(0), textureSize(u_depth, 0) - 1), 0).r;
  float n = u_range.x, f = u_range.y;
  return u_flat > 0.5 ? n + d * (f - n) : n * f / (f - d * (f - n));
}
void main() {
  vec3 sum = vec3(0.0);
  vec3 ground = mix(u_bottom, u_top, gl_FragCoord.y / u_height);
  for (int j = 0; j < u_samples; j++) for (int i = 0; i < u_samples; i++) {
    ivec2 at = ivec2(gl_FragCoord.xy) * u_samples + ivec2(i, j);
    if (texelFetch(u_depth, at, 0).r >= 1.0) { sum += ground; continue; }
    float here = away(at), shade = 0.0;
    for (int k = 0; k < 8; k++) {
      float angle = 0.7853982 * float(k);
      vec2 step = vec2(cos(angle), sin(angle)) * u_ring * (k % 2 == 0 ? 1.0 : 1.8);
      float there = away(at + ivec2(round(step)));
      shade += clamp((here - there) / here * 60.0, 0.0, 1.0);
    }
    sum += texelFetch(u_colour, at, 0).rgb * exp(-0.16 * shade);
  }
  o_colour = vec4(sum / float(u_samples * u_samples), 1.0);
}`;

// A strand still to come: a thin clear line that hides nothing and is hidden by what is solid.
const LINE_VERTEX = `#version 300 es
precision highp float;
uniform mat4 u_model, u_view_project;
uniform vec2 u_size; // px
uniform highp sampler2D u_from, u_to; // ends; when it ends, when it begins
uniform float u_time, u_wide;
void main() {
  int segment = gl_VertexID / 6, corner = clamp(gl_VertexID % 6 - 1, 0, 3);
  ivec2 place = ivec2(segment % ${WIDE}, segment / ${WIDE});
  vec4 from = texelFetch(u_from, place, 0), to = texelFetch(u_to, place, 0);
  float span = from.w - to.w;
  float share = span > 0.0 ? clamp((u_time - to.w) / span, 0.0, 1.0) : step(to.w, u_time);
  vec4 a = u_view_project * u_model * vec4(mix(from.xyz, to.xyz, share), 1.0);
  vec4 b = u_view_project * u_model * vec4(to.xyz, 1.0);
  if (share >= 1.0 || a.w <= 0.0 || b.w <= 0.0) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  vec2 way = (b.xy / b.w - a.xy / a.w) * u_size;
  way = dot(way, way) > 1e-12 ? normalize(way) : vec2(1.0, 0.0);
  vec4 p = corner < 2 ? a : b;
  float side = corner % 2 == 0 ? 1.0 : -1.0;
  gl_Position = p + vec4(vec2(-way.y, way.x) * side * u_wide / u_size * p.w, 0.0, 0.0);
}`;
const LINE_FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D u_depth;
uniform vec4 u_ink;
uniform float u_fine;
out vec4 o_colour;
void main() {
  if (texelFetch(u_depth, ivec2(gl_FragCoord.xy * u_fine), 0).r < gl_FragCoord.z) discard;
  o_colour = u_ink;
}`;

// A finding: a square for an error, a triangle for a warning; faint where something stands before it.
const MARK_VERTEX = `#version 300 es
precision highp float;
uniform mat4 u_model, u_view_project;
uniform sampler2D u_depth;
uniform vec2 u_size;
uniform float u_radius, u_near;
in vec3 a_at;
in float a_kind; // 0 note, 1 warning, 2 error; 10 more: the chosen one; below 0: not shown
out vec2 v_at;
flat out float v_kind, v_clear;
void main() {
  vec4 p = u_view_project * u_model * vec4(a_at, 1.0);
  bool chosen = a_kind > 5.0;
  vec3 at = p.xyz / p.w * 0.5 + 0.5;
  ivec2 size = textureSize(u_depth, 0);
  float there = texelFetch(u_depth, clamp(ivec2(at.xy * vec2(size)), ivec2(0), size - 1), 0).r;
  // a place in a strand is not hidden by the strand's own skin
  v_clear = chosen || at.z <= there + u_near ? 1.0 : 0.3;
  v_kind = a_kind;
  v_at = vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0) * (chosen ? 2.6 : 1.25);
  gl_Position = p.w > 0.0 && a_kind >= 0.0 ? vec4((p.xy / p.w + v_at * u_radius / u_size * 2.0), 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}`;
const MARK_FRAGMENT = `#version 300 es
precision highp float;
uniform vec3 u_ring;
uniform float u_radius;
in vec2 v_at;
flat in float v_kind, v_clear;
out vec4 o_colour;
void main() {
  float kind = mod(v_kind, 10.0), soft = 1.0 / u_radius;
  vec2 q = v_at;
  float box = max(abs(q.x), abs(q.y)) - 0.78;
  float triangle = max(abs(q.x) * 0.866 + q.y * 0.5 - 0.5, -q.y - 0.62) ;
  float shape = kind > 1.5 ? box : kind > 0.5 ? triangle : length(q) - 0.8;
  vec3 c = kind > 1.5 ? ${glsl(rgb(MARK_COLOURS.error))} : kind > 0.5 ? ${glsl(rgb(MARK_COLOURS.warning))} : ${glsl(rgb(MARK_COLOURS.note))};
  float skin = 1.0 - smoothstep(0.2 - soft, 0.2 + soft, shape);
  float body = 1.0 - smoothstep(-soft, soft, shape);
  float ring = v_kind > 5.0 ? 1.0 - smoothstep(0.16, 0.16 + soft * 1.5, abs(length(q) - 2.1)) : 0.0;
  vec4 mark = vec4(mix(vec3(1.0), c, body), skin * v_clear);
  o_colour = mix(mark, vec4(u_ring, 1.0), ring);
  if (o_colour.a < 0.01) discard;
}`;

// The depth of one pixel as four bytes, for picking.
const PICK_FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D u_depth;
uniform ivec2 u_at;
out vec4 o_colour;
void main() {
  float d = min(texelFetch(u_depth, u_at, 0).r, 0.99999994);
  vec4 f = fract(d * vec4(1.0, 255.0, 65025.0, 16581375.0));
  o_colour = f - f.yzww * vec4(1.0 / 255.0, 1.0 / 255.0, 1.0 / 255.0, 0.0);
}`;


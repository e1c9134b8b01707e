// Coordinates are those of the view, computed in f64 by the caller: right, up, depth in metres.

struct View {
    scale: vec4<f32>,  // m to clip along x, y; depth to 0..1; nearest depth
    offset: vec4<f32>, // clip coordinates of the view's centre
}
@group(0) @binding(0) var<uniform> view: View;

struct Seen {
    // number of the thing, then bits of normal x, normal y, depth
    @location(0) what: vec4<u32>,
}

fn seen(id: u32, normal: vec3<f32>, depth: f32) -> vec4<u32> {
    var n = normalize(normal);
    if n.z > 0.0 { n = -n; }
    return vec4<u32>(id, bitcast<u32>(n.x), bitcast<u32>(n.y), bitcast<u32>(depth));
}

fn unit_depth(depth: f32) -> f32 { return (depth - view.scale.w) * view.scale.z; }

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) normal: vec3<f32>,
    @location(1) depth: f32,
    @location(2) @interpolate(flat) id: u32,
}

@vertex
fn triangle_corner(
    @location(0) at: vec3<f32>, @location(1) normal: vec3<f32>, @location(2) id: u32
) -> Corner {
    var out: Corner;
    out.clip = vec4<f32>(at.xy * view.scale.xy + view.offset.xy, unit_depth(at.z), 1.0);
    out.normal = normal;
    out.depth = at.z;
    out.id = id;
    return out;
}

@fragment
fn triangle_sample(in: Corner) -> Seen {
    return Seen(seen(in.id, in.normal, in.depth));
}

// A capsule is a rectangle that covers it; each sample meets the exact surface.
struct Cover {
    @builtin(position) clip: vec4<f32>,
    @location(0) at: vec2<f32>,
    @location(1) @interpolate(flat) a: vec3<f32>,
    @location(2) @interpolate(flat) b: vec3<f32>,
    @location(3) @interpolate(flat) radius: f32,
    @location(4) @interpolate(flat) id: u32,
}

@vertex
fn capsule_corner(
    @builtin(vertex_index) i: u32,
    @location(0) a: vec3<f32>, @location(1) b: vec3<f32>, @location(2) radius: f32, @location(3) id: u32
) -> Cover {
    let axis = b.xy - a.xy;
    let len = length(axis);
    var along = vec2<f32>(1.0, 0.0);
    if len > 1e-9 { along = axis / len; }
    let across = vec2<f32>(-along.y, along.x);
    let r = radius * 1.001;
    let s = f32(i & 1u) * 2.0 - 1.0;
    let t = f32(i >> 1u) * 2.0 - 1.0;
    var out: Cover;
    out.at = 0.5 * (a.xy + b.xy) + along * s * (0.5 * len + r) + across * t * r;
    out.clip = vec4<f32>(out.at * view.scale.xy + view.offset.xy, 0.5, 1.0);
    out.a = a;
    out.b = b;
    out.radius = radius;
    out.id = id;
    return out;
}

struct SeenAt {
    @location(0) what: vec4<u32>,
    @builtin(frag_depth) depth: f32,
}

// Depth at which a ray along +z from o enters the ball about c; past any number where it does not.
fn ball(o: vec3<f32>, c: vec3<f32>, r: f32) -> f32 {
    let f = o - c;
    let disc = r * r - dot(f.xy, f.xy);
    if disc < 0.0 { return 1e30; }
    return -f.z - sqrt(disc);
}

@fragment
fn capsule_sample(in: Cover) -> SeenAt {
    // from the depth of a, so that a thin capsule far from the view's plane loses no digits
    let o = vec3<f32>(in.at, in.a.z);
    let axis = in.b - in.a;
    let from_a = o - in.a;
    let len2 = dot(axis, axis);
    let along_a = dot(axis, from_a);
    let k2 = dot(axis.xy, axis.xy);
    var t = 1e30;
    if k2 > 1e-9 * len2 {
        let cross2 = axis.x * from_a.y - axis.y * from_a.x;
        let disc = k2 * in.radius * in.radius - cross2 * cross2;
        if disc >= 0.0 {
            // root of |o + t z - axis|² = r², with the differences of squares written out
            t = (along_a * axis.z - sqrt(len2 * disc)) / k2;
            let y = along_a + t * axis.z;
            if y <= 0.0 { t = ball(o, in.a, in.radius); }
            else if y >= len2 { t = ball(o, in.b, in.radius); }
        }
    } else if axis.z > 0.0 {
        t = ball(o, in.a, in.radius);
    } else {
        t = ball(o, in.b, in.radius);
    }
    if t > 1e29 { discard; }
    let at = o + vec3<f32>(0.0, 0.0, t);
    var foot = 0.0;
    if len2 > 0.0 { foot = clamp(dot(at - in.a, axis) / len2, 0.0, 1.0); }
    let depth = at.z;
    return SeenAt(seen(in.id, at - in.a - axis * foot, depth), unit_depth(depth));
}

//! glTF's own book-keeping: buffers, views, accessors, meshes, nodes, and the two chunks of a binary file.

use crate::mesh::Mesh;
use crate::paint;
use serde_json::{Value, json};
use sim::scene::BodyKind;

const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// What colours a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Paint {
    /// Its vertices.
    Vertices,
    /// The kind of body it is.
    Kind(BodyKind),
}

/// A file in the making: one array for each attribute, filled mesh by mesh.
#[derive(Debug, Default)]
pub(super) struct Pack {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    colours: Vec<[u16; 4]>,
    indices: Vec<u32>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<(Paint, Value)>,
    nodes: Vec<Value>,
}

/// Where a mesh begins.
#[derive(Debug, Clone, Copy)]
pub(super) struct Skin {
    vertex: usize,
    colour: usize,
    index: usize,
}

/// Views of the buffer, in this order.
const POSITIONS: usize = 0;
const NORMALS: usize = 1;
const INDICES: usize = 2;
const COLOURS: usize = 3;

impl Pack {
    pub(super) fn vertices(&self) -> usize {
        self.positions.len()
    }

    /// Begins a mesh.
    pub(super) fn begin(&self) -> Skin {
        Skin { vertex: self.vertices(), colour: self.colours.len(), index: self.indices.len() }
    }

    /// Adds triangles to the mesh begun last, with a linear colour for each vertex or for none.
    pub(super) fn add(&mut self, mesh: &Mesh, colour: impl Fn(usize) -> Option<[f64; 3]>) {
        let first = self.vertices() as u32;
        for vertex in 0..mesh.points.len() {
            self.positions.push(mesh.points[vertex].coords.map(|x| x as f32).into());
            self.normals.push(mesh.normals[vertex].map(|x| x as f32).into());
            if let Some(rgb) = colour(vertex) {
                let [r, g, b] = rgb.map(|share| (share.clamp(0.0, 1.0) * 65535.0).round() as u16);
                self.colours.push([r, g, b, u16::MAX]);
            }
        }
        self.indices.extend(mesh.triangles.iter().flatten().map(|vertex| vertex + first));
    }

    /// Ends a mesh; `None` where nothing was added. Vertices count from its own first.
    pub(super) fn mesh(&mut self, from: Skin, name: &str, paint: Paint) -> Option<usize> {
        if self.indices.len() == from.index {
            return None;
        }
        let base = from.vertex as u32;
        self.indices[from.index..].iter_mut().for_each(|vertex| *vertex -= base);
        let n = self.vertices() - from.vertex;
        let (min, max) = bounds(&self.positions[from.vertex..]);
        let mut attributes = json!({
            "POSITION": self.accessor(json!({
                "bufferView": POSITIONS, "byteOffset": from.vertex * 12, "componentType": FLOAT,
                "type": "VEC3", "count": n, "min": min, "max": max,
            })),
            "NORMAL": self.accessor(json!({
                "bufferView": NORMALS, "byteOffset": from.vertex * 12, "componentType": FLOAT,
                "type": "VEC3", "count": n,
            })),
        });
        if paint == Paint::Vertices {
            attributes["COLOR_0"] = json!(self.accessor(json!({
                "bufferView": COLOURS, "byteOffset": from.colour * 8, "componentType": UNSIGNED_SHORT,
                "normalized": true, "type": "VEC4", "count": n,
            })));
        }
        let count = self.indices.len() - from.index;
        let indices = self.accessor(json!({
            "bufferView": INDICES, "byteOffset": from.index * 4, "componentType": UNSIGNED_INT,
            "type": "SCALAR", "count": count, "min": [0], "max": [n - 1],
        }));
        let primitive = json!({ "attributes": attributes, "indices": indices, "material": self.material(paint) });
        self.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        Some(self.meshes.len() - 1)
    }

    pub(super) fn node(&mut self, node: Value) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn material(&mut self, paint: Paint) -> usize {
        if let Some(known) = self.materials.iter().position(|(of, _)| *of == paint) {
            return known;
        }
        let (name, rgb, metallic, roughness) = match paint {
            Paint::Vertices => ("strands".to_owned(), [1.0; 3], 0.0, 0.55),
            Paint::Kind(kind) => {
                let metallic = if kind == BodyKind::Nozzle { 0.6 } else { 0.0 };
                (format!("{kind:?}"), paint::kind(kind).map(paint::linear), metallic, 0.7)
            }
        };
        let [r, g, b] = rgb;
        let material = json!({
            "name": name,
            // forms and links come from files whose triangles may face either way
            "doubleSided": paint != Paint::Vertices,
            "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness,
            },
        });
        self.materials.push((paint, material));
        self.materials.len() - 1
    }

    /// The file.
    pub(super) fn finish(self, root: usize, extras: Value) -> Vec<u8> {
        let colours =
            self.colours.iter().flatten().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
        let views: [(Vec<u8>, usize, u32); 4] = [
            (floats(&self.positions), 12, ARRAY_BUFFER),
            (floats(&self.normals), 12, ARRAY_BUFFER),
            (self.indices.iter().flat_map(|x| x.to_le_bytes()).collect(), 0, ELEMENT_ARRAY_BUFFER),
            (colours, 8, ARRAY_BUFFER),
        ];
        let mut binary: Vec<u8> = Vec::new();
        let mut told = Vec::new();
        for (bytes, stride, target) in views.iter().filter(|(bytes, ..)| !bytes.is_empty()) {
            let mut view = json!({
                "buffer": 0, "byteOffset": binary.len(), "byteLength": bytes.len(), "target": target,
            });
            if *stride > 0 {
                view["byteStride"] = json!(stride);
            }
            told.push(view);
            binary.extend_from_slice(bytes);
        }
        let mut gltf = json!({
            "asset": { "version": "2.0", "generator": "twin" },
            "scene": 0,
            "scenes": [{ "nodes": [root], "extras": extras }],
            "nodes": self.nodes,
        });
        // an empty list is not allowed
        if !self.meshes.is_empty() {
            gltf["meshes"] = json!(self.meshes);
            gltf["accessors"] = json!(self.accessors);
            gltf["bufferViews"] = json!(told);
            gltf["buffers"] = json!([{ "byteLength": binary.len() }]);
            let materials: Vec<Value> = self.materials.into_iter().map(|(_, told)| told).collect();
            gltf["materials"] = json!(materials);
        }
        chunks(gltf.to_string().into_bytes(), binary)
    }
}

/// Header and chunks, each a multiple of four bytes long.
fn chunks(mut text: Vec<u8>, mut binary: Vec<u8>) -> Vec<u8> {
    text.resize(text.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let mut out = Vec::with_capacity(28 + text.len() + binary.len());
    out.extend_from_slice(b"glTF");
    out.extend_from_slice(&2u32.to_le_bytes());
    let chunk = |bytes: &[u8]| if bytes.is_empty() { 0 } else { 8 + bytes.len() };
    out.extend_from_slice(&((12 + chunk(&text) + chunk(&binary)) as u32).to_le_bytes());
    for (bytes, kind) in [(text, b"JSON"), (binary, b"BIN\0")] {
        if !bytes.is_empty() {
            out.extend_from_slice(&(bytes.len() as u32).to_le_bytes());
            out.extend_from_slice(kind);
            out.extend_from_slice(&bytes);
        }
    }
    out
}

fn floats(vectors: &[[f32; 3]]) -> Vec<u8> {
    vectors.iter().flatten().flat_map(|x| x.to_le_bytes()).collect()
}

fn bounds(positions: &[[f32; 3]]) -> ([f32; 3], [f32; 3]) {
    let all = |pick: fn(f32, f32) -> f32, from: f32| -> [f32; 3] {
        std::array::from_fn(|k| positions.iter().fold(from, |most, p| pick(most, p[k])))
    };
    (all(f32::min, f32::INFINITY), all(f32::max, f32::NEG_INFINITY))
}

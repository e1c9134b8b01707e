//! Pipelines, one render pass, and reading its samples back.

use super::Gpu;
use crate::RenderError;
use crate::layer::{Sample, code};
use crate::view::Projection;
use sim::pose::Vector;
use sim::scene::solid::Solids;
use std::sync::mpsc;
use std::time::Duration;
use wgpu::{BufferUsages, TextureFormat, TextureUsages, VertexFormat, VertexStepMode};

/// Number of the thing, normal x and y, depth: [`Sample`] as four words.
const SAMPLES: TextureFormat = TextureFormat::Rgba32Uint;
const DEPTH: TextureFormat = TextureFormat::Depth32Float;
const SAMPLE_BYTES: u32 = 16;
/// Samples are read back in bands of about this size.
const BAND_BYTES: u32 = 32 << 20;
/// Software drivers on a busy machine are slow; a card that takes this long hangs.
const PATIENCE: Duration = Duration::from_secs(120);

/// The pipelines of triangles and of capsules.
pub(super) fn pipelines(device: &wgpu::Device) -> (wgpu::RenderPipeline, wgpu::RenderPipeline) {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("layer"),
        source: wgpu::ShaderSource::Wgsl(include_str!("../layer.wgsl").into()),
    });
    let view = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("view"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(&view)],
        immediate_size: 0,
    });
    let pipeline = |name: &str, formats: &[VertexFormat], step_mode, topology| {
        let mut array_stride = 0;
        let mut attributes = Vec::new();
        for (i, &format) in formats.iter().enumerate() {
            let shader_location = i as u32;
            attributes.push(wgpu::VertexAttribute {
                format,
                offset: array_stride,
                shader_location,
            });
            array_stride += format.size();
        }
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(name),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(&format!("{name}_corner")),
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride,
                    step_mode,
                    attributes: &attributes,
                })],
            },
            primitive: wgpu::PrimitiveState { topology, ..Default::default() },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(&format!("{name}_sample")),
                compilation_options: Default::default(),
                targets: &[Some(SAMPLES.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    };
    use VertexFormat::{Float32, Float32x3, Uint32};
    let corners = [Float32x3, Float32x3, Uint32];
    let covers = [Float32x3, Float32x3, Float32, Uint32];
    let list = wgpu::PrimitiveTopology::TriangleList;
    let strip = wgpu::PrimitiveTopology::TriangleStrip;
    (
        pipeline("triangle", &corners, VertexStepMode::Vertex, list),
        pipeline("capsule", &covers, VertexStepMode::Instance, strip),
    )
}

impl Gpu {
    /// Rasterises the primitives; all of them lie between the two depths.
    pub(crate) fn capture(
        &self,
        solids: &Solids,
        view: &Projection,
        near_m: f64,
        far_m: f64,
    ) -> Result<Vec<Sample>, RenderError> {
        let (width, height) = view.size_px;
        let texture = |format, usage| {
            self.device.create_texture(&wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let samples = texture(SAMPLES, TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC);
        let depth = texture(DEPTH, TextureUsages::RENDER_ATTACHMENT);
        let pass = self.pass(solids, view, (near_m, far_m), &samples, &depth);
        self.queue.submit([pass]);
        self.well()?;
        self.read(&samples, width, height)
    }

    fn pass(
        &self,
        solids: &Solids,
        view: &Projection,
        (near_m, far_m): (f64, f64),
        samples: &wgpu::Texture,
        depth: &wgpu::Texture,
    ) -> wgpu::CommandBuffer {
        let uniform = view_words(view, near_m, far_m);
        let uniform = self.buffer(&uniform, BufferUsages::UNIFORM);
        let view_group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.triangles.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
        });
        let corners = self.buffer(&corner_words(solids, view), BufferUsages::VERTEX);
        let covers = self.buffer(&capsule_words(solids, view), BufferUsages::VERTEX);
        let (samples, depth) =
            (samples.create_view(&Default::default()), depth.create_view(&Default::default()));
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("layer"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &samples,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_bind_group(0, &view_group, &[]);
        pass.set_pipeline(&self.triangles);
        pass.set_vertex_buffer(0, corners.slice(..));
        pass.draw(0..3 * solids.triangles.len() as u32, 0..1);
        pass.set_pipeline(&self.capsules);
        pass.set_vertex_buffer(0, covers.slice(..));
        pass.draw(0..4, 0..solids.capsules.len() as u32);
        drop(pass);
        encoder.finish()
    }

    /// A buffer of these words; a few bytes where there are none, since empty ones cannot be bound.
    fn buffer(&self, words: &[u32], usage: BufferUsages) -> wgpu::Buffer {
        let bytes: Vec<u8> = words.iter().flat_map(|w| w.to_ne_bytes()).collect();
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: (bytes.len() as u64).max(16),
            usage: usage | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, &bytes);
        buffer
    }

    fn read(
        &self,
        from: &wgpu::Texture,
        width: u32,
        height: u32,
    ) -> Result<Vec<Sample>, RenderError> {
        let row = (width * SAMPLE_BYTES).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let band = (BAND_BYTES / row).clamp(1, height);
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row) * u64::from(band),
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut samples = Vec::with_capacity(width as usize * height as usize);
        for top in (0..height).step_by(band as usize) {
            let rows = band.min(height - top);
            let mut encoder = self.device.create_command_encoder(&Default::default());
            let mut source = from.as_image_copy();
            source.origin.y = top;
            let layout = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(row),
                rows_per_image: None,
            };
            encoder.copy_texture_to_buffer(
                source,
                wgpu::TexelCopyBufferInfo { buffer: &staging, layout },
                wgpu::Extent3d { width, height: rows, depth_or_array_layers: 1 },
            );
            self.queue.submit([encoder.finish()]);
            self.read_band(&staging, row, width, rows, &mut samples)?;
        }
        Ok(samples)
    }

    fn read_band(
        &self,
        staging: &wgpu::Buffer,
        row: u32,
        width: u32,
        rows: u32,
        into: &mut Vec<Sample>,
    ) -> Result<(), RenderError> {
        let bad = |e: &dyn std::fmt::Display| RenderError::Gpu(e.to_string());
        let (done, wait) = mpsc::channel();
        staging.map_async(wgpu::MapMode::Read, .., move |result| {
            // the receiver only goes away after an error that is already on its way up
            let _ = done.send(result);
        });
        let poll = wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) };
        self.device.poll(poll).map_err(|e| bad(&e))?;
        self.well()?;
        wait.recv_timeout(PATIENCE).map_err(|e| bad(&e))?.map_err(|e| bad(&e))?;
        let bytes = staging.get_mapped_range(..).map_err(|e| bad(&e))?;
        for line in bytes.chunks_exact(row as usize).take(rows as usize) {
            into.extend(line.chunks_exact(SAMPLE_BYTES as usize).take(width as usize).map(sample));
        }
        drop(bytes);
        staging.unmap();
        Ok(())
    }
}

fn sample(bytes: &[u8]) -> Sample {
    let word = |i: usize| u32::from_ne_bytes(std::array::from_fn(|k| bytes[4 * i + k]));
    match word(0) {
        0 => Sample::EMPTY,
        id => Sample {
            id,
            normal: [f32::from_bits(word(1)), f32::from_bits(word(2))],
            depth_m: f32::from_bits(word(3)),
        },
    }
}

/// The shader's `View`.
fn view_words(view: &Projection, near_m: f64, far_m: f64) -> [u32; 8] {
    let (width, height) = (f64::from(view.size_px.0), f64::from(view.size_px.1));
    let [x, y] = view.centre_px;
    [
        2.0 * view.px_per_m / width,
        2.0 * view.px_per_m / height,
        1.0 / (far_m - near_m),
        near_m,
        2.0 * x / width - 1.0,
        1.0 - 2.0 * y / height,
        0.0,
        0.0,
    ]
    .map(|v| (v as f32).to_bits())
}

fn bits(v: Vector) -> [u32; 3] {
    [v.x, v.y, v.z].map(|x| (x as f32).to_bits())
}

/// Three corners a triangle, each position, normal and number.
fn corner_words(solids: &Solids, view: &Projection) -> Vec<u32> {
    let turned =
        |n: &Vector| Vector::new(n.dot(&view.right), n.dot(&view.up), n.dot(&view.forward));
    let mut words = Vec::with_capacity(solids.triangles.len() * 21);
    for t in &solids.triangles {
        for (p, n) in t.points.iter().zip(&t.normals) {
            words.extend(bits(view.in_view(*p)));
            words.extend(bits(turned(n)));
            words.push(code(t.id));
        }
    }
    words
}

/// Both ends, radius and number of every capsule.
fn capsule_words(solids: &Solids, view: &Projection) -> Vec<u32> {
    let mut words = Vec::with_capacity(solids.capsules.len() * 8);
    for c in &solids.capsules {
        words.extend(bits(view.in_view(c.a)));
        words.extend(bits(view.in_view(c.b)));
        words.push((c.radius_m as f32).to_bits());
        words.push(code(c.id));
    }
    words
}

//! Draws the 3D view into its own color and depth target, and copies that into the window.
//!
//! egui's own pass has no depth buffer, neither in the window nor in tests. A frame that would come
//! out as the last one did is not drawn again: the window repaints for many other reasons.

use super::pipelines::{MSAA, Pipelines};
use super::scene_mesh::SceneMesh;
use crate::present::overlay::{FaceCorner, LeafBoxes, Line};
use eframe::egui_wgpu::{self, CallbackResources, CallbackTrait, ScreenDescriptor, wgpu};
use std::sync::Arc;

/// What the shaders are told; as `Globals` in `shaders.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Globals {
    pub clip_from_scene: [[f32; 4]; 4],
    pub eye: [f32; 4],
    pub forward: [f32; 4],
    pub right: [f32; 4],
    pub up: [f32; 4],
    pub cut: [f32; 4],
    pub size: [f32; 2],
    pub radius: f32,
    /// Of objects, 0 to 1.
    pub opacity: f32,
}

/// One frame of the 3D view.
pub struct Frame3d {
    pub globals: Globals,
    /// In pixels.
    pub size: [u32; 2],
    pub ground: [u8; 3],
    pub mesh: Option<Arc<SceneMesh>>,
    pub boxes: Option<Arc<LeafBoxes>>,
    /// How many of the boxes are drawn.
    pub box_count: u32,
    pub lines: Arc<Vec<Line>>,
    /// Translucent triangles.
    pub faces: Arc<Vec<FaceCorner>>,
}

/// What makes one frame differ from another.
#[derive(PartialEq)]
struct Drawn {
    globals: Globals,
    ground: [u8; 3],
    box_count: u32,
    parts: [usize; 4],
}

/// A buffer and what was uploaded into it. Holding on to the source keeps its address its own.
struct Uploaded<T> {
    source: Option<Arc<T>>,
    buffers: Vec<(wgpu::Buffer, u32)>,
}

impl<T> Default for Uploaded<T> {
    fn default() -> Self {
        Uploaded {
            source: None,
            buffers: Vec::new(),
        }
    }
}

impl<T> Uploaded<T> {
    /// Uploads the arrays of `source` unless they are there already.
    fn update(
        &mut self,
        device: &wgpu::Device,
        source: Option<&Arc<T>>,
        arrays: impl Fn(&T) -> Vec<(&[u8], usize)>,
    ) {
        use wgpu::util::DeviceExt as _;
        let same = match (&self.source, source) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (None, None) => true,
            _ => false,
        };
        if same {
            return;
        }
        self.source = source.cloned();
        self.buffers = source.map_or_else(Vec::new, |source| {
            arrays(source)
                .into_iter()
                .map(|(contents, count)| {
                    let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                        label: Some("view3d"),
                        contents,
                        usage: wgpu::BufferUsages::VERTEX,
                    });
                    (buffer, count as u32)
                })
                .collect()
        });
    }

    fn address(&self) -> usize {
        self.source
            .as_ref()
            .map_or(0, |source| Arc::as_ptr(source) as usize)
    }
}

/// The target that is drawn into.
struct Target {
    size: [u32; 2],
    samples: wgpu::TextureView,
    depth: wgpu::TextureView,
    resolved: wgpu::TextureView,
    blit: wgpu::BindGroup,
}

/// Everything that lives on the graphics card.
struct Gpu {
    pipelines: Pipelines,
    globals: wgpu::Buffer,
    globals_group: wgpu::BindGroup,
    target: Option<Target>,
    mesh: Uploaded<SceneMesh>,
    boxes: Uploaded<LeafBoxes>,
    lines: Uploaded<Vec<Line>>,
    faces: Uploaded<Vec<FaceCorner>>,
    drawn: Option<Drawn>,
}

/// Makes the 3D view's things on the graphics card, once.
pub fn install(state: &egui_wgpu::RenderState) {
    let pipelines = Pipelines::new(&state.device, state.target_format);
    let globals = state.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("view3d globals"),
        size: size_of::<Globals>() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let globals_group = state.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("view3d globals"),
        layout: &pipelines.globals_layout,
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: globals.as_entire_binding(),
        }],
    });
    state.renderer.write().callback_resources.insert(Gpu {
        pipelines,
        globals,
        globals_group,
        target: None,
        mesh: Uploaded::default(),
        boxes: Uploaded::default(),
        lines: Uploaded::default(),
        faces: Uploaded::default(),
        drawn: None,
    });
}

impl Target {
    fn new(device: &wgpu::Device, pipelines: &Pipelines, size: [u32; 2]) -> Self {
        let texture = |format, sample_count, usage| {
            device
                .create_texture(&wgpu::TextureDescriptor {
                    label: Some("view3d target"),
                    size: wgpu::Extent3d {
                        width: size[0],
                        height: size[1],
                        depth_or_array_layers: 1,
                    },
                    mip_level_count: 1,
                    sample_count,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage,
                    view_formats: &[],
                })
                .create_view(&wgpu::TextureViewDescriptor::default())
        };
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let resolved = texture(
            Pipelines::COLOR,
            1,
            attachment | wgpu::TextureUsages::TEXTURE_BINDING,
        );
        Target {
            size,
            samples: texture(Pipelines::COLOR, MSAA, attachment),
            depth: texture(Pipelines::DEPTH, MSAA, attachment),
            blit: pipelines.blit_group(device, &resolved),
            resolved,
        }
    }
}

impl CallbackTrait for Frame3d {
    fn prepare(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        _: &ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        let Some(gpu) = resources.get_mut::<Gpu>() else {
            return Vec::new();
        };
        gpu.mesh.update(device, self.mesh.as_ref(), |mesh| {
            vec![
                (bytemuck::cast_slice(&mesh.vertices), mesh.vertices.len()),
                (bytemuck::cast_slice(&mesh.balls), mesh.balls.len()),
            ]
        });
        gpu.boxes.update(device, self.boxes.as_ref(), |boxes| {
            vec![(
                bytemuck::cast_slice(&boxes.instances),
                boxes.instances.len(),
            )]
        });
        gpu.lines.update(device, Some(&self.lines), |lines| {
            vec![(bytemuck::cast_slice(lines), lines.len())]
        });
        gpu.faces.update(device, Some(&self.faces), |corners| {
            vec![(bytemuck::cast_slice(corners), corners.len())]
        });
        let drawn = Drawn {
            globals: self.globals,
            ground: self.ground,
            box_count: self.box_count,
            parts: [
                gpu.mesh.address(),
                gpu.boxes.address(),
                gpu.lines.address(),
                gpu.faces.address(),
            ],
        };
        let fits = gpu.target.as_ref().is_some_and(|t| t.size == self.size);
        if fits && gpu.drawn.as_ref() == Some(&drawn) {
            return Vec::new();
        }
        if !fits {
            gpu.target = Some(Target::new(device, &gpu.pipelines, self.size));
        }
        queue.write_buffer(&gpu.globals, 0, bytemuck::bytes_of(&self.globals));
        self.draw(gpu, encoder);
        gpu.drawn = Some(drawn);
        Vec::new()
    }

    fn paint(
        &self,
        _: egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        if let Some(gpu) = resources.get::<Gpu>()
            && let Some(target) = &gpu.target
        {
            pass.set_pipeline(&gpu.pipelines.blit);
            pass.set_bind_group(0, &target.blit, &[]);
            pass.draw(0..3, 0..1);
        }
    }
}

impl Frame3d {
    fn draw(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder) {
        let Some(target) = &gpu.target else {
            return;
        };
        let [r, g, b] = self.ground.map(|c| f64::from(c) / 255.0);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("view3d"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target.samples,
                depth_slice: None,
                resolve_target: Some(&target.resolved),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 1.0 }),
                    store: wgpu::StoreOp::Discard,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &target.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, &gpu.globals_group, &[]);
        if let [(vertices, vertex_count), (balls, ball_count)] = &gpu.mesh.buffers[..] {
            if *vertex_count > 0 {
                pass.set_pipeline(&gpu.pipelines.mesh);
                pass.set_vertex_buffer(0, vertices.slice(..));
                pass.draw(0..*vertex_count, 0..1);
            }
            if *ball_count > 0 {
                pass.set_pipeline(&gpu.pipelines.spheres);
                pass.set_vertex_buffer(0, balls.slice(..));
                pass.draw(0..4, 0..*ball_count);
            }
        }
        if let [(boxes, count)] = &gpu.boxes.buffers[..] {
            let count = self.box_count.min(*count);
            if count > 0 {
                pass.set_pipeline(&gpu.pipelines.boxes);
                pass.set_vertex_buffer(0, boxes.slice(..));
                pass.draw(0..24, 0..count);
            }
        }
        if let [(corners, count)] = &gpu.faces.buffers[..]
            && *count > 0
        {
            pass.set_pipeline(&gpu.pipelines.faces);
            pass.set_vertex_buffer(0, corners.slice(..));
            pass.draw(0..*count, 0..1);
        }
        if let [(lines, count)] = &gpu.lines.buffers[..]
            && *count > 0
        {
            pass.set_vertex_buffer(0, lines.slice(..));
            for pipeline in [&gpu.pipelines.hidden_lines, &gpu.pipelines.lines] {
                pass.set_pipeline(pipeline);
                pass.draw(0..4, 0..*count);
            }
        }
    }
}

//! The render pipelines of the 3D view.

use super::scene_mesh::{Ball, Vertex};
use crate::present::overlay::{FaceCorner, Instance, Line};
use eframe::egui_wgpu::wgpu;

/// Samples a pixel.
pub const MSAA: u32 = 4;

/// All pipelines; those that draw the scene share one bind group with the globals.
pub struct Pipelines {
    pub globals_layout: wgpu::BindGroupLayout,
    pub mesh: wgpu::RenderPipeline,
    pub spheres: wgpu::RenderPipeline,
    pub boxes: wgpu::RenderPipeline,
    pub faces: wgpu::RenderPipeline,
    pub lines: wgpu::RenderPipeline,
    pub hidden_lines: wgpu::RenderPipeline,
    pub blit: wgpu::RenderPipeline,
    blit_layout: wgpu::BindGroupLayout,
    nearest: wgpu::Sampler,
}

/// What tells the pipelines that draw the scene apart.
struct Kind {
    vertex: &'static str,
    fragment: &'static str,
    topology: wgpu::PrimitiveTopology,
    step: wgpu::VertexStepMode,
    stride: u64,
    attributes: Vec<wgpu::VertexAttribute>,
    depth_write: bool,
    depth_compare: wgpu::CompareFunction,
    blend: Option<wgpu::BlendState>,
    /// The fragment's alpha says how much of the pixel is covered.
    alpha_covers: bool,
}

impl Pipelines {
    pub const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
    pub const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

    /// `window` is the format of the window's own pass.
    pub fn new(device: &wgpu::Device, window: wgpu::TextureFormat) -> Self {
        use wgpu::{CompareFunction, PrimitiveTopology, VertexStepMode};
        let globals_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("view3d globals"),
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
        let shaders = device.create_shader_module(wgpu::include_wgsl!("shaders.wgsl"));
        let make = |kind: Kind| scene_pipeline(device, &shaders, &globals_layout, kind);
        let mesh = make(Kind {
            vertex: "mesh_vertex",
            fragment: "mesh_fragment",
            topology: PrimitiveTopology::TriangleList,
            step: VertexStepMode::Vertex,
            stride: size_of::<Vertex>() as u64,
            attributes: wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4]
                .to_vec(),
            depth_write: true,
            depth_compare: CompareFunction::Less,
            blend: None,
            alpha_covers: true,
        });
        let spheres = make(Kind {
            vertex: "sphere_vertex",
            fragment: "sphere_fragment",
            topology: PrimitiveTopology::TriangleStrip,
            step: VertexStepMode::Instance,
            stride: size_of::<Ball>() as u64,
            attributes: wgpu::vertex_attr_array![0 => Float32x4, 1 => Unorm8x4].to_vec(),
            depth_write: true,
            depth_compare: CompareFunction::Less,
            blend: None,
            alpha_covers: true,
        });
        let boxes = make(Kind {
            vertex: "box_vertex",
            fragment: "box_fragment",
            topology: PrimitiveTopology::LineList,
            step: VertexStepMode::Instance,
            stride: size_of::<Instance>() as u64,
            attributes: wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4]
                .to_vec(),
            depth_write: false,
            depth_compare: CompareFunction::LessEqual,
            // Where thousands of edges meet, those behind shine through.
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            alpha_covers: false,
        });
        let faces = make(Kind {
            vertex: "face_vertex",
            fragment: "face_fragment",
            topology: PrimitiveTopology::TriangleList,
            step: VertexStepMode::Vertex,
            stride: size_of::<FaceCorner>() as u64,
            attributes: wgpu::vertex_attr_array![0 => Float32x3, 1 => Unorm8x4].to_vec(),
            depth_write: false,
            depth_compare: CompareFunction::LessEqual,
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            alpha_covers: false,
        });
        let line = |fragment, depth_compare, blend| {
            make(Kind {
                vertex: "line_vertex",
                fragment,
                topology: PrimitiveTopology::TriangleStrip,
                step: VertexStepMode::Instance,
                stride: size_of::<Line>() as u64,
                attributes: wgpu::vertex_attr_array![
                    0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Float32
                ]
                .to_vec(),
                depth_write: false,
                depth_compare,
                blend,
                alpha_covers: false,
            })
        };
        let lines = line("line_fragment", CompareFunction::LessEqual, None);
        let hidden_lines = line(
            "hidden_line_fragment",
            CompareFunction::Greater,
            Some(wgpu::BlendState::ALPHA_BLENDING),
        );
        let (blit, blit_layout) = blit_pipeline(device, window);
        let nearest = device.create_sampler(&wgpu::SamplerDescriptor::default());
        Pipelines {
            globals_layout,
            mesh,
            spheres,
            boxes,
            faces,
            lines,
            hidden_lines,
            blit,
            blit_layout,
            nearest,
        }
    }

    /// What the blit pipeline reads.
    pub fn blit_group(&self, device: &wgpu::Device, view: &wgpu::TextureView) -> wgpu::BindGroup {
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("view3d blit"),
            layout: &self.blit_layout,
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(view),
                },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: wgpu::BindingResource::Sampler(&self.nearest),
                },
            ],
        })
    }
}

fn scene_pipeline(
    device: &wgpu::Device,
    shaders: &wgpu::ShaderModule,
    globals: &wgpu::BindGroupLayout,
    kind: Kind,
) -> wgpu::RenderPipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(kind.vertex),
        bind_group_layouts: &[Some(globals)],
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(kind.vertex),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: shaders,
            entry_point: Some(kind.vertex),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: kind.stride,
                step_mode: kind.step,
                attributes: &kind.attributes,
            })],
        },
        fragment: Some(wgpu::FragmentState {
            module: shaders,
            entry_point: Some(kind.fragment),
            compilation_options: Default::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: Pipelines::COLOR,
                blend: kind.blend,
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        primitive: wgpu::PrimitiveState {
            topology: kind.topology,
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: Pipelines::DEPTH,
            depth_write_enabled: Some(kind.depth_write),
            depth_compare: Some(kind.depth_compare),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState {
            count: MSAA,
            alpha_to_coverage_enabled: kind.alpha_covers,
            ..Default::default()
        },
        multiview_mask: None,
        cache: None,
    })
}

fn blit_pipeline(
    device: &wgpu::Device,
    window: wgpu::TextureFormat,
) -> (wgpu::RenderPipeline, wgpu::BindGroupLayout) {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty,
        count: None,
    };
    let bindings = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("view3d blit"),
        entries: &[
            entry(
                0,
                wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
            ),
            entry(
                1,
                wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering),
            ),
        ],
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("view3d blit"),
        bind_group_layouts: &[Some(&bindings)],
        immediate_size: 0,
    });
    let shaders = device.create_shader_module(wgpu::include_wgsl!("blit.wgsl"));
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("view3d blit"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &shaders,
            entry_point: Some("blit_vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        fragment: Some(wgpu::FragmentState {
            module: &shaders,
            entry_point: Some("blit_fragment"),
            compilation_options: Default::default(),
            targets: &[Some(window.into())],
        }),
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        multiview_mask: None,
        cache: None,
    });
    (pipeline, bindings)
}

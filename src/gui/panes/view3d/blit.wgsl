// Copies the finished 3D picture into the window's pass.

struct Out {
    @builtin(position) clip: vec4f,
    @location(0) uv: vec2f,
}

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var nearest: sampler;

@vertex
fn blit_vertex(@builtin(vertex_index) v: u32) -> Out {
    let uv = vec2f(f32((v << 1u) & 2u), f32(v & 2u));
    return Out(vec4f(uv.x * 2.0 - 1.0, 1.0 - uv.y * 2.0, 0.0, 1.0), uv);
}

@fragment
fn blit_fragment(in: Out) -> @location(0) vec4f {
    return vec4f(textureSample(picture, nearest, in.uv).rgb, 1.0);
}

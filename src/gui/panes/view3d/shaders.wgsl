// Scene, leaf boxes and lines of the 3D view; places are relative to a center of the scene.

struct Globals {
    clip_from_scene: mat4x4f,
    // The eye; w is 1 for parallel rays, else 0.
    eye: vec4f,
    forward: vec4f,
    right: vec4f,
    up: vec4f,
    // What lies further along xyz than w is hidden.
    cut: vec4f,
    // Width and height of the target in points.
    size: vec2f,
    // Of what is shown.
    radius: f32,
    // Of objects: the share of a pixel's samples that they cover.
    opacity: f32,
}

@group(0) @binding(0) var<uniform> globals: Globals;

fn is_cut(place: vec3f) -> bool {
    return dot(globals.cut.xyz, place) > globals.cut.w;
}

fn to_eye(place: vec3f) -> vec3f {
    if globals.eye.w > 0.5 {
        return -globals.forward.xyz;
    }
    return normalize(globals.eye.xyz - place);
}

// A little closer to the eye, at the same place on the screen: an edge in a surface is seen.
fn nearer(place: vec3f) -> vec3f {
    const SHARE: f32 = 0.0005;
    if globals.eye.w > 0.5 {
        return place - globals.forward.xyz * globals.radius * SHARE;
    }
    return mix(place, globals.eye.xyz, SHARE);
}

// Both sides of a surface are lit from the eye.
fn shaded(color: vec3f, normal: vec3f, place: vec3f) -> vec4f {
    return vec4f(color * (0.3 + 0.7 * abs(dot(normalize(normal), to_eye(place)))), globals.opacity);
}

// Triangles

struct MeshOut {
    @builtin(position) clip: vec4f,
    @location(0) place: vec3f,
    @location(1) normal: vec3f,
    @location(2) color: vec3f,
}

@vertex
fn mesh_vertex(@location(0) place: vec3f, @location(1) normal: vec3f, @location(2) color: vec4f) -> MeshOut {
    return MeshOut(globals.clip_from_scene * vec4f(place, 1.0), place, normal, color.rgb);
}

@fragment
fn mesh_fragment(in: MeshOut) -> @location(0) vec4f {
    if is_cut(in.place) {
        discard;
    }
    return shaded(in.color, in.normal, in.place);
}

// Spheres: a square that covers the sphere, on which the sphere is met by rays

struct SphereOut {
    @builtin(position) clip: vec4f,
    @location(0) place: vec3f,
    @location(1) @interpolate(flat) sphere: vec4f,
    @location(2) @interpolate(flat) color: vec3f,
}

@vertex
fn sphere_vertex(@builtin(vertex_index) v: u32, @location(0) sphere: vec4f, @location(1) color: vec4f) -> SphereOut {
    let corner = vec2f(f32(v & 1u), f32(v >> 1u)) * 2.0 - 1.0;
    var toward = -globals.forward.xyz;
    var reach = sphere.w;
    if globals.eye.w < 0.5 {
        let offset = globals.eye.xyz - sphere.xyz;
        let distance = length(offset);
        toward = offset / distance;
        // The outline of a sphere seen from nearby reaches beyond its radius.
        reach = sphere.w * distance / sqrt(max(distance * distance - sphere.w * sphere.w, 1e-4 * distance * distance));
    }
    var side = cross(globals.up.xyz, toward);
    if dot(side, side) < 1e-6 {
        side = globals.right.xyz;
    }
    side = normalize(side);
    let place = sphere.xyz + 1.02 * reach * (corner.x * side + corner.y * cross(toward, side));
    return SphereOut(globals.clip_from_scene * vec4f(place, 1.0), place, sphere, color.rgb);
}

struct SphereHit {
    @location(0) color: vec4f,
    @builtin(frag_depth) depth: f32,
}

@fragment
fn sphere_fragment(in: SphereOut) -> SphereHit {
    let radius = in.sphere.w;
    var origin = globals.eye.xyz;
    var direction = globals.forward.xyz;
    if globals.eye.w > 0.5 {
        origin = in.place - direction * 4.0 * radius;
    } else {
        direction = normalize(in.place - origin);
    }
    let offset = in.sphere.xyz - origin;
    let along = dot(offset, direction);
    let miss = offset - along * direction;
    let gap = length(miss);
    // How much of the pixel the sphere covers: smooth outlines without more samples.
    let cover = clamp((radius - gap) / max(fwidth(gap), 1e-12) + 0.5, 0.0, 1.0);
    let half = sqrt(max(radius * radius - gap * gap, 0.0));
    var t = along - half;
    // From inside, and through a cut, the far side is seen.
    if t < 0.0 || is_cut(origin + t * direction) {
        t = along + half;
    }
    let place = origin + t * direction;
    if cover <= 0.0 || t < 0.0 || is_cut(place) {
        discard;
    }
    let clip = globals.clip_from_scene * vec4f(place, 1.0);
    let color = shaded(in.color, place - in.sphere.xyz, place);
    return SphereHit(vec4f(color.rgb, cover * color.a), clamp(clip.z / clip.w, 0.0, 1.0));
}

// Leaf boxes: 24 vertices, two for each of 12 edges

struct BoxOut {
    @builtin(position) clip: vec4f,
    // Along the edge, 0 to 1.
    @location(0) along: f32,
    @location(1) @interpolate(flat) color: vec4f,
    @location(2) place: vec3f,
}

@vertex
fn box_vertex(@builtin(vertex_index) v: u32, @location(0) lo: vec3f, @location(1) hi: vec3f, @location(2) color: vec4f) -> BoxOut {
    let end = f32(v & 1u);
    let edge = v >> 1u;
    let a = f32(edge & 1u);
    let b = f32((edge >> 1u) & 1u);
    var corner = vec3f(end, a, b);
    if edge >= 8u {
        corner = vec3f(a, b, end);
    } else if edge >= 4u {
        corner = vec3f(a, end, b);
    }
    let place = mix(lo, hi, corner);
    return BoxOut(globals.clip_from_scene * vec4f(nearer(place), 1.0), end, color, place);
}

@fragment
fn box_fragment(in: BoxOut) -> @location(0) vec4f {
    if is_cut(in.place) {
        discard;
    }
    if in.color.a < 0.25 && fract(in.along * 6.0) > 0.5 {
        discard;
    }
    if in.color.a > 0.25 && in.color.a < 0.75 && fract(in.along * 24.0) > 0.35 {
        discard;
    }
    // Outside of the subtree that stands out: 32, 96 and 223 of 255 instead of 0, 128 and 255.
    let strokes = in.color.a * 255.0;
    let is_faint = abs(strokes - 32.0) < 8.0 || abs(strokes - 96.0) < 8.0 || abs(strokes - 223.0) < 8.0;
    return vec4f(in.color.rgb, select(0.55, 0.13, is_faint));
}

// Translucent faces of the selected cell

struct FaceOut {
    @builtin(position) clip: vec4f,
    @location(0) color: vec4f,
}

@vertex
fn face_vertex(@location(0) place: vec3f, @location(1) color: vec4f) -> FaceOut {
    return FaceOut(globals.clip_from_scene * vec4f(place, 1.0), color);
}

@fragment
fn face_fragment(in: FaceOut) -> @location(0) vec4f {
    return in.color;
}

// Lines of a width in pixels

struct LineOut {
    @builtin(position) clip: vec4f,
    @location(0) along: f32,
    @location(1) @interpolate(flat) color: vec4f,
}

@vertex
fn line_vertex(@builtin(vertex_index) v: u32, @location(0) a: vec3f, @location(1) b: vec3f, @location(2) color: vec4f, @location(3) width: f32) -> LineOut {
    var start = globals.clip_from_scene * vec4f(nearer(a), 1.0);
    var end = globals.clip_from_scene * vec4f(nearer(b), 1.0);
    // What lies before the near plane has no place on the screen.
    let first = start;
    if start.z < 0.0 && end.z > 0.0 {
        start = mix(first, end, first.z / (first.z - end.z) * 1.0001);
    } else if end.z < 0.0 && start.z > 0.0 {
        end = mix(end, first, end.z / (end.z - first.z) * 1.0001);
    }
    let half = globals.size * 0.5;
    let from_pixel = start.xy / start.w * half;
    let to_pixel = end.xy / end.w * half;
    var direction = to_pixel - from_pixel;
    direction = select(vec2f(1.0, 0.0), direction / max(length(direction), 1e-6), length(direction) > 1e-6);
    let side = (f32(v & 1u) - 0.5) * width;
    let at_end = v >= 2u;
    let clip = select(start, end, at_end);
    let offset = vec2f(-direction.y, direction.x) * side / half * clip.w;
    return LineOut(vec4f(clip.xy + offset, clip.zw), select(0.0, 1.0, at_end), color);
}

fn line_color(in: LineOut) -> vec3f {
    if in.color.a < 0.5 && fract(in.along * 6.0) > 0.5 {
        discard;
    }
    return in.color.rgb;
}

@fragment
fn line_fragment(in: LineOut) -> @location(0) vec4f {
    return vec4f(line_color(in), 1.0);
}

// Where something lies in front of a line, it shines through.
@fragment
fn hidden_line_fragment(in: LineOut) -> @location(0) vec4f {
    return vec4f(line_color(in), 0.35);
}

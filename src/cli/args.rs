//! The arguments as they are typed; [`super::resolve`] makes settings of them.

use crate::geometry::Axis;
use crate::report::WRITERS;
use crate::scene::builtin::BUILTINS;
use crate::scene::{Cylinders, Sampling};
use crate::tree::{MaxDepth, Method, OverlapRule};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// See, measure and compare the BSP trees that make ray tracing fast.
///
/// Without a command it opens the window. Without a display it measures the scene with both of the
/// paper's methods instead and writes the picture to a file.
#[derive(Debug, Parser)]
#[command(
    name = "bspscope",
    version,
    args_conflicts_with_subcommands = true,
    after_help = help("bspscope balls\nbspscope measure scenes/rings.nff --cylinders polygons:10\n\
        bspscope render teaching -o teaching.png")
)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    #[command(flatten)]
    pub window: WindowArgs,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    Measure(MeasureArgs),
    Render(RenderArgs),
    Generate(GenerateArgs),
    Methods(MethodsArgs),
    Verify(VerifyArgs),
}

#[derive(Debug, Args)]
pub struct WindowArgs {
    /// Scene to open: a file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: Option<String>,
    #[command(flatten)]
    pub cylinders: CylinderArgs,
    #[command(flatten)]
    pub methods: MethodListArgs,
    #[command(flatten)]
    pub build: BuildArgs,
    #[command(flatten)]
    pub trace: TraceArgs,
    #[command(flatten)]
    pub picture: PictureArgs,
}

/// Measure every parameter of the paper, with Δ and Λ set apart
#[derive(Debug, Args)]
#[command(after_help = help("bspscope measure balls\n\
    bspscope measure scenes/tetra.nff --method midpoint --method sah-cut --d-max auto\n\
    bspscope measure rings --cylinders polygons:10 -o rings.json\n\
    bspscope measure balls:3 --set gap-fraction=0.05 --format csv | head"))]
pub struct MeasureArgs {
    #[command(flatten)]
    pub scene: SceneArgs,
    #[command(flatten)]
    pub methods: MethodListArgs,
    #[command(flatten)]
    pub build: BuildArgs,
    #[command(flatten)]
    pub trace: TraceArgs,
    #[command(flatten)]
    pub picture: PictureArgs,
    /// Form of the report; without it the extension of -o decides, or text
    #[arg(long, value_name = "FORM", value_parser = writer_names(), help_heading = "Output")]
    pub format: Option<String>,
    /// Write to this file in place of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
}

/// Render the picture to a PNG or OpenEXR file
#[derive(Debug, Args)]
#[command(after_help = help("bspscope render balls -o balls.png\n\
    bspscope render teaching --resolution 1280x960 --samples 16 -o teaching.exr"))]
pub struct RenderArgs {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Build method
    #[arg(long, value_name = "METHOD", value_parser = method_names(), default_value = "midpoint", help_heading = "Tree")]
    pub method: Method,
    #[command(flatten)]
    pub build: BuildArgs,
    #[command(flatten)]
    pub trace: TraceArgs,
    #[command(flatten)]
    pub picture: PictureArgs,
    /// Samples a pixel, at least 1; the first lies where --sampling says
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..), help_heading = "Picture")]
    pub samples: u32,
    /// Picture file: .png is 8-bit sRGB, .exr is linear 32-bit float
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: PathBuf,
}

/// Write a scene, generated or read, as a scene file
#[derive(Debug, Args)]
#[command(after_help = help("bspscope generate balls:4 -o balls.nff\n\
    bspscope generate rings --cylinders polygons:10 > rings.nff"))]
pub struct GenerateArgs {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Scene file to write; '-' or nothing writes to standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// List the build methods and their settings
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  bspscope methods\n  bspscope methods --format json")]
pub struct MethodsArgs {
    /// Form of the list
    #[arg(long, value_enum, default_value_t = ListFormat::Text)]
    pub format: ListFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ListFormat {
    Text,
    Json,
}

/// Check trees, and their hits ray for ray against testing every object
///
/// Exit code 1 if anything is wrong.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope verify\n\
    bspscope verify teaching scenes/balls.nff --rays 10000 --method sah-cut"))]
pub struct VerifyArgs {
    /// Scenes, files or generators [default: all generators]
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
    #[command(flatten)]
    pub cylinders: CylinderArgs,
    /// Rays of every kind and scene that are compared
    #[arg(long, value_name = "N", default_value_t = 50_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub rays: u32,
    /// Build method; may be given more than once [default: all but none]
    #[arg(long, value_name = "METHOD", value_parser = method_names(), help_heading = "Tree")]
    pub method: Vec<Method>,
    #[command(flatten)]
    pub build: BuildArgs,
    #[command(flatten)]
    pub trace: TraceArgs,
}

#[derive(Debug, Args)]
pub struct SceneArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub cylinders: CylinderArgs,
}

#[derive(Debug, Args)]
pub struct CylinderArgs {
    /// How cylinders and cones enter the scene: exact, or polygons:N for open prisms of N polygons
    #[arg(long, value_name = "HOW", default_value_t = Cylinders::Exact, help_heading = "Scene")]
    pub cylinders: Cylinders,
}

#[derive(Debug, Args)]
pub struct MethodListArgs {
    /// Build method; may be given more than once [default: the paper's two]
    #[arg(long, value_name = "METHOD", value_parser = method_names(), help_heading = "Tree")]
    pub method: Vec<Method>,
}

/// What a tree is built with.
#[derive(Debug, Args)]
#[command(next_help_heading = "Tree")]
pub struct BuildArgs {
    /// Greatest depth of a leaf, D_MAX, or 'auto'; the root has depth 0
    #[arg(long, value_name = "N", default_value = "20")]
    pub d_max: MaxDepth,
    /// A cell with at most this many objects becomes a leaf, N_OILF
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub n_oilf: u32,
    /// When an object belongs to a cell: paper, bounds or exact
    #[arg(long, value_name = "RULE", default_value = OverlapRule::Paper.name())]
    pub overlap: OverlapRule,
    /// How far the root cell reaches beyond the scene's bounds on every side, a length
    #[arg(
        long,
        value_name = "X",
        default_value_t = 0.001,
        allow_negative_numbers = true
    )]
    pub root_margin: f64,
    /// The axis that methods in cyclic order split first: x, y or z
    #[arg(long, value_name = "AXIS", default_value_t = Axis::X)]
    pub first_axis: Axis,
    /// A method's own setting (see 'bspscope methods'), for every chosen method that has it
    #[arg(long, value_name = "NAME=VALUE", value_parser = constant)]
    pub set: Vec<(String, f64)>,
    /// The build stops with an error before it takes more than this many MiB
    #[arg(long, value_name = "MIB", default_value_t = 4096)]
    pub memory_limit: u64,
}

/// What rays are traced with.
#[derive(Debug, Args)]
#[command(next_help_heading = "Picture")]
pub struct TraceArgs {
    /// How deep secondary rays go, D_AREC; 0 traces none
    #[arg(long, value_name = "N", default_value_t = 4)]
    pub d_arec: u32,
    /// Where the first sample lies: in the pixel's centre, or on a lattice that spans the angle
    #[arg(long, value_name = "WHERE", value_parser = sampling_names(), default_value = "center")]
    pub sampling: Sampling,
    /// Threads; 0 takes as many as the machine has cores
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub threads: usize,
}

#[derive(Debug, Args)]
pub struct PictureArgs {
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", value_parser = resolution, default_value = "512x512", help_heading = "Picture")]
    pub resolution: [u32; 2],
}

/// Examples, and the scenes that can be generated.
fn help(examples: &str) -> String {
    let mut text = "Examples:".to_owned();
    for example in examples.lines() {
        text += &format!("\n  {example}");
    }
    text += "\n\nGenerators:";
    for builtin in BUILTINS {
        let sizes = &builtin.sizes;
        text += &format!(
            "\n  {} (sizes {} to {}; {} without one)\n      {}",
            builtin.name,
            sizes.start(),
            sizes.end(),
            builtin.default_size,
            builtin.about
        );
    }
    text
}

fn writer_names() -> PossibleValuesParser {
    PossibleValuesParser::new(
        WRITERS
            .iter()
            .map(|writer| PossibleValue::new(writer.name).help(writer.about)),
    )
}

fn method_names() -> impl TypedValueParser<Value = Method> {
    PossibleValuesParser::new(Method::all().map(|m| PossibleValue::new(m.name).help(m.title)))
        .try_map(|name| Method::named(&name))
}

fn sampling_names() -> impl TypedValueParser<Value = Sampling> {
    PossibleValuesParser::new(["center", "corner"]).map(|name| match name.as_str() {
        "corner" => Sampling::Corner,
        _ => Sampling::Center,
    })
}

fn resolution(text: &str) -> Result<[u32; 2], String> {
    text.split_once(['x', '×'])
        .and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]))
        .ok_or_else(|| "expected a width and a height in pixels, such as 512x512".into())
}

fn constant(text: &str) -> Result<(String, f64), String> {
    text.split_once('=')
        .and_then(|(name, value)| Some((name.to_owned(), value.parse().ok()?)))
        .ok_or_else(|| "expected NAME=VALUE with a number, such as gap-fraction=0.05".into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_definition_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn the_defaults_are_those_of_the_library() {
        use crate::tree::BuildSettings;
        let arguments = Arguments::parse_from(["bspscope", "measure", "balls"]);
        let Some(Command::Measure(args)) = arguments.command else {
            panic!("not a measurement");
        };
        let methods = Method::of_the_paper();
        assert_eq!(
            crate::cli::resolve::builds(&methods, &args.build).unwrap(),
            methods
                .into_iter()
                .map(BuildSettings::for_method)
                .collect::<Vec<_>>()
        );
        let camera = crate::scene::builtin::generate("teaching", None)
            .unwrap()
            .camera;
        let mut render = crate::cli::resolve::render(camera, &args.trace, &args.picture);
        render.threads = 0;
        assert_eq!(render, crate::trace::RenderSettings::for_camera(camera));
    }
}
